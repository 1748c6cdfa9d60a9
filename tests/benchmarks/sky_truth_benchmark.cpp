// Every way to multiple scattering against path-traced skies, over many airs: the tables of
// tests/benchmarks/README.md.
//
//   sky_truth_benchmark FOLDER [MEAN_PATHS [SCENARIO ...]]
//
// Skies are read from FOLDER/truth_sky_SCENARIO.csv; those that are not there are traced with
// MEAN_PATHS a direction and kept there. Without scenarios, all of them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/report/truth/sky_truth_report.h"
#include "bakers/report/truth/sky_truth_store.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

constexpr double kAltitudeKm = 0.5;
constexpr int kRepetitions = 1;

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

std::vector<SkyTruthDirection> dome_directions() {
    std::vector<SkyTruthDirection> directions;
    for (const double sun : {45., 89.}) {
        directions.push_back({kAltitudeKm, sun, 0, 0});
        for (const double view : {10., 20., 30., 40., 50., 60., 70., 80., 85., 88., 89.5}) {
            for (const double azimuth : {0., 15., 30., 60., 90., 120., 150., 180.}) {
                directions.push_back({kAltitudeKm, sun, view, azimuth});
            }
        }
    }
    return directions;
}

std::vector<SkyTruthDirection> near_ground_directions() {
    std::vector<SkyTruthDirection> directions;
    for (const double sun : {30., 80., 89.}) {
        for (const double view :
             {10., 30., 45., 60., 70., 75., 80., 83., 85., 87., 88., 89., 89.3}) {
            for (const double azimuth : {0., 60., 180.}) {
                directions.push_back({0.05, sun, view, azimuth});
            }
        }
    }
    return directions;
}

// Views as low as 1, 2.5 and 5 degrees below the horizontal do not meet the ground. Away from suns
// at 98 degrees and more the sky is all but black.
std::vector<SkyTruthDirection> twilight_directions() {
    std::vector<SkyTruthDirection> directions;
    for (const double altitude_km : {5., 20., 80.}) {
        const double lowest_view = altitude_km < 10 ? 91 : altitude_km < 50 ? 92.5 : 95;
        for (const double sun : {92., 94., 96., 97., 98., 99.}) {
            for (const double view : {0., 70., 85., 89., lowest_view}) {
                for (const double azimuth : {0., 90., 180.}) {
                    if (azimuth > 0 && view == 0) continue;
                    if (azimuth > 90 && sun > 97) continue;
                    directions.push_back({altitude_km, sun, view, azimuth});
                }
            }
        }
    }
    return directions;
}

std::vector<SkyTruthDirection> directions_of(const Scenario& scenario) {
    if (scenario.suns == Scenario::Suns::three_near_ground) return near_ground_directions();
    if (scenario.suns == Scenario::Suns::two_domes) return dome_directions();
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

std::string settings_text(const Scenario& scenario) {
    std::string text = "preset " + scenario.preset;
    for (const std::string& setting : scenario.settings) text += ", " + setting;
    return text;
}

std::optional<std::vector<SkyTruth>> truth_of(const Scenario& scenario, const SkyMedium& medium,
                                              const std::filesystem::path& folder,
                                              std::int64_t mean_paths) {
    const auto path = folder / ("truth_sky_" + scenario.name + ".csv");
    if (const auto text = read_file(path); text.value) return parse_sky_truth_csv(*text.value);
    const auto truth =
        rounded(*trace_sky_truth_within(medium, directions_of(scenario), mean_paths, 0, nullptr));
    const auto written = write_file_atomically(
        path, sky_truth_csv(truth, fmt::format("rad in 1/sr, E_sun = 1; {}; {} paths a direction "
                                               "on average, more where they are needed; view "
                                               "rays never include the ground they hit",
                                               settings_text(scenario), mean_paths)));
    if (!written.value) return std::nullopt;
    return truth;
}

std::string percent(double share) { return fmt::format("{:.3g}", 100 * share); }

std::string percents(const Spectrum& channels, int count) {
    std::string text;
    for (int c = 0; c < count; ++c) {
        text += (c == 0 ? "" : "/") +
                fmt::format("{:.2g}", 100 * channels[static_cast<std::size_t>(c)]);
    }
    return text;
}

// `night` is of the suns from 92 degrees on alone, if there are any.
std::string line_of(const std::string& name, const std::string& time, const SkyErrorFigures& error,
                    const SkyErrorFigures& night, int channels) {
    std::string line = fmt::format(
        "| {} | {} | {} / {} / {} | {} |", name, time, percent(error.median), percent(error.p90),
        percent(error.max),
        night.dome_rms.empty() ? "" : percent(night.median) + " / " + percent(night.p90));
    for (const Spectrum& rms : error.dome_rms) line += " " + percents(rms, channels) + " |";
    return line + "\n";
}

void print(const Scenario& scenario, const SkyErrorReport& report, const SkyErrorReport& night) {
    fmt::print("\n### {}: {}\n\n| | ms | median / p90 / max % | suns from 92°: median / p90 % |",
               scenario.name, settings_text(scenario));
    for (const double sun : report.sun_zenith_degrees) fmt::print(" {}° |", sun);
    fmt::print("\n|---|---|---|---|");
    for (std::size_t i = 0; i < report.sun_zenith_degrees.size(); ++i) fmt::print("---|");
    fmt::print("\n");
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const SkyErrorRow& row = report.rows[i];
        fmt::print("{}", line_of(row.method.family + ", " + row.method.name,
                                 fmt::format("{:.3g}", row.time_ms), row.error, night.rows[i].error,
                                 report.channels));
    }
    fmt::print("{}", line_of("the truth's standard error", "", report.truth_error,
                             night.truth_error, report.channels));
    std::fflush(stdout);
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
        const auto truth = truth_of(scenario, medium, folder, mean_paths);
        if (!truth) {
            fmt::print(stderr, "{}: its table cannot be read or written\n", scenario.name);
            return 1;
        }
        const auto methods = make_sky_methods(sky_methods(medium, false), kRepetitions, nullptr);
        std::vector<SkyTruth> night = *truth;
        std::erase_if(
            night, [](const SkyTruth& value) { return value.direction.sun_zenith_degrees < 92; });
        print(scenario, measure_sky_errors(medium, *methods, *truth, kRepetitions, 0),
              measure_sky_errors(medium, *methods, night, kRepetitions, 0));
    }
    return 0;
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "sky_truth_benchmark FOLDER [MEAN_PATHS [SCENARIO ...]]\n");
        return 2;
    }
    const std::int64_t mean_paths = argc > 2 ? std::atoll(argv[2]) : 131072;
    return skybake::run(argv[1], std::max<std::int64_t>(mean_paths, 2),
                        {argv + std::min(argc, 3), argv + argc});
}
