// Skies made with fitted tables, from cameras and under suns that the fit has not seen, against
// the solved light; the limits where a fit must do nothing.
#include "bakers/assets/multiple_scattering/fitted_radiance.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/assets/multiple_scattering/positive_least_squares.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/quadrature.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using config::MultipleScatteringMapping;
using test::kDegree;
using test::preset_atmosphere;
using test::uniform;

constexpr MultipleScatteringMapping kTwilight = MultipleScatteringMapping::twilight;

FitAxes twilight_axes(int width, int height, double thickness_km) {
    FitAxes axes;
    for (int x = 0; x < width; ++x) {
        axes.sun_cos_zenith_of_columns.push_back(
            sun_cos_zenith_at(kTwilight, width > 1 ? x / (width - 1.0) : 0.5));
    }
    for (int y = 0; y < height; ++y) {
        axes.altitudes_km_of_rows.push_back(height > 1 ? thickness_km * y / (height - 1.0)
                                                       : 0.5 * thickness_km);
    }
    axes.column_of = [width](double cosine) {
        return sun_coordinate(kTwilight, cosine) * (width - 1);
    };
    return axes;
}

SolvedLight solved(const SkyMedium& medium, int degree = 8, int suns = 48) {
    SolverSettings settings;
    settings.degree = degree;
    settings.suns = suns;
    settings.level_scale = suns < 48 ? 0.5 : 1;  // where only the table's fit is asked about
    return solve_light(medium, settings, 2);
}

// The error of a table's skies, RMS over the sky as a share of its mean, for one sun from some
// cameras.
class Judge {
  public:
    Judge(const SkyMedium& medium, const SolvedLight& light, std::vector<double> cameras_km)
        : medium_(medium), truth_(medium, light, 8), cameras_km_(std::move(cameras_km)) {}

    Spectrum error(const Image2<double>& table, double sun_zenith) const {
        Image2<float> stored(table.width, table.height, table.channels);
        std::transform(table.texels.begin(), table.texels.end(), stored.texels.begin(),
                       [](double value) { return static_cast<float>(value); });
        const TableOrders orders(medium_, stored, 0, [this](double altitude_km, double cosine) {
            return TablePlace{sun_coordinate(kTwilight, cosine),
                              altitude_km / medium_.air.thickness_km};
        });
        const SkyIntegrator with_truth(medium_, &truth_);
        const SkyIntegrator with_table(medium_, &orders);
        const SunZenith sun = {std::cos(sun_zenith), std::sin(sun_zenith)};
        Spectrum squares{};
        for (const double camera_km : cameras_km_) {
            Spectrum mean{};
            Spectrum square{};
            for_each_direction(sun, [&](const SkyDirection& direction, double share) {
                const SkyRadiance wanted = with_truth.radiance(camera_km, sun, direction);
                const SkyRadiance found = with_table.radiance(camera_km, sun, direction);
                const Spectrum difference = found.multiple - wanted.multiple;
                mean += share * (wanted.single + wanted.multiple);
                square += share * difference * difference;
            });
            squares += share_of(square, mean * mean);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            squares[c] = std::sqrt(squares[c] / static_cast<double>(cameras_km_.size()));
        }
        return squares;
    }

  private:
    template <class Use>
    static void for_each_direction(const SunZenith& sun, const Use& use) {
        constexpr int kAzimuths = 4;
        const QuadratureRule rule = gauss_legendre(8);
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double mu = rule.nodes[i] * rule.nodes[i];
            const double share = 2 * rule.nodes[i] * rule.weights[i] / kAzimuths;
            for (int j = 0; j < kAzimuths; ++j) {
                const double azimuth = std::numbers::pi * (j + 0.6) / kAzimuths;
                use(sky_direction(sun, mu, std::sqrt((1 - mu) * (1 + mu)), std::cos(azimuth)),
                    share);
            }
        }
    }

    const SkyMedium& medium_;
    SolvedOrders truth_;
    std::vector<double> cameras_km_;
};

Image2<double> mean_table(const SolvedLight& light, const FitAxes& axes) {
    Image2<double> table(static_cast<int>(axes.width()), static_cast<int>(axes.height()),
                         light.channels);
    for (int y = 0; y < table.height; ++y) {
        for (int x = 0; x < table.width; ++x) {
            const Spectrum psi =
                light.mean_radiance_at(axes.altitudes_km_of_rows[static_cast<std::size_t>(y)],
                                       axes.sun_cos_zenith_of_columns[static_cast<std::size_t>(x)]);
            for (int c = 0; c < table.channels; ++c) {
                table.texel(x, y)[c] = std::max(psi[static_cast<std::size_t>(c)], 0.0);
            }
        }
    }
    return table;
}

struct Bar {
    double sun_zenith_degrees;
    glm::dvec3 error;  // of each channel
};

void expect_within(const config::Atmosphere& atmosphere, const std::vector<Bar>& bars) {
    const SkyMedium medium = make_sky_medium(atmosphere);
    const SolvedLight light = solved(medium);
    const FitAxes axes = twilight_axes(64, 32, medium.air.thickness_km);
    const Image2<double> fitted = fit_mean_radiance(medium, light, FitScene{}, axes, {}, 2);
    const Image2<double> mean = mean_table(light, axes);
    const Judge judge(medium, light, {0.05, 2.4});
    for (const Bar& bar : bars) {
        const Spectrum error = judge.error(fitted, bar.sun_zenith_degrees * kDegree);
        const Spectrum without = judge.error(mean, bar.sun_zenith_degrees * kDegree);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LE(error[c], bar.error[c])
                << bar.sun_zenith_degrees << " degrees, channel " << c;
            EXPECT_LT(error[c], without[c]) << bar.sun_zenith_degrees << " degrees, channel " << c;
        }
    }
}

// Red sees most of the haze, whose forward light no isotropic table has.
const std::vector<Bar> kEarthBars = {
    {30, {0.010, 0.010, 0.010}}, {89, {0.033, 0.022, 0.020}}, {94, {0.035, 0.030, 0.025}}};

TEST(FittedRadiance, MakesUnseenSkiesOfEarthRight) {
    expect_within(preset_atmosphere("earth_hillaire"), kEarthBars);
}

TEST(FittedRadiance, MakesUnseenSkiesOverBlackGroundRight) {
    expect_within(preset_atmosphere("earth_hillaire", {"atmosphere.ground_albedo=0"}), kEarthBars);
}

TEST(FittedRadiance, HazeThatScattersLikeAirIsFittedBetter) {
    expect_within(
        preset_atmosphere("earth_hillaire", {"atmosphere.layers.mie.g=0"}),
        {{30, {0.005, 0.005, 0.006}}, {89, {0.011, 0.015, 0.020}}, {94, {0.012, 0.017, 0.021}}});
}

// Mean squares of the errors of all rays of a sample, as shares of the brightest ray of that sun.
Spectrum mean_square(const std::vector<ViewEquations>& views, const FitSample& sample,
                     const Image2<double>& table) {
    std::vector<Spectrum> brightest(sample.suns.size());
    const auto channels = static_cast<std::size_t>(table.channels);
    const auto sun_of = [&](std::size_t ray) { return ray / sample.azimuth_cosines.size(); };
    for (const ViewEquations& view : views) {
        for (std::size_t i = 0; i < view.multiple.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                double& most = brightest[sun_of(i)][c];
                most = std::max(most, view.single[i][c] + view.multiple[i][c]);
            }
        }
    }
    Spectrum sum{};
    for (const ViewEquations& view : views) {
        for (std::size_t i = 0; i < view.multiple.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                double error = -view.multiple[i][c];
                for (std::size_t t = view.first_term[i]; t < view.first_term[i + 1]; ++t) {
                    error += view.weights[t][c] * table.texels[view.texels[t] * channels + c];
                }
                const double share = error / brightest[sun_of(i)][c];
                sum[c] += share * share;
            }
        }
    }
    return sum;
}

TEST(FittedRadiance, IsBetterThanTheMeanRadianceOnOtherPlanets) {
    for (const char* preset : {"mars_rgb", "tiny_planet", "dense_earth"}) {
        const SkyMedium medium = make_sky_medium(preset_atmosphere(preset));
        const SolvedLight light = solved(medium, 4, 32);
        const FitAxes axes = twilight_axes(32, 32, medium.air.thickness_km);
        const Image2<double> fitted = fit_mean_radiance(medium, light, FitScene{}, axes, {}, 2);
        for (const double value : fitted.texels) ASSERT_GE(value, 0) << preset;
        FitSample unseen =
            sample_scene(shell_of(medium.air), light.suns, {0.2, 2.5, 0, 0}, {2, 4, 0, 3, 1});
        unseen.suns.clear();
        for (double degrees = 1; degrees < 100; degrees += 1.7) {
            unseen.suns.push_back({std::cos(degrees * kDegree), std::sin(degrees * kDegree)});
        }
        std::vector<ViewEquations> views;
        for (const FitView& view : unseen.views) {
            views.push_back(view_equations(medium, light, unseen, view, axes));
        }
        const Spectrum error = mean_square(views, unseen, fitted);
        const Spectrum without = mean_square(views, unseen, mean_table(light, axes));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(error[c], without[c]) << preset;
    }
}

TEST(FittedRadiance, IsTheMeanRadianceWhereTheSceneSaysNothing) {
    const SkyMedium medium = make_sky_medium(preset_atmosphere("earth_hillaire"));
    const SolvedLight light = solved(medium, 4, 32);
    const FitAxes axes = twilight_axes(32, 16, medium.air.thickness_km);
    const Image2<double> mean = mean_table(light, axes);
    // Points of the air are at most 13 degrees of the planet away: 73 degrees at sunset's side.
    const FitScene scene = {0, 3, 0, 60 * kDegree};
    const Image2<double> fitted = fit_mean_radiance(medium, light, scene, axes, {}, 2);
    int changed = 0;
    for (int y = 0; y < mean.height; ++y) {
        for (int x = 0; x < mean.width; ++x) {
            const bool night = axes.sun_cos_zenith_of_columns[static_cast<std::size_t>(x)] < 0;
            for (int c = 0; c < mean.channels; ++c) {
                const bool same = fitted.texel(x, y)[c] == mean.texel(x, y)[c];
                EXPECT_TRUE(same || !night) << x << ' ' << y;
                changed += !same;
            }
        }
    }
    EXPECT_GT(changed, 0);
}

TEST(FittedRadiance, ThreadsDoNotChangeABit) {
    const SkyMedium medium = make_sky_medium(preset_atmosphere("earth_hillaire"));
    const SolvedLight light = solved(medium, 4, 32);
    const FitAxes axes = twilight_axes(16, 9, medium.air.thickness_km);
    const Image2<double> one = fit_mean_radiance(medium, light, FitScene{}, axes, {}, 1);
    const Image2<double> three = fit_mean_radiance(medium, light, FitScene{}, axes, {}, 3);
    EXPECT_EQ(one.texels, three.texels);
}

TEST(FittedRadiance, AVacuumHasNone) {
    const SkyMedium medium = make_sky_medium(preset_atmosphere("vacuum"));
    const SolvedLight light = solved(medium, 4, 16);
    const FitAxes axes = twilight_axes(8, 8, medium.air.thickness_km);
    EXPECT_EQ(fit_mean_radiance(medium, light, FitScene{}, axes, {}, 1).texels,
              mean_table(light, axes).texels);
}

// Any air, any cameras up to space, any suns, tables of a single texel.
TEST(FittedRadiance, IsNeverNegative) {
    EXPECT_TRUE(rc::check("never negative, never NaN", [] {
        const SkyMedium medium = make_sky_medium(test::random_atmosphere());
        const SolvedLight light = solved(medium, 2, 8);
        const double thickness_km = medium.air.thickness_km;
        FitScene scene;
        scene.lowest_camera_km = *rc::gen::arbitrary<bool>() ? 0 : thickness_km * uniform(0, 1);
        scene.highest_camera_km = scene.lowest_camera_km + thickness_km * uniform(0, 3);
        scene.largest_sun_zenith = uniform(0, std::numbers::pi);
        scene.smallest_sun_zenith = scene.largest_sun_zenith * uniform(0, 1);
        const FitAxes axes =
            twilight_axes(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), thickness_km);
        FitSettings settings;
        settings.density = {2, 3, 1, 2, 1};
        const Image2<double> fitted = fit_mean_radiance(medium, light, scene, axes, settings, 1);
        for (const double value : fitted.texels) RC_ASSERT(value >= 0);
    }));
}

// Views of a known table give the table back, as far as they see it.
TEST(FitEquations, AnIsotropicTableIsRecovered) {
    const SkyMedium medium = make_sky_medium(preset_atmosphere("earth_hillaire"));
    const SolvedLight light = solved(medium, 2, 48);
    const Shell shell = shell_of(medium.air);
    const FitAxes axes = twilight_axes(16, 8, medium.air.thickness_km);
    std::vector<double> known;
    for (std::size_t i = 0; i < axes.texels(); ++i) {
        known.push_back(1 + 0.5 * std::sin(1.7 * static_cast<double>(i)));
    }
    const FitSample sample = sample_scene(shell, light.suns, {0, 60, 0, 1.8}, {5, 8, 4, 4, 2});
    SparseEquations equations;
    std::vector<double> seen(axes.texels());
    for (const FitView& view : sample.views) {
        const ViewEquations rays = view_equations(medium, light, sample, view, axes);
        for (std::size_t i = 0; i < rays.multiple.size(); ++i) {
            double target = 0;
            for (std::size_t t = rays.first_term[i]; t < rays.first_term[i + 1]; ++t) {
                equations.add_term(rays.texels[t], rays.weights[t][1]);
                target += rays.weights[t][1] * known[rays.texels[t]];
                seen[rays.texels[t]] += rays.weights[t][1] * rays.weights[t][1];
            }
            equations.end_equation(target);
        }
    }
    const Restraint restraint = {std::vector<double>(axes.texels(), 1e-9), {}};
    const std::vector<double> found = positive_least_squares(equations, restraint, 1e-7);
    int recovered = 0;
    for (std::size_t i = 0; i < axes.texels(); ++i) {
        if (seen[i] < 1e-3) continue;
        EXPECT_NEAR(found[i], known[i], 1e-3) << i;
        ++recovered;
    }
    EXPECT_GT(recovered, 20);
}

TEST(SolvedSource, IsWhatSolvedOrdersScatter) {
    const SkyMedium medium = make_sky_medium(preset_atmosphere("earth_hillaire"));
    const SolvedLight light = solved(medium, 6, 32);
    const SolvedOrders orders(medium, light, 6);
    std::vector<std::vector<Spectrum>> moments;
    for (const SkyLayer& layer : medium.layers) moments.push_back(legendre_moments(layer.phase, 6));
    EXPECT_TRUE(rc::check("the same as point by point", [&] {
        ScatteringPoint point;
        point.altitude_km = uniform(0, medium.air.thickness_km);
        point.sun_cos_zenith = uniform(-1, 1);
        point.view_cos_zenith = uniform(-1, 1);
        point.azimuth_cosine = uniform(-1, 1);
        std::vector<Spectrum> scattering;
        for (std::size_t k = 0; k < medium.layers.size(); ++k) {
            scattering.push_back({uniform(0, 1), uniform(0, 1), uniform(0, 1), 0});
        }
        const Spectrum wanted = orders.scattered(point, scattering);
        const SolvedSource source(light, point.altitude_km, point.view_cos_zenith, scattering,
                                  moments);
        const Spectrum found = source.scattered(point.sun_cos_zenith, point.azimuth_cosine);
        for (std::size_t c = 0; c < 3; ++c) {
            RC_ASSERT(std::fabs(found[c] - wanted[c]) <= 1e-13 + 1e-9 * std::fabs(wanted[c]));
        }
    }));
}

}  // namespace
}  // namespace skybake
