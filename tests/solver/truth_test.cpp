// Solved light against light that was traced path by path (tests/data/truth_*.csv).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solve_light.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

std::vector<std::vector<double>> rows_of(const std::string& name) {
    std::ifstream file(std::string(SKYBAKE_TEST_DATA "/") + name);
    std::vector<std::vector<double>> rows;
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#' || line[0] == 'h') continue;
        std::istringstream cells(line);
        std::string cell;
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    EXPECT_GT(rows.size(), 50U) << name;
    return rows;
}

SkyMedium black_earth() {
    return make_sky_medium(test::preset_atmosphere("earth", {"atmosphere.ground_albedo=0"}));
}

TEST(SolvedLightTruth, MeanRadiance) {
    const SolvedLight light = solve_light(black_earth(), {}, 0);
    double chi_square = 0;
    int count = 0;
    for (const std::vector<double>& row : rows_of("truth_mslut_setH0.csv")) {
        const auto channel = static_cast<std::size_t>(row[2]);
        const double value =
            light.mean_radiance_at(row[0], std::cos(row[1] * test::kDegree))[channel];
        // The grid's own error beside the standard error; where a few paths found all the light,
        // that says nothing.
        if (row[5] > 0.1 * row[4]) continue;
        const double sigma = std::hypot(row[5], 2e-3 * row[4]);
        chi_square += std::pow((value - row[4]) / sigma, 2);
        EXPECT_LT(std::fabs(value - row[4]), 5 * sigma) << row[0] << ' ' << row[1];
        ++count;
    }
    EXPECT_GT(count, 100);
    EXPECT_LT(chi_square / count, 1.6);
}

struct Errors {
    double median;
    double ninth_decile;
};

Errors sky_errors(const SkyMedium& medium, const HigherOrders& orders,
                  const std::vector<std::vector<double>>& truth, double last_sun) {
    const SkyIntegrator integrator(medium, &orders);
    std::vector<double> errors;
    for (const std::vector<double>& row : truth) {
        if (row[1] > last_sun) continue;
        const auto turns = [](double degrees) { return degrees * test::kDegree; };
        const SunZenith sun{std::cos(turns(row[1])), std::sin(turns(row[1]))};
        const SkyRadiance radiance =
            integrator.radiance(row[0], sun,
                                sky_direction(sun, std::cos(turns(row[2])), std::sin(turns(row[2])),
                                              std::cos(turns(row[3]))));
        const auto c = static_cast<std::size_t>(row[4]);
        errors.push_back(std::fabs((radiance.single[c] + radiance.multiple[c]) / row[11] - 1));
    }
    std::sort(errors.begin(), errors.end());
    return {errors[errors.size() / 2], errors[errors.size() * 9 / 10]};
}

// Of these paths' own standard error a perfect sky would have 0.1 and 1.3 %, and 0.1 and 0.2 % up
// to the sun at the horizon.
TEST(SolvedLightTruth, Sky) {
    const SkyMedium medium = black_earth();
    const auto truth = rows_of("truth_sky_setH0_h0.5.csv");
    SolverSettings settings;
    settings.degree = 8;
    const SolvedLight light = solve_light(medium, settings, 0);
    const auto moments = [&](int degree) {
        return sky_errors(medium, SolvedOrders(medium, light, degree), truth, 90);
    };
    EXPECT_LT(moments(8).median, 1.5e-3);
    EXPECT_LT(moments(8).ninth_decile, 4e-3);
    EXPECT_LT(moments(4).median, 2.5e-3);
    EXPECT_LT(moments(4).ninth_decile, 7e-3);
    EXPECT_LT(moments(2).median, 4e-3);
    EXPECT_LT(moments(2).ninth_decile, 1.5e-2);
    const Errors all = sky_errors(medium, SolvedOrders(medium, light, 8), truth, 96);
    EXPECT_LT(all.median, 2.5e-3);
    EXPECT_LT(all.ninth_decile, 1.8e-2);
    const IsotropicOrders mean(medium.air, [&](double altitude_km, double sun_cos_zenith) {
        return light.mean_radiance_at(altitude_km, sun_cos_zenith);
    });
    const Errors drop_in = sky_errors(medium, mean, truth, 96);
    EXPECT_LT(drop_in.median, 0.021);
    EXPECT_LT(drop_in.ninth_decile, 0.057);
}

}  // namespace
}  // namespace skybake
