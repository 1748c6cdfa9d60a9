// Stored values are the nearest that the pixel type has, and cost a cloud's edge no more than that.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/field/pixel_type.h"
#include "tests/noise/noises.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using test::hold;

// A cloud shape's values, and all of [0, 1] finely.
std::vector<float> values_to_store() {
    config::NoiseChannel shape =
        test::channel_of(config::NoiseType::perlin_worley, {{4, 4, 4}, {8, 8, 8}});
    shape.value_form = config::WorleyValue::one_minus_distance;
    std::vector<float> values = test::whole(test::noise_of({shape}), {64, 64, 64})[0];
    for (int i = 0; i <= 1 << 20; ++i) values.push_back(static_cast<float>(i) * 0x1p-20f);
    // Where two stored values are equally near, and on either side.
    for (int i = 0; i < 255; ++i) {
        const auto middle = static_cast<float>((i + 0.5) / 255);
        for (const float v : {middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1.0f)}) {
            values.push_back(v);
        }
    }
    return values;
}

// Half a step of the type at a value.
double half_step(double value, PixelType type) {
    if (type == PixelType::unorm8) return 0.5 / 255;
    if (type == PixelType::unorm16) return 0.5 / 65535;
    // Halves have 11 bits; below 2^-14 their steps no longer shrink.
    return std::ldexp(0.5, std::max(std::ilogb(value), -14) - 10);
}

TEST(NoiseHardCase, NoiseQuantisationRoundsToNearest) {
    const std::vector<float> values = values_to_store();
    for (const auto& [name, type] : {std::pair<const char*, PixelType>{"half", PixelType::half},
                                     {"unorm16", PixelType::unorm16},
                                     {"unorm8", PixelType::unorm8}}) {
        double most = 0;
        double most_steps = 0;
        for (const float v : values) {
            const double error = std::fabs(double{round_to_pixel_type(v, type)} - double{v});
            most = std::max(most, error);
            if (v > 0) most_steps = std::max(most_steps, error / half_step(v, type));
        }
        // The nearest float to a unorm step is 2^-25 off, and half of a 16-bit step 2^-17.
        const double bound = type == PixelType::half ? 1 : 1 + 0x1p-25 / half_step(1, type);
        EXPECT_GE(most_steps, 0.99);
        EXPECT_LE(most_steps, bound);
        hold(fmt::format("quantisation to {}, of half a step", name),
             fmt::format("nearest: 1; at most {:.2g}", most), most_steps, bound);
    }
}

// Density v * smoothstep(0.35, 0.40, v), the steepest of common cloud edges: its error is the
// stored one times the edge's slope, 11.75 in the middle.
TEST(NoiseHardCase, NoiseQuantisationAtACloudsEdge) {
    const auto density = [](double v) {
        const double t = std::min(1.0, std::max(0.0, (v - 0.35) / 0.05));
        return v * t * t * (3 - 2 * t);
    };
    const std::vector<float> values = values_to_store();
    for (const auto& [name, type, bound] :
         {std::tuple<const char*, PixelType, double>{"8 bit", PixelType::unorm8, 0.0235},
          {"half", PixelType::half, 0.00145},
          {"16 bit", PixelType::unorm16, 9.1e-5}}) {
        double worst = 0;
        for (const float v : values) {
            worst = std::max(worst,
                             std::fabs(density(double{round_to_pixel_type(v, type)}) - density(v)));
        }
        EXPECT_GE(worst, bound / 1.2);
        hold(fmt::format("quantisation to {} after an edge", name), "density of the float voxel",
             worst, bound);
    }
}

}  // namespace
}  // namespace skybake::noise
