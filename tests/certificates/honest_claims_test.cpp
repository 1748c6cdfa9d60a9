// Whether the largest error and the root mean square of lookups that `--certify=quick` claims are
// those that dense measurements find, on random atmospheres, sizes, mappings, cameras and suns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"
#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"
#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/assets/bruneton/scattering_volume.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/relative_error.h"
#include "config/assets/multiple_scattering.h"
#include "tests/certificates/dense_measurement.h"
#include "tests/light/sky_media.h"

namespace skybake::test {
namespace {

constexpr BakeOptions kOptions{.threads = 2, .certification = Certification::quick};

// What a certificate claims, what a dense measurement finds, and what points spread evenly claim.
struct Claim {
    ErrorFigures claimed;
    ErrorFigures dense;
    ErrorFigures even;
};

Baked empty_table() {
    Baked table;
    table.name = "a";
    table.channel_names = {"R", "G", "B"};
    return table;
}

Baked value_of(config::Outcome<Baked> outcome) {
    for (const config::Diagnostic& diagnostic : outcome.diagnostics) {
        if (diagnostic.severity == config::Severity::error) ADD_FAILURE() << diagnostic.message;
    }
    return std::move(outcome.value).value();
}

// Bakes with texels within 1 % or, where no quadrature is as fine as that, within 50 %.
template <class Asset, class Bake>
Baked as_fine_as_possible(Asset& asset, const Bake& bake) {
    asset.max_texel_error = 0.01;
    config::Outcome<Baked> outcome = bake();
    if (outcome.value) return std::move(*outcome.value);
    asset.max_texel_error = 0.5;
    return value_of(bake());
}

ValueRow kernel_row(const TableModel& model, int level) {
    return [&model, level](double y, const std::vector<double>& x, double* values) {
        model.row(level, y, x, values);
    };
}

Claim claim_of(const TableModel& model, const Baked& table, const ValueRow& row, PointCounts even,
               RandomCase& random) {
    constexpr int kPerTexel = 3;
    return {table.certificate.lookup, measure_densely(model, table.image(), row, kPerTexel, random),
            claimed_by_even_points(model, table.image(), row, even)};
}

Claim transmittance(RandomCase& random) {
    const Medium medium = make_medium(random.atmosphere());
    config::TransmittanceBake bake;
    bake.size = {random.even(16, 256), random.even(8, 64)};
    bake.mapping = static_cast<config::TransmittanceMapping>(random.below(2));
    bake.content = static_cast<config::TransmittanceContent>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = value_of(bake_transmittance(medium, bake, kOptions, empty_table()));
    const TableModel model = transmittance_model(medium, bake);
    return claim_of(model, table, kernel_row(model, 0), {1024, 1}, random);
}

Claim multiple_scattering(RandomCase& random) {
    const Medium medium = make_medium(random.atmosphere());
    config::MultipleScatteringBake bake;
    bake.size = {random.even(12, 48), random.even(8, 32)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = as_fine_as_possible(
        bake, [&] { return bake_multiple_scattering(medium, bake, kOptions, empty_table()); });
    const TableModel model = multiple_scattering_model(medium, bake, kOptions.threads);
    return claim_of(model, table, kernel_row(model, 6), {8, 8}, random);
}

Claim solved_scattering(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::MultipleScatteringBake bake;
    bake.method = config::MultipleScatteringMethod::solved;
    bake.size = {random.even(12, 64), random.even(8, 64)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table =
        value_of(bake_solved_scattering(atmosphere, {}, bake, kOptions, empty_table()));
    const SkyMedium medium = make_sky_medium(atmosphere);
    const SolvedLight light = solve_light(medium, finer({}), kOptions.threads);
    const SunColumns columns = sun_columns(bake.mapping, {}, shell_of(medium.air));
    TableModel model;
    model.channels = 3;
    model.error = relative_error;
    model.reference = [&](double y, const std::vector<double>& x, double* values) {
        for (const double at : x) {
            const Spectrum mean =
                light.mean_radiance_at(y * medium.air.thickness_km, columns.cosine(at));
            for (std::size_t c = 0; c < 3; ++c) *values++ = mean[c];
        }
    };
    return claim_of(model, table, model.reference, {32, 16}, random);
}

config::SkyOrders random_orders(RandomCase& random) {
    return random.below(2) == 0 ? config::SkyOrders::single : config::SkyOrders::all;
}

Claim sky_view(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::SkyViewBake bake;
    bake.orders = random_orders(random);
    const TestSky sky(atmosphere, bake.orders);
    bake.size = {random.even(16, 48), random.even(16, 64)};
    bake.altitude = {1000 * sky.light().shell().thickness_km * random.log_uniform(1e-4, 2)};
    bake.sun_elevations = {{kDegree * random.uniform(-12, 90)}};
    bake.pixel_type = config::PixelType::float32;
    const Baked table = value_of(bake_sky_view(sky.light(), bake, kOptions, empty_table()));
    const SkyViewCamera camera(sky.light().shell(), bake.altitude.kilometers());
    const TableModel model =
        sky_view_model(sky.light(), camera, sun_at_elevation(bake.sun_elevations[0].radians));
    return claim_of(model, table, kernel_row(model, 0), {256, 1}, random);
}

Claim environment(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::EnvironmentBake bake;
    bake.orders = random_orders(random);
    const TestSky sky(atmosphere, bake.orders);
    bake.size = {random.even(16, 48), random.even(8, 32)};
    bake.altitude = {1000 * sky.light().shell().thickness_km * random.log_uniform(1e-4, 2)};
    bake.sun_elevation = {kDegree * random.uniform(-12, 90)};
    bake.pixel_type = config::PixelType::float32;
    const Baked table = value_of(bake_environment(sky.light(), bake, kOptions, empty_table()));
    const SkyViewCamera camera(sky.light().shell(), bake.altitude.kilometers());
    const TableModel model =
        environment_model(sky.light(), camera, sun_at_elevation(bake.sun_elevation.radians));
    return claim_of(model, table, kernel_row(model, 0), {256, 1}, random);
}

Claim irradiance(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::IrradianceBake bake;
    bake.content =
        random.below(3) == 0 ? config::IrradianceContent::direct : config::IrradianceContent::sky;
    bake.orders = random_orders(random);
    const TestSky sky(atmosphere, orders_of(bake));
    bake.size = {random.even(8, 20), random.even(4, 12)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = as_fine_as_possible(
        bake, [&] { return bake_irradiance(sky.light(), bake, kOptions, empty_table()); });
    const TableModel model = irradiance_model(sky.light(), bake);
    return claim_of(model, table, kernel_row(model, 1), {8, 8}, random);
}

// Of views, suns and cosines to the sun that are spread evenly.
ErrorFigures measure_scattering_densely(const ScatteringMapping& mapping, const DenseVolume& table,
                                        const TexelRow& row, const ExactTexel& exact,
                                        RandomCase& random) {
    const std::vector<double> scale = largest_values(table);
    constexpr int kViews = 384;
    constexpr int kSuns = 160;
    std::vector<ScatteringView> views;
    std::vector<std::vector<double>> suns(kViews);
    std::vector<std::vector<double>> nu(kViews);
    DenseErrors errors;
    const auto error_at = [&](std::size_t i, std::size_t k, const Texel& wanted, double* square) {
        const Texel found =
            look_up(table, mapping, mapping.coordinates(views[i], suns[i][k], nu[i][k]),
                    config::PixelType::float32);
        double largest = 0;
        for (std::size_t c = 0; c < table.channels(); ++c) {
            const double error = relative_error(found[c], wanted[c], scale[c]);
            largest = std::max(largest, std::fabs(error));
            *square += error * error / static_cast<double>(table.channels());
        }
        return largest;
    };
    for (std::size_t i = 0; i < kViews; ++i) {
        views.push_back(
            mapping.view(random.uniform(0, 1), random.below(2) == 0, random.uniform(0, 1)));
        const double cosine = std::clamp(
            views[i].s_km / (mapping.shell().ground_radius_km + views[i].altitude_km), -1.0, 1.0);
        for (int k = 0; k < kSuns; ++k) {
            suns[i].push_back(mapping.sun_cos_zenith((k + random.uniform(0, 1)) / kSuns));
            const FeasibleCosines range = feasible_cosines(cosine, suns[i].back());
            nu[i].push_back(random.uniform(range.low, range.high));
        }
        const std::vector<Texel> wanted = row(views[i], suns[i], nu[i]);
        for (std::size_t k = 0; k < kSuns; ++k) {
            double square = 0;
            const double largest = error_at(i, k, wanted[k], &square);
            errors.add({i, k}, 1.0 / (kViews * kSuns), largest, square);
        }
    }
    return errors.figures([&](const DenseErrors::Point& point) {
        const auto [i, k, none, nor] = point.at;
        double square = 0;
        return error_at(i, k, exact(views[i], suns[i][k], nu[i][k]), &square);
    });
}

Claim single_mie(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::BrunetonBake bake;
    bake.table = config::BrunetonTable::single_mie;
    bake.orders = 1;
    bake.nu_size = 4 + random.below(5);
    bake.size = {bake.nu_size * (8 + random.below(17)), random.even(16, 64), 8 + random.below(17)};
    bake.sun_cos_zenith_min = -0.2;
    bake.mie_layers = {atmosphere.layers.front().name};
    bake.solar_irradiance = {1, 1, 1};
    bake.pixel_type = config::PixelType::float32;
    const SkyMedium medium = make_sky_medium(atmosphere);
    const Baked volume = value_of(bake_scattering(medium, nullptr, bake, kOptions, empty_table()));
    const auto& table = static_cast<const DenseVolume&>(*volume.levels[0].voxels);
    const ScatteringContent content(medium, bake);
    const ScatteringMapping mapping(shell_of(medium.air), bake.size, bake.nu_size,
                                    bake.sun_cos_zenith_min);
    const ScatteringRows rows(medium, nullptr, true, kOptions.threads);
    const ScatteringReference reference(medium, content, nullptr);
    const ExactTexel exact = exact_texel(content, reference);
    const Certificate even = measure_scattering(table, mapping, exact, largest_values(table),
                                                config::PixelType::float32, 64, kOptions);
    return {volume.certificate.lookup,
            measure_scattering_densely(mapping, table, texel_row(content, rows), exact, random),
            even.lookup};
}

Claim aerial_perspective_volume(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::AerialPerspectiveBake bake;
    bake.orders = random_orders(random);
    const TestSky sky(atmosphere, bake.orders);
    bake.size = {8 + random.below(9), 8 + random.below(9), 8 + random.below(17)};
    const double thickness_m = 1000 * sky.light().shell().thickness_km;
    bake.altitude = {thickness_m * random.log_uniform(1e-4, 0.9)};
    bake.sun_elevation = {kDegree * random.uniform(-8, 90)};
    bake.heading = {kDegree * random.uniform(-180, 180)};
    bake.pitch = {kDegree * random.uniform(-30, 30)};
    bake.fov = {kDegree * random.uniform(30, 90)};
    bake.aspect = random.uniform(1, 2);
    bake.view_distance = {thickness_m * random.log_uniform(0.1, 3)};
    bake.slices = static_cast<config::SliceSpacing>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked volume = value_of(
        bake_aerial_perspective(sky.light(), bake, kOptions, {"R", "G", "B"}, empty_table()));
    const AerialCamera camera(bake);
    const VolumeReference exact = [&](const std::array<double, 3>& uvw) {
        const SkyRadiance at =
            aerial_perspective(sky.light(), camera, uvw[0], uvw[1], {camera.distance_km(uvw[2])})
                .front();
        const Spectrum light = sky.light().wanted(at);
        const Spectrum& passing = at.transmittance;
        return std::vector<double>{light[0], light[1], light[2],
                                   (passing[0] + passing[1] + passing[2]) / 3};
    };
    const Level& level = volume.levels.front();
    constexpr int kPoints = 12000;
    ErrorStatistics dense;
    for (int i = 0; i < kPoints; ++i) {
        const std::array<double, 3> uvw = {random.uniform(0, 1), random.uniform(0, 1),
                                           (i + random.uniform(0, 1)) / kPoints};
        for (const double error :
             shares_of_range(level, look_up(level, bake.pixel_type, uvw), exact(uvw))) {
            dense.add(error);
        }
    }
    return {volume.certificate.lookup, dense.figures(),
            measure_lookups(level, bake.pixel_type, exact, 1024, kOptions).figures};
}

// Of one asset: the ratios of each case, ascending.
class Ratios {
  public:
    void add(double dense, double claimed) {
        // Errors of the rounding of floats are no errors of lookups.
        constexpr double kRounding = 1e-7;
        all_.push_back(std::max(dense, kRounding) / std::max(claimed, kRounding));
        std::sort(all_.begin(), all_.end());
    }
    double quantile(double share) const {
        return all_[std::min(all_.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(all_.size())))];
    }
    int above(double bound) const {
        return static_cast<int>(all_.end() - std::upper_bound(all_.begin(), all_.end(), bound));
    }
    int count() const { return static_cast<int>(all_.size()); }

  private:
    std::vector<double> all_;
};

// Of claims and of points that are spread evenly.
struct AssetRatios {
    Ratios max, rms, even_max, even_rms;
};

struct Asset {
    const char* name;
    Claim (*claim)(RandomCase& random);
    int every = 1;  // of a few cases, how many have this asset
};

constexpr Asset kAssets[] = {{"transmittance", transmittance},
                             {"multiple_scattering", multiple_scattering, 4},
                             {"solved multiple_scattering", solved_scattering, 12},
                             {"sky_view", sky_view},
                             {"environment", environment},
                             {"irradiance", irradiance, 6},
                             {"bruneton single_mie", single_mie, 2},
                             {"aerial_perspective", aerial_perspective_volume}};

// The bars: nineteen in twenty claims are at most so much too small.
constexpr double kMostOfMax = 1.5;
constexpr double kMostOfRms = 1.5;

std::string three(const Ratios& ratios) {
    return fmt::format("{:5.2f} {:5.2f} {:5.2f}", ratios.quantile(0.5), ratios.quantile(0.9),
                       ratios.quantile(1));
}

using Table = std::map<std::string, AssetRatios>;

Table ratios_of(int cases, bool all) {
    Table table;
    for (const Asset& asset : kAssets) {
        if (const char* only = std::getenv("SKYBAKE_HONEST_ASSET")) {
            if (std::string(asset.name) != only) continue;
        }
        for (int i = 0; i < cases; i += all ? 1 : asset.every) {
            RandomCase random(static_cast<std::uint64_t>(i) * 7919 + 17);
            const Claim claim = asset.claim(random);
            AssetRatios& ratios = table[asset.name];
            ratios.max.add(claim.dense.max, claim.claimed.max);
            ratios.rms.add(claim.dense.rms, claim.claimed.rms);
            ratios.even_max.add(claim.dense.max, claim.even.max);
            ratios.even_rms.add(claim.dense.rms, claim.even.rms);
            if (std::getenv("SKYBAKE_HONEST_CASES") != nullptr) {
                fmt::print("{} {}: dense {:.3g} {:.3g} claimed {:.3g} {:.3g} even {:.3g} {:.3g}\n",
                           asset.name, i, claim.dense.max, claim.dense.rms, claim.claimed.max,
                           claim.claimed.rms, claim.even.max, claim.even.rms);
            }
        }
    }
    return table;
}

void print(const Table& table) {
    fmt::print(
        "measured densely over claimed: median, one in ten, worst\n{:28}{:>20}{:>20}{:>20}{:>20}\n",
        "", "largest", "RMS", "largest, even", "RMS, even");
    for (const auto& [name, ratios] : table) {
        fmt::print("{:28}{:>20}{:>20}{:>20}{:>20}\n", name, three(ratios.max), three(ratios.rms),
                   three(ratios.even_max), three(ratios.even_rms));
    }
}

int allowed(int cases) { return (cases + 19) / 20; }

TEST(HonestClaims, HoldOnTwelveAtmospheres) {
    const Table table = ratios_of(12, false);
    print(table);
    int cases = 0;
    int max_above = 0;
    int rms_above = 0;
    int even_above = 0;
    for (const auto& [name, ratios] : table) {
        cases += ratios.max.count();
        max_above += ratios.max.above(kMostOfMax);
        rms_above += ratios.rms.above(kMostOfRms);
        even_above += ratios.even_max.above(kMostOfMax);
    }
    EXPECT_LE(max_above, allowed(cases));
    EXPECT_LE(rms_above, allowed(cases));
    // Points that are spread evenly do not pass.
    EXPECT_GT(even_above, 3 * allowed(cases));
}

TEST(SlowHonestClaims, HoldOnTwoHundredAtmospheres) {
    const Table table = ratios_of(200, true);
    print(table);
    for (const auto& [name, ratios] : table) {
        EXPECT_LE(ratios.max.above(kMostOfMax), allowed(ratios.max.count())) << name;
        EXPECT_LE(ratios.rms.above(kMostOfRms), allowed(ratios.rms.count())) << name;
    }
}

}  // namespace
}  // namespace skybake::test
