// Texels fitted by least squares, against the law of least squares and against lookups.
#include "bakers/assets/cloud_light/texel_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

#include "bakers/field/interpolation.h"
#include "bakers/occupancy/cell_grid.h"
#include "tests/cloud_light/layers.h"
#include "tests/support/volumes.h"

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
    testing::for_each_voxel(sizes.places, [&](int x, int y, int z) {
        use(std::array{x, y, z}, index++);
    });
}

std::vector<float> rough(const std::array<int, 3>& size) {
    const CloudLayer layer = test::rough_layer(size);
    return {layer.values.begin(), layer.values.end()};
}

// A third of the places weigh nothing; neighbours weigh up to 30 times as much as each other.
std::vector<float> uneven(const std::array<int, 3>& size) {
    std::vector<float> weights;
    for (std::size_t i = 0; i < occupancy::count_of(size); ++i) {
        const auto turn = static_cast<float>(i * 7 % 11);
        weights.push_back(i % 3 == 1 ? 0.0F : 0.3F + 0.9F * turn);
    }
    return weights;
}

double shown(double value, ShownAs as) {
    return as == ShownAs::sunlight ? std::exp(-0.6 * value) : value;
}

double squares(const std::vector<float>& texels, const std::vector<float>& values,
               const std::vector<float>& weights, ShownAs as, const Sizes& sizes) {
    double sum = 0;
    for_each_place(sizes, [&](const std::array<int, 3>& place, std::size_t i) {
        const double error = shown(look_up(texels, sizes, place), as) - shown(values[i], as);
        sum += double{weights[i]} * error * error;
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
        const std::vector<float> weights(values.size(), 2.0F);
        const auto found = TexelFit(sizes.places, sizes.texels, weights, 2)
                               .fit(values, ShownAs::itself, kUnbounded);
        ASSERT_EQ(found.size(), texels.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], texels[i], 1e-3) << sizes.places[0] << ", texel " << i;
        }
    }
}

// The least sum of squares that steps of single texels find, one after the other.
double least_squares(std::vector<float> texels, const std::vector<float>& values,
                     const std::vector<float>& weights, ShownAs as, const Sizes& sizes) {
    double least = squares(texels, values, weights, as, sizes);
    for (double step = 0.5; step > 1e-3; step *= 0.7) {
        for (int round = 0; round < 3; ++round) {
            for (float& texel : texels) {
                for (const double way : {step, -step}) {
                    const float before = texel;
                    texel = static_cast<float>(std::max(0.0, double{before} + way));
                    const double sum = squares(texels, values, weights, as, sizes);
                    if (sum < least) {
                        least = sum;
                    } else {
                        texel = before;
                    }
                }
            }
        }
    }
    return least;
}

TEST(TexelFit, HasTheLeastSquares) {
    for (const Sizes& sizes : kSizes) {
        const std::vector<float> values = rough(sizes.places);
        const std::vector<float> weights = uneven(sizes.places);
        const TexelFit fit(sizes.places, sizes.texels, weights, 1);
        for (const ShownAs as : {ShownAs::itself, ShownAs::sunlight}) {
            const auto texels = fit.fit(values, as, {0, kAny});
            const double found = squares(texels, values, weights, as, sizes);
            const double least = least_squares(texels, values, weights, as, sizes);
            std::printf("%d x %d x %d: %.5g, by steps of texels %.5g\n", sizes.texels[0],
                        sizes.texels[1], sizes.texels[2], found, least);
            EXPECT_LE(found, 1.02 * least + 1e-6);
        }
    }
}

// A texel that no place of any weight looks up is the value at its centre, whatever is elsewhere.
TEST(TexelFit, TakesTheValueAtTheCenterWhereNothingWeighs) {
    const Sizes sizes{{16, 4, 8}, {8, 2, 4}};
    const std::vector<float> values(occupancy::count_of(sizes.places), 3.0F);
    std::vector<float> weights(values.size(), 0.0F);
    weights.front() = 1;
    std::vector<float> other = values;
    other.front() = 7;
    for (const ShownAs as : {ShownAs::itself, ShownAs::sunlight}) {
        const TexelFit fit(sizes.places, sizes.texels, weights, 1);
        EXPECT_EQ(fit.fit(values, as, kUnbounded)[27], 3.0F);
        const auto texels = fit.fit(other, as, kUnbounded);
        EXPECT_EQ(texels[27], 3.0F);
        EXPECT_NE(texels[0], 3.0F);
        const TexelFit nothing(sizes.places, sizes.texels, std::vector<float>(values.size()), 1);
        EXPECT_EQ(nothing.fit(values, as, kUnbounded)[0], 3.0F);
    }
}

TEST(TexelFit, KeepsTexelsWithinTheBounds) {
    const Sizes sizes{{32, 1, 1}, {8, 1, 1}};
    std::vector<float> values(32, 0.0F);
    std::fill(values.begin() + 16, values.end(), 1.0F);
    const TexelFit fit(sizes.places, sizes.texels, std::vector<float>(32, 1.0F), 1);
    const auto extremes = [&](const std::array<float, 2>& bounds) {
        const auto texels = fit.fit(values, ShownAs::itself, bounds);
        const auto [least, most] = std::minmax_element(texels.begin(), texels.end());
        return std::array{*least, *most};
    };
    EXPECT_LT(extremes(kUnbounded)[0], 0);  // it overshoots, so that the bounds matter
    EXPECT_GT(extremes(kUnbounded)[1], 1);
    EXPECT_EQ(extremes({0, 1}), (std::array{0.0F, 1.0F}));
}

TEST(TexelFit, HasTheSameBitsForAnyNumberOfThreads) {
    const Sizes sizes{{24, 12, 10}, {6, 6, 5}};
    const std::vector<float> values = rough(sizes.places);
    const auto fitted = [&](int threads) {
        return TexelFit(sizes.places, sizes.texels, uneven(sizes.places), threads)
            .fit(values, ShownAs::sunlight, {0, kAny});
    };
    EXPECT_EQ(fitted(1), fitted(3));
}

// Shares of the work grow, and whoever answers no is soon left alone.
TEST(TexelFit, SaysHowFarItIsAndEndsWhenTold) {
    const Sizes sizes{{24, 12, 10}, {6, 6, 5}};
    const TexelFit fit(sizes.places, sizes.texels, uneven(sizes.places), 1);
    std::vector<double> shares;
    const auto watched = [&](double until) {
        shares.clear();
        return fit.fit(rough(sizes.places), ShownAs::sunlight, {0, kAny}, [&](double share) {
            shares.push_back(share);
            return share < until;
        });
    };
    EXPECT_EQ(watched(2), fit.fit(rough(sizes.places), ShownAs::sunlight, {0, kAny}));
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GE(shares.front(), 0);
    EXPECT_GT(shares.back(), 0.2);
    EXPECT_LE(shares.back(), 1);
    EXPECT_GT(shares.size(), 10u);
    watched(0.1);
    const auto told = std::ranges::lower_bound(shares, 0.1);
    EXPECT_LE(shares.end() - told, 4);  // once for each step
}

}  // namespace
}  // namespace skybake::cloud_light
