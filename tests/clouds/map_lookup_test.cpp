#include "bakers/clouds/cloud_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace skybake::cloud {
namespace {

using config::MapFilter;
using config::MapWrap;

MapImage numbered(int width, int height) {
    MapImage image{width, height, {}, ""};
    for (int i = 0; i < width * height; ++i) {
        image.values.push_back(static_cast<float>(i * 7 % 64) / 64);
    }
    return image;
}

float pixel(const MapImage& image, int x, int y) {
    return image.values[static_cast<std::size_t>(y * image.width + x)];
}

TEST(MapLookup, CentresGiveTheirPixelAndRowZeroIsAtVZero) {
    const MapImage image = numbered(4, 8);
    for (const MapWrap wrap : {MapWrap::repeat, MapWrap::clamp}) {
        for (const MapFilter filter : {MapFilter::nearest, MapFilter::linear}) {
            const MapLookup map(image, wrap, filter);
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 4; ++x) {
                    EXPECT_EQ(map.at((x + 0.5) / 4, (y + 0.5) / 8), pixel(image, x, y));
                }
            }
        }
    }
}

TEST(MapLookup, LinearIsBetweenCentres) {
    const MapLookup map({2, 2, {0, 1, 0.5F, 0.25F}, ""}, MapWrap::clamp, MapFilter::linear);
    EXPECT_EQ(map.at(0.5, 0.25), 0.5);
    EXPECT_EQ(map.at(0.25, 0.5), 0.25);
    EXPECT_EQ(map.at(0.75, 0.375), 0.8125);
    EXPECT_EQ(map.at(0.5, 0.5), 0.4375);
}

TEST(MapLookup, NearestChangesAtThePixelsEdges) {
    const MapImage image = numbered(4, 1);
    const MapLookup map(image, MapWrap::repeat, MapFilter::nearest);
    EXPECT_EQ(map.at(0.25, 0), pixel(image, 1, 0));
    EXPECT_EQ(map.at(std::nextafter(0.25, 0.0), 0), pixel(image, 0, 0));
    EXPECT_EQ(map.at(1, 0), pixel(image, 0, 0));
    EXPECT_EQ(map.at(std::nextafter(1.0, 0.0), 0), pixel(image, 3, 0));
    EXPECT_EQ(map.at(-1e-20, 0), pixel(image, 3, 0));
    const MapLookup clamped(image, MapWrap::clamp, MapFilter::nearest);
    EXPECT_EQ(clamped.at(1, 1), pixel(image, 3, 0));
    EXPECT_EQ(clamped.at(1e300, -1e300), pixel(image, 3, 0));
    EXPECT_EQ(clamped.at(-0.1, 0), pixel(image, 0, 0));
}

TEST(MapLookup, TheSeamRepeatsOrGoesOn) {
    const MapImage image{4, 1, {0.25F, 0, 0, 0.75F}, ""};
    const MapLookup repeated(image, MapWrap::repeat, MapFilter::linear);
    const MapLookup clamped(image, MapWrap::clamp, MapFilter::linear);
    EXPECT_EQ(repeated.at(0, 0.5), 0.5);
    EXPECT_EQ(repeated.at(1, 0.5), 0.5);
    EXPECT_EQ(repeated.at(-1e-20, 0.5), 0.5);
    EXPECT_EQ(clamped.at(0, 0.5), 0.25);
    EXPECT_EQ(clamped.at(1, 0.5), 0.75);
    EXPECT_EQ(clamped.at(-3, 0.5), 0.25);
    EXPECT_EQ(clamped.at(1e300, 0.5), 0.75);
}

// The definition: every pixel of every copy of the picture has a tent, one pixel to each side.
long double tent_weight(double coordinate, int size, int index, MapWrap wrap) {
    long double place = static_cast<long double>(coordinate) * size - 0.5L;
    if (wrap == MapWrap::clamp) place = std::clamp(place, 0.0L, size - 1.0L);
    long double weight = 0;
    const auto copies = wrap == MapWrap::repeat ? std::floor(place / size) : 0.0L;
    for (int copy = -1; copy <= 1; ++copy) {
        const long double centre = index + (copies + copy) * size;
        if (wrap == MapWrap::repeat || copy == 0) {
            weight += std::max(0.0L, 1 - std::abs(place - centre));
        }
    }
    return weight;
}

long double definition(const MapImage& image, double u, double v, MapWrap wrap) {
    long double sum = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            sum += tent_weight(u, image.width, x, wrap) * tent_weight(v, image.height, y, wrap) *
                   pixel(image, x, y);
        }
    }
    return sum;
}

double any_coordinate() {
    return *rc::gen::inRange(-3 * (1 << 20), 4 * (1 << 20)) / static_cast<double>(1 << 20);
}

MapImage any_image() {
    MapImage image{*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), {}, ""};
    image.values.resize(static_cast<std::size_t>(image.width * image.height));
    for (float& value : image.values) {
        value = static_cast<float>(*rc::gen::inRange(0, 1 << 24)) * 0x1p-24F;
    }
    return image;
}

// The coordinate's position in pixels is rounded to 2^-50 or less, as are four products.
TEST(MapLookup, IsTheDefinition) {
    EXPECT_TRUE(rc::check([] {
        const MapImage image = any_image();
        const auto wrap = *rc::gen::element(MapWrap::repeat, MapWrap::clamp);
        const double u = any_coordinate() / 3, v = any_coordinate() / 3;
        const double value = MapLookup(image, wrap, MapFilter::linear).at(u, v);
        RC_ASSERT(std::abs(value - definition(image, u, v, wrap)) < 1e-14L);
    }));
}

TEST(MapLookup, StaysWithinTheValuesAndKeepsConstants) {
    EXPECT_TRUE(rc::check([] {
        MapImage image = any_image();
        const auto wrap = *rc::gen::element(MapWrap::repeat, MapWrap::clamp);
        const double u = any_coordinate() / 3, v = any_coordinate() / 3;
        const auto [least, greatest] =
            std::minmax_element(image.values.begin(), image.values.end());
        const double value = MapLookup(image, wrap, MapFilter::linear).at(u, v);
        RC_ASSERT(value >= double{*least} && value <= double{*greatest});
        const float constant = image.values[0];
        std::fill(image.values.begin(), image.values.end(), constant);
        RC_ASSERT(MapLookup(image, wrap, MapFilter::linear).at(u, v) == double{constant});
    }));
}

TEST(MapLookup, RepeatsExactly) {
    EXPECT_TRUE(rc::check([] {
        const MapImage image = any_image();
        const auto filter = *rc::gen::element(MapFilter::nearest, MapFilter::linear);
        const MapLookup map(image, MapWrap::repeat, filter);
        const double u = any_coordinate(), v = any_coordinate();  // multiples of 2^-20
        RC_ASSERT(map.at(u, v) == map.at(u + 5, v - 2));
    }));
}

}  // namespace
}  // namespace skybake::cloud
