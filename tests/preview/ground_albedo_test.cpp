// How the ground's albedo varies: its mean, its contrast, and what is left of it far away.
#include "bakers/render/scene_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/loops.h"

namespace skybake {
namespace {

constexpr int kAcross = 300;

// Mottles on a lattice of places 1 km apart, which is shifted.
std::vector<double> mottles(double footprint_m, double shift_m = 0) {
    std::vector<double> values;
    testing::for_each_texel(kAcross, kAcross, [&](int x, int y) {
        values.push_back(
            ground_mottle(1013.0 * x - 150e3 + shift_m, 1009.0 * y - 150e3, footprint_m));
    });
    return values;
}

double mean_of(const std::vector<double>& values, const std::function<double(double)>& of) {
    double sum = 0;
    for (const double value : values) sum += of(value);
    return sum / static_cast<double>(values.size());
}
double energy_of(const std::vector<double>& values) {
    return mean_of(values, [](double m) { return m * m; });
}

TEST(GroundAlbedo, HasItsMeanOverAWideArea) {
    for (const double footprint_m : {0.1, 100.0, 600.0}) {
        EXPECT_NEAR(mean_of(mottles(footprint_m), [](double m) { return m; }), 0, 0.01);
    }
}

// Nine tenths of near ground are within 30 % of the mean, and not all within 10 %.
TEST(GroundAlbedo, VariesByAThird) {
    std::vector<double> sizes = mottles(0.1);
    for (double& m : sizes) m = std::fabs(m);
    std::sort(sizes.begin(), sizes.end());
    const double ninth = sizes[sizes.size() * 9 / 10];
    EXPECT_GT(ninth, 0.15);
    EXPECT_LT(ninth, 0.3);
    EXPECT_LT(sizes.back(), 0.75);
}

TEST(GroundAlbedo, FadesToItsMeanWithTheFootprint) {
    double before = energy_of(mottles(0.1));
    for (const double footprint_m : {20.0, 60.0, 200.0, 600.0, 1500.0}) {
        const double here = energy_of(mottles(footprint_m));
        EXPECT_LT(here, 0.9 * before) << footprint_m;
        before = here;
    }
    EXPECT_GT(before, 0);
    EXPECT_EQ(energy_of(mottles(3000)), 0);
}

// A pixel shows nearly what its neighbour shows: nothing is finer than pixels. Values that have
// nothing in common differ by twice their energy.
TEST(GroundAlbedo, IsNotFinerThanFootprints) {
    for (const double footprint_m : {7.0, 33.0, 150.0, 700.0}) {
        const std::vector<double> here = mottles(footprint_m);
        std::vector<double> apart = mottles(footprint_m, footprint_m);
        for (std::size_t i = 0; i < here.size(); ++i) apart[i] -= here[i];
        EXPECT_LT(energy_of(apart), 0.4 * energy_of(here)) << footprint_m;
    }
}

TEST(GroundAlbedo, IsSeenWhereRaysMeetTheGround) {
    const glm::dvec3 eye(300, -700, 150);
    const glm::dvec3 ray = {0.6, 0, -0.8};
    const double way = 150 / 0.8;
    EXPECT_DOUBLE_EQ(ground_mottle_along(eye, ray, 1e-3),
                     ground_mottle(300 + 0.6 * way, -700, 1e-3 * way / 0.8));
    EXPECT_EQ(ground_mottle_along(eye, {0.6, 0, 0.8}, 1e-3), 0);
    EXPECT_EQ(ground_mottle_along(eye, {1, 0, 0}, 1e-3), 0);
    EXPECT_EQ(ground_mottle_along(eye, {1, 0, -1e-6}, 1e-3), 0);  // so far that it has its mean
}

TEST(GroundAlbedo, IsNeverWhiterThanWhite) {
    for (const double mottle : {-0.75, -0.2, 0.3, 0.75}) {
        const Spectrum albedo(0.0, 0.2, 0.9, 1.0);
        const Spectrum seen = albedo * mottled(albedo, mottle);
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_GE(seen[c], 0);
            EXPECT_LE(seen[c], 1 + 1e-12);
        }
        EXPECT_DOUBLE_EQ(seen[1], 0.2 * (1 + mottle));
        EXPECT_EQ(seen[3], 1);
    }
}

}  // namespace
}  // namespace skybake
