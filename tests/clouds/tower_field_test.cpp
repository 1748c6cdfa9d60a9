#include "bakers/clouds/tower_field.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "bakers/clouds/cloud_reference.h"
#include "tests/clouds/clouds.h"

namespace skybake::cloud {
namespace {

using config::Tower;
using test::any_number;
using test::any_tower;
using test::tower;

double field_at(const TowerField& field, double x, double y) {
    double sum = 0;
    field.add_row(y, std::array{x}, &sum);
    return sum;
}

// The definition, image by image over a square.
double brute_force(const Tower& any, double x, double y) {
    const double c = std::cos(any.rotation.radians);
    const double s = std::sin(any.rotation.radians);
    const double rho = any.correlation;
    const double reach = 9 * std::max(any.sigma[0], any.sigma[1]);
    double sum = 0;
    for (double j = std::ceil(y - any.center[1] - reach); j <= y - any.center[1] + reach; ++j) {
        for (double i = std::ceil(x - any.center[0] - reach); i <= x - any.center[0] + reach; ++i) {
            const double dx = x - any.center[0] - i;
            const double dy = y - any.center[1] - j;
            const double a = (c * dx + s * dy) / any.sigma[0];
            const double b = (c * dy - s * dx) / any.sigma[1];
            const double q = b * b + (a - rho * b) * (a - rho * b) / ((1 - rho) * (1 + rho));
            sum += any.amplitude * std::exp(-q / 2);
        }
    }
    return sum;
}

TEST(TowerField, AgreesWithTheSumOverAllImages) {
    EXPECT_TRUE(rc::check([] {
        Tower any = any_tower();
        // Brute force takes as many images as the greater sigma squared.
        for (double& sigma : any.sigma) sigma = std::min(sigma, 1.5);
        const TowerField field(std::array{any});
        for (int i = 0; i < 20; ++i) {
            // Half of the places near the tower, which may be thin.
            const double reach = i % 2 == 0 ? 1 : 3 * std::min(any.sigma[0], any.sigma[1]);
            const double x = any.center[0] + any_number(-reach, reach);
            const double y = any.center[1] + any_number(-reach, reach);
            const double wanted = brute_force(any, x, y);
            // In thin, turned towers the place itself is rounded: 2^-53 of 3 over sigma.
            const double scale = any.amplitude * std::max(1.0, wanted / (any.amplitude + 1e-300));
            const double thin = std::min(any.sigma[0], any.sigma[1]) *
                                std::sqrt(1 - any.correlation * any.correlation);
            RC_ASSERT(std::fabs(field_at(field, x, y) - wanted) <= scale * (1e-9 + 1e-14 / thin));
        }
    }));
}

TEST(TowerField, RowsAreWhatTheirPlacesAre) {
    EXPECT_TRUE(rc::check([] {
        const std::vector<Tower> towers = {any_tower(), any_tower(), any_tower()};
        const TowerField field(towers);
        std::vector<double> x;
        const int count = *rc::gen::inRange(1, 700);
        for (int i = 0; i < count; ++i) x.push_back((i + 0.5) / count);
        const double y = any_number(0, 1);
        std::vector<double> row(x.size(), 0.0);
        field.add_row(y, x, row.data());
        for (const std::size_t i : {std::size_t{0}, x.size() / 2, x.size() - 1}) {
            RC_ASSERT(row[i] == field_at(field, x[i], y));
        }
    }));
}

TEST(TowerField, IsPeriodic) {
    EXPECT_TRUE(rc::check([] {
        const Tower any = any_tower();
        const TowerField field(std::array{any});
        const double x = any_number(0, 1);
        const double y = any_number(0, 1);
        const double thin =
            std::min(any.sigma[0], any.sigma[1]) * std::sqrt(1 - any.correlation * any.correlation);
        const double here = field_at(field, x, y);
        const double room = (any.amplitude + here) * (1e-9 + 1e-14 / thin);
        RC_ASSERT(std::fabs(field_at(field, x + 1, y) - here) <= room);
        RC_ASSERT(std::fabs(field_at(field, x, y - 1) - here) <= room);
    }));
}

// Both ways of summing, at the width where one gives way to the other.
TEST(TowerField, ImagesAndWavesMeet) {
    const double middle = 1 / std::sqrt(2 * std::numbers::pi);
    const TowerField images(std::array{tower(0.3, 0.6, middle, middle * (1 - 1e-12), 1)});
    const TowerField waves(std::array{tower(0.3, 0.6, middle, middle * (1 + 1e-12), 1)});
    for (int i = 0; i < 50; ++i) {
        const double x = i / 50.0;
        EXPECT_NEAR(field_at(images, x, 0.37 * x), field_at(waves, x, 0.37 * x), 1e-10);
    }
}

TEST(TowerField, OlajosTowersLeaveNoSeam) {
    const TowerField field(std::array{tower(0.2, 0.3, std::sqrt(0.001), std::sqrt(0.004), 0.4),
                                      tower(0.6, 0.4, std::sqrt(0.008), std::sqrt(0.01), 0.4),
                                      tower(0.3, 0.8, std::sqrt(0.008), std::sqrt(0.002), 0.2)});
    for (int i = 0; i < 100; ++i) {
        const double t = i / 100.0;
        EXPECT_NEAR(field_at(field, 0, t), field_at(field, 1, t), 1e-11);
        EXPECT_NEAR(field_at(field, t, 0), field_at(field, t, 1), 1e-11);
    }
    // 7.2e-4 without images.
    const double alone = 0.2 * std::exp(-0.2 * 0.2 / (2 * 0.002));
    EXPECT_GT(field_at(field, 0.3, 0.0), alone);
}

}  // namespace
}  // namespace skybake::cloud
