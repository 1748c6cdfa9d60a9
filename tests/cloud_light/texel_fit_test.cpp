// Texels fitted by least squares, against the law of least squares and against lookups.
#include "bakers/assets/cloud_light/texel_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "bakers/field/interpolation.h"
#include "bakers/occupancy/cell_grid.h"
#include "tests/cloud_light/layers.h"

namespace skybake::cloud_light {
namespace {

constexpr float kAny = std::numeric_limits<float>::max();
constexpr std::array<float, 2> kUnbounded = {-kAny, kAny};

struct Sizes {
    std::array<int, 3> places;
    std::array<int, 3> texels;
};

const std::array kSizes = {
    Sizes{{8, 12, 6}, {4, 4, 3}}, Sizes{{7, 5, 9}, {3, 2, 4}},  Sizes{{5, 1, 2}, {1, 1, 1}},
    Sizes{{6, 4, 3}, {6, 4, 3}},  Sizes{{10, 9, 2}, {7, 3, 2}},
};

double look_up(const std::vector<float>& texels, const Sizes& sizes,
               const std::array<int, 3>& place) {
    std::array<double, 3> uvw{};
    for (std::size_t a = 0; a < 3; ++a) uvw[a] = (place[a] + 0.5) / sizes.places[a];
    double sum = 0;
    for (const VoxelTap& tap : trilinear_taps(sizes.texels, uvw, {true, true, false})) {
        sum += tap.weight * double{texels[occupancy::index_of(sizes.texels, tap.voxel[0],
                                                              tap.voxel[1], tap.voxel[2])]};
    }
    return sum;
}

// Calls use(place, index) for every place.
template <class Use>
void for_each_place(const Sizes& sizes, const Use& use) {
    std::size_t index = 0;
    for (int z = 0; z < sizes.places[2]; ++z) {
        for (int y = 0; y < sizes.places[1]; ++y) {
            for (int x = 0; x < sizes.places[0]; ++x) use(std::array{x, y, z}, index++);
        }
    }
}

std::vector<float> rough(const std::array<int, 3>& size) {
    const CloudLayer layer = test::rough_layer(size);
    return {layer.values.begin(), layer.values.end()};
}

double squares(const std::vector<float>& texels, const std::vector<float>& values,
               const Sizes& sizes) {
    double sum = 0;
    for_each_place(sizes, [&](const std::array<int, 3>& place, std::size_t i) {
        const double error = look_up(texels, sizes, place) - double{values[i]};
        sum += error * error;
    });
    return sum;
}

TEST(TexelFit, FindsTexelsWhoseLookupsTheValuesAre) {
    for (const Sizes& sizes : kSizes) {
        const std::vector<float> texels = rough(sizes.texels);
        std::vector<float> values(occupancy::count_of(sizes.places));
        for_each_place(sizes, [&](const std::array<int, 3>& place, std::size_t i) {
            values[i] = static_cast<float>(look_up(texels, sizes, place));
        });
        const std::vector<float> found =
            fit_texels(values, sizes.places, sizes.texels, kUnbounded, 2);
        ASSERT_EQ(found.size(), texels.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], texels[i], 2e-5) << sizes.places[0] << ", texel " << i;
        }
    }
}

// At the least sum of squares no step of any texel makes it smaller: it is level there, so that a step
// and its opposite change it by the same amount.
TEST(TexelFit, HasTheLeastSquares) {
    for (const Sizes& sizes : kSizes) {
        const std::vector<float> values = rough(sizes.places);
        std::vector<float> texels = fit_texels(values, sizes.places, sizes.texels, kUnbounded, 1);
        const double least = squares(texels, values, sizes);
        for (float& texel : texels) {
            const float before = texel;
            constexpr float kStep = 0.01F;
            texel = before + kStep;
            const double up = squares(texels, values, sizes) - least;
            texel = before - kStep;
            const double down = squares(texels, values, sizes) - least;
            texel = before;
            EXPECT_GT(up, 0);
            EXPECT_NEAR(up, down, 2e-5 * std::sqrt(static_cast<double>(values.size())));
        }
    }
}

TEST(TexelFit, KeepsTexelsWithinTheBounds) {
    const Sizes sizes{{32, 1, 1}, {8, 1, 1}};
    std::vector<float> values(32, 0.0F);
    std::fill(values.begin() + 16, values.end(), 1.0F);
    const auto extremes = [&](const std::array<float, 2>& bounds) {
        const auto texels = fit_texels(values, sizes.places, sizes.texels, bounds, 1);
        const auto [least, most] = std::minmax_element(texels.begin(), texels.end());
        return std::array{*least, *most};
    };
    EXPECT_LT(extremes(kUnbounded)[0], 0);  // it overshoots, so that the bounds matter
    EXPECT_GT(extremes(kUnbounded)[1], 1);
    EXPECT_EQ(extremes({0, 1}), (std::array{0.0F, 1.0F}));
}

}  // namespace
}  // namespace skybake::cloud_light
