// Traces the skies of many airs, which tests hold solutions and tables to (tests/data).
//
//   sky_truths FOLDER [MEAN_PATHS [SCENARIO ...]]
//
// A sky becomes FOLDER/truth_sky_SCENARIO.csv, unless that is there; without scenarios, all of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "config/recipe/recipe.h"
#include "tests/support/sky_truth.h"

namespace skybake {
namespace {

constexpr double kAltitudeKm = 0.5;

struct Scenario {
    std::string name;
    std::string preset;
    std::vector<std::string> settings;
    enum class Suns {
        all,
        to_the_horizon,      // below it, dense air is dark and its truth takes hours
        two_domes,           // at 45 and 89 degrees, in 89 directions each
        three_near_ground,   // at 30, 80 and 89 degrees, in 39 directions each from 50 m
        twilight_from_high,  // from 92 to 99 degrees, from altitudes of 5, 20 and 80 km
    } suns = Suns::all;
};

const std::vector<Scenario>& scenarios() {
    const std::string black = "atmosphere.ground_albedo=0";
    const std::string mie_scattering = "atmosphere.layers.mie.scattering=\"3.996e-5 /m\"";
    const std::string mie_extinction = "atmosphere.layers.mie.extinction=\"4.44e-5 /m\"";
    using Suns = Scenario::Suns;
    static const std::vector<Scenario> all = {
        {"earth", "earth_hillaire", {black}},
        {"earth_albedo", "earth_hillaire", {}},
        {"earth_twilight", "earth_hillaire", {}, Suns::twilight_from_high},
        {"mars", "mars_rgb", {}},
        {"mars_dome", "mars_rgb", {}, Suns::two_domes},
        {"air_10x",
         "earth_hillaire",
         {black,
          "atmosphere.layers.rayleigh.scattering=[\"5.802e-5 /m\", \"1.3558e-4 /m\", "
          "\"3.31e-4 /m\"]"},
         Suns::to_the_horizon},
        {"air_50x", "dense_earth", {black}, Suns::to_the_horizon},
        {"tiny_planet", "tiny_planet", {}},
        {"mie_10x_g0",
         "earth_hillaire",
         {black, mie_scattering, mie_extinction, "atmosphere.layers.mie.g=0"}},
        {"mie_10x_g08", "earth_hillaire", {black, mie_scattering, mie_extinction}},
        {"mie_10x_g095",
         "earth_hillaire",
         {black, mie_scattering, mie_extinction, "atmosphere.layers.mie.g=0.95"}},
        {"haze_g09",
         "earth_hillaire",
         {"atmosphere.layers.mie.scattering=\"0.1 /km\"",
          "atmosphere.layers.mie.extinction=\"0.104 /km\"", "atmosphere.layers.mie.g=0.9"},
         Suns::three_near_ground},
        {"haze_g097",
         "earth_hillaire",
         {"atmosphere.layers.mie.scattering=\"0.048 /km\"",
          "atmosphere.layers.mie.extinction=\"0.05 /km\"", "atmosphere.layers.mie.g=0.97"},
         Suns::three_near_ground},
        {"ground_fog",
         "earth_hillaire",
         {"atmosphere.layers.mie.scattering=\"3 /km\"",
          "atmosphere.layers.mie.extinction=\"3 /km\"",
          "atmosphere.layers.mie.phase=\"henyey_greenstein\"",
          "atmosphere.layers.mie.scale_height=\"0.1 km\"", "atmosphere.layers.mie.g=0.85"},
         Suns::three_near_ground},
        {"mars_storm",
         "mars_rgb",
         {"atmosphere.layers.dust.scattering=[\"1.75695e-4 /m\", \"1.67586e-4 /m\", "
          "\"1.36952e-4 /m\"]",
          "atmosphere.layers.dust.g=0.75"},
         Suns::three_near_ground},
    };
    return all;
}

// Views as low as 1, 2.5 and 5 degrees below the horizontal do not meet the ground. Away from suns
// at 98 degrees and more the sky is all but black.
std::vector<SkyTruthDirection> twilight_directions() {
    std::vector<SkyTruthDirection> directions;
    for (const double altitude_km : {5., 20., 80.}) {
        const double lowest_view = altitude_km < 10 ? 91 : altitude_km < 50 ? 92.5 : 95;
        const auto more = sky_truth_directions(altitude_km, {92, 94, 96, 97, 98, 99},
                                               {0, 70, 85, 89, lowest_view}, {0, 90, 180});
        directions.insert(directions.end(), more.begin(), more.end());
    }
    std::erase_if(directions, [](const SkyTruthDirection& at) {
        return at.azimuth_degrees > 90 && at.sun_zenith_degrees > 97;
    });
    return directions;
}

std::vector<SkyTruthDirection> directions_of(const Scenario& scenario) {
    if (scenario.suns == Scenario::Suns::three_near_ground) {
        return sky_truth_directions(0.05, {30, 80, 89},
                                    {10, 30, 45, 60, 70, 75, 80, 83, 85, 87, 88, 89, 89.3},
                                    {0, 60, 180});
    }
    if (scenario.suns == Scenario::Suns::two_domes) {
        return sky_truth_directions(kAltitudeKm, {45, 89},
                                    {0, 10, 20, 30, 40, 50, 60, 70, 80, 85, 88, 89.5},
                                    {0, 15, 30, 60, 90, 120, 150, 180});
    }
    if (scenario.suns == Scenario::Suns::twilight_from_high) return twilight_directions();
    std::vector<SkyTruthDirection> directions = sky_truth_directions(kAltitudeKm);
    if (scenario.suns == Scenario::Suns::to_the_horizon) {
        std::erase_if(directions, [](const SkyTruthDirection& direction) {
            return direction.sun_zenith_degrees > 90;
        });
    }
    return directions;
}

// Six digits: more than any standard error leaves.
std::vector<SkyTruth> rounded(std::vector<SkyTruth> truth) {
    const auto round = [](double& value) {
        value = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
    };
    for (SkyTruth& value : truth) {
        for (double& order : value.orders) round(order);
        round(value.radiance);
        round(value.standard_error);
    }
    return truth;
}

// Paths are traced in blocks of this size (path_tracer.cpp). Whole blocks keep all threads busy.
constexpr std::int64_t kBlock = 1024;
constexpr std::int64_t kMostPilotPaths = 4 * kBlock;
constexpr std::int64_t kPilotShare = 16;
// Each direction has its own seed. Pilot paths have other seeds, so that no path is counted that
// decided the number of paths.
constexpr std::uint64_t kPilotSeeds = std::uint64_t{1} << 32;

// Returns the RMS over channels of (standard error / radiance), or 0 if all channels are black.
double relative_spread(const std::vector<SkyTruth>& channels) {
    double squares = 0;
    int lit = 0;
    for (const SkyTruth& truth : channels) {
        if (!(truth.radiance > 0)) continue;
        const double spread = truth.standard_error / truth.radiance;
        squares += spread * spread;
        ++lit;
    }
    return lit == 0 ? 0 : std::sqrt(squares / lit);
}

// Traces `mean_paths` paths per direction on average. The relative error of direction i is s_i /
// sqrt(n_i) for n_i paths; s_i is a hundred times larger in deep twilight than by day. Equal n_i would
// leave twilight very noisy; n_i in proportion to s_i^2 would make all errors equally bad. n_i in
// proportion to s_i is a compromise.
std::vector<SkyTruth> trace_within(const SkyMedium& medium,
                                   const std::vector<SkyTruthDirection>& directions,
                                   std::int64_t mean_paths) {
    const std::int64_t pilot_paths =
        std::clamp(mean_paths / kPilotShare, std::int64_t{2}, kMostPilotPaths);
    std::vector<double> spreads;
    double sum = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        spreads.push_back(relative_spread(
            trace_sky_truth(medium, {directions[i]}, {kPilotSeeds + i, pilot_paths}, 0)));
        sum += spreads.back();
    }
    const double all_paths = static_cast<double>(mean_paths) * static_cast<double>(spreads.size());
    std::vector<SkyTruth> result;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double share = sum > 0 ? spreads[i] / sum * all_paths : 0;
        std::int64_t paths = std::max(static_cast<std::int64_t>(share), pilot_paths);
        if (paths > kBlock) paths = (paths + kBlock - 1) / kBlock * kBlock;
        const auto traced = trace_sky_truth(medium, {directions[i]}, {i, paths}, 0);
        result.insert(result.end(), traced.begin(), traced.end());
    }
    return result;
}

std::string settings_text(const Scenario& scenario) {
    std::string text = "preset " + scenario.preset;
    for (const std::string& setting : scenario.settings) text += ", " + setting;
    return text;
}

// Whether the truth is there, now or before.
bool make_truth(const Scenario& scenario, const SkyMedium& medium,
                const std::filesystem::path& folder, std::int64_t mean_paths) {
    const auto path = folder / ("truth_sky_" + scenario.name + ".csv");
    if (std::filesystem::exists(path)) return true;
    const auto truth = rounded(trace_within(medium, directions_of(scenario), mean_paths));
    const auto written = write_file_atomically(
        path, sky_truth_csv(truth, fmt::format("rad in 1/sr, E_sun = 1; {}; {} paths a direction "
                                               "on average, more where they are needed; view "
                                               "rays never include the ground they hit",
                                               settings_text(scenario), mean_paths)));
    return written.value.has_value();
}

int run(const std::filesystem::path& folder, std::int64_t mean_paths,
        const std::vector<std::string>& wanted) {
    for (const Scenario& scenario : scenarios()) {
        if (!wanted.empty() &&
            std::find(wanted.begin(), wanted.end(), scenario.name) == wanted.end()) {
            continue;
        }
        const auto recipe = config::parse_recipe("preset = \"" + scenario.preset + "\"\n",
                                                 scenario.name, {}, scenario.settings);
        const SkyMedium medium = make_sky_medium(recipe.value->parameters.atmosphere);
        if (!make_truth(scenario, medium, folder, mean_paths)) {
            fmt::print(stderr, "{}: its table cannot be written\n", scenario.name);
            return 1;
        }
    }
    return 0;
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "sky_truths FOLDER [MEAN_PATHS [SCENARIO ...]]\n");
        return 2;
    }
    const std::int64_t mean_paths = argc > 2 ? std::atoll(argv[2]) : 131072;
    return skybake::run(argv[1], std::max<std::int64_t>(mean_paths, 2),
                        {argv + std::min(argc, 3), argv + argc});
}
