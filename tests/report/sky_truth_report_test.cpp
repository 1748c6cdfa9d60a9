// The sky's error by each way to multiple scattering, and the path-traced skies that it needs.
#include "bakers/report/truth/sky_truth_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "bakers/light/higher_orders.h"
#include "bakers/report/report_files.h"
#include "bakers/report/truth/bruneton_sky.h"
#include "bakers/report/truth/sky_truth_store.h"

namespace skybake {
namespace {

config::Recipe recipe(const std::string& preset, const std::vector<std::string>& settings = {}) {
    return *config::parse_recipe("preset = \"" + preset + "\"\n", "test", {}, settings).value;
}

SkyMedium medium_of(const std::string& preset, const std::vector<std::string>& settings = {}) {
    return make_sky_medium(recipe(preset, settings).parameters.atmosphere);
}

// The user interrupts as soon as there is progress.
class Interrupted : public Progress {
  public:
    void advance(std::string_view, double) override { cancelled_ = true; }
    bool cancelled() const override { return cancelled_; }

  private:
    bool cancelled_ = false;
};

// A sky by day and one at dusk, few directions each.
std::vector<SkyTruthDirection> few_directions() {
    return {{0.5, 30, 0, 0}, {0.5, 30, 60, 0}, {0.5, 30, 60, 180},
            {0.5, 94, 0, 0}, {0.5, 94, 85, 0}, {0.5, 94, 85, 180}};
}

// Returns single scattering, times a factor, as if it were true.
std::vector<SkyTruth> single_scattering_truth(const SkyMedium& medium, double factor) {
    std::vector<SkyTruth> truth;
    for (const SkyTruthDirection& direction : few_directions()) {
        for (int c = 0; c < medium.air.channels; ++c) truth.push_back({direction, c, {}, 0, 0});
    }
    const std::vector<double> sky = sky_radiances(medium, {}, truth, 1);
    for (std::size_t i = 0; i < sky.size(); ++i) {
        truth[i].radiance = factor * sky[i];
        truth[i].standard_error = 0.01 * truth[i].radiance;
    }
    return truth;
}

std::vector<MadeSkyMethod> single_alone() {
    std::vector<MadeSkyMethod> methods(1);
    methods[0].method = {"single", "single scattering", "alone", "", nullptr};
    return methods;
}

TEST(SkyTruthReport, DomeSharesAreSolidAngles) {
    for (const std::vector<double>& azimuths :
         {std::vector<double>{0, 90, 180}, std::vector<double>{0, 15, 30, 60, 90, 120, 150, 180}}) {
        std::vector<SkyTruthDirection> directions = {{0.5, 45, 0, 0}};
        for (int zenith = 3; zenith < 90; zenith += 3) {
            for (const double azimuth : azimuths) {
                directions.push_back({0.5, 45, double(zenith), azimuth});
            }
        }
        const std::vector<double> shares = dome_shares(directions);
        double sum = 0;
        double mean_cosine = 0;  // 1/2 of a hemisphere
        double towards_sun = 0;  // as much as away from it, but for the grid's coarseness
        for (std::size_t i = 0; i < shares.size(); ++i) {
            ASSERT_GT(shares[i], 0);
            sum += shares[i];
            mean_cosine += shares[i] * std::cos(directions[i].view_zenith_degrees * M_PI / 180);
            if (directions[i].view_zenith_degrees > 0) {
                towards_sun += shares[i] * std::cos(directions[i].azimuth_degrees * M_PI / 180);
            }
        }
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_NEAR(mean_cosine, 0.5, 0.002);
        EXPECT_NEAR(towards_sun, 0, 0.005);
    }
}

TEST(SkyTruthReport, AFactorIsTheErrorEverywhere) {
    const SkyMedium medium = medium_of("earth_hillaire");
    const auto truth = single_scattering_truth(medium, 1.25);
    const SkyErrorReport report = measure_sky_errors(medium, single_alone(), truth, 1, 2);
    ASSERT_EQ(report.rows.size(), 1u);
    const SkyErrorFigures& error = report.rows[0].error;
    EXPECT_NEAR(error.median, 0.2, 1e-12);
    EXPECT_NEAR(error.max, 0.2, 1e-12);
    EXPECT_NEAR(report.truth_error.p90, 0.01, 1e-12);
    ASSERT_EQ(report.sun_zenith_degrees, (std::vector<double>{30, 94}));
    EXPECT_EQ(report.directions, 6);
    for (const Spectrum& rms : error.dome_rms) {
        // RMS of the dome over its mean, at least the factor's error.
        for (int c = 0; c < report.channels; ++c) EXPECT_GE(rms[std::size_t(c)], 0.2 - 1e-12);
    }
}

TEST(SkyTruthReport, TheOrderOfTheTruthDoesNotMatter) {
    const SkyMedium medium = medium_of("earth_hillaire");
    const auto truth = single_scattering_truth(medium, 1.1);
    std::vector<SkyTruth> by_channel;
    for (int c = 0; c < 3; ++c) {
        for (const SkyTruth& value : truth) {
            if (value.channel == c) by_channel.push_back(value);
        }
    }
    ASSERT_NE(by_channel, truth);
    EXPECT_EQ(by_direction(by_channel), truth);
    EXPECT_EQ(sky_truth_report_json(measure_sky_errors(medium, single_alone(), truth, 1, 1)),
              sky_truth_report_json(measure_sky_errors(medium, single_alone(), by_channel, 1, 2)));
}

TEST(SkyTruthReport, BlackSkyIsLeftOut) {
    const SkyMedium medium = medium_of("vacuum");
    const auto traced = trace_sky_truth_within(medium, few_directions(), 16, 1, nullptr);
    ASSERT_TRUE(traced);
    auto report = measure_sky_errors(medium, single_alone(), *traced, 1, 1);
    EXPECT_EQ(report.black, static_cast<int>(traced->size()));
    EXPECT_EQ(report.rows[0].error.max, 0);
    EXPECT_EQ(sky_truth_report_json(report).find("null"), std::string::npos);  // no NaN
}

// Moments of degree 4 within 0.4 % (median) and 1.5 % (9 of 10), the truth's own error included.
TEST(SkyTruthReport, MomentsAreRightOnEarth) {
    std::ifstream file(SKYBAKE_TEST_DATA "/truth_sky_earth.csv");
    std::stringstream text;
    text << file.rdbuf();
    const auto truth = parse_sky_truth_csv(text.str());
    ASSERT_TRUE(truth);
    ASSERT_EQ(truth->size(), 534u);
    const SkyMedium medium = medium_of("earth_hillaire", {"atmosphere.ground_albedo=0"});
    std::vector<SkyMethod> methods = sky_methods(medium, true);
    std::erase_if(methods, [](const SkyMethod& method) {
        return method.key != "single" && method.key != "converged_32x32" &&
               method.key != "moments_4";
    });
    const auto made = make_sky_methods(methods, 1, nullptr);
    ASSERT_TRUE(made);
    const SkyErrorReport report = measure_sky_errors(medium, *made, *truth, 1, 0);
    const auto& rows = report.rows;
    EXPECT_LT(rows[2].error.median, 0.004);
    EXPECT_LT(rows[2].error.p90, 0.015);
    EXPECT_LT(rows[1].error.median, 0.035);
    EXPECT_GT(rows[1].error.median, 5 * rows[2].error.median);
    EXPECT_GT(rows[0].error.median, 3 * rows[1].error.median);
    EXPECT_EQ(rows[0].time_ms, 0);
    EXPECT_EQ(std::min(rows[1].time_ratio, rows[2].time_ratio), 1);
    EXPECT_LT(report.truth_error.p90, 0.004);
}

// Bruneton's tables at half their size: right by day within 3 % in nine of ten directions. The
// colours that a combined table leaves out are guessed well, but not exactly.
TEST(SkyTruthReport, BrunetonsTablesAreRightOnEarth) {
    std::ifstream file(SKYBAKE_TEST_DATA "/truth_sky_earth.csv");
    std::stringstream text;
    text << file.rdbuf();
    auto truth = parse_sky_truth_csv(text.str());
    ASSERT_TRUE(truth);
    std::erase_if(*truth,
                  [](const SkyTruth& value) { return value.direction.sun_zenith_degrees > 85; });
    const SkyMedium medium = medium_of("earth_hillaire", {"atmosphere.ground_albedo=0"});
    std::vector<SkyMethod> methods = sky_methods(medium, false);
    std::erase_if(methods, [](const SkyMethod& method) {
        return method.key != "bruneton_separate" && method.key != "bruneton_combined";
    });
    ASSERT_EQ(methods.size(), 2u);
    for (SkyMethod& method : methods) {
        EXPECT_TRUE(method.takes_time());
        const bool combined = method.key == "bruneton_combined";
        method.make_whole = [&medium, combined] {
            return bruneton_sky(medium, {.texels = {128, 64, 16}}, combined);
        };
    }
    const auto made = make_sky_methods(methods, 1, nullptr);
    ASSERT_TRUE(made);
    const SkyErrorReport report = measure_sky_errors(medium, *made, *truth, 1, 0);
    for (const SkyErrorRow& row : report.rows) {
        EXPECT_GT(row.time_ms, 0);
        EXPECT_LT(row.error.median, 0.01) << row.method.key;
        EXPECT_LT(row.error.p90, 0.03) << row.method.key;
        EXPECT_GT(row.error.median, 1e-5) << row.method.key;
    }
    EXPECT_LT(report.rows[0].error.median, report.rows[1].error.median);
}

TEST(SkyTruthReport, BrunetonsTablesHoldNoFourWavelengths) {
    const auto has_bruneton = [](const char* preset) {
        const SkyMedium medium = medium_of(preset);
        const std::vector<SkyMethod> methods = sky_methods(medium, false);
        return std::any_of(methods.begin(), methods.end(), [](const SkyMethod& method) {
            return method.key.starts_with("bruneton");
        });
    };
    EXPECT_TRUE(has_bruneton("earth_hillaire"));
    EXPECT_FALSE(has_bruneton("earth"));
}

TEST(SkyTruthReport, AnInterruptedTimingHasNoResult) {
    Interrupted progress;
    std::vector<SkyMethod> methods = {{"none", "none", "none", "", [] {
                                           ADD_FAILURE() << "made though interrupted";
                                           return nullptr;
                                       }}};
    EXPECT_FALSE(make_sky_methods(methods, 1, &progress));
}

TEST(SkyTruthReport, FilesHoldWhatWasMeasured) {
    const SkyMedium medium = medium_of("earth_hillaire");
    auto methods = single_alone();
    methods.push_back({});
    methods[1].method = {"grey", "constants", "grey, <of> \"all\"", "of old", [&medium] {
                             return std::make_unique<IsotropicOrders>(
                                 medium.air, [](double, double) { return Spectrum(0.1); });
                         }};
    methods[1].orders = methods[1].method.make();
    methods[1].time_ms = 2;
    const auto report =
        measure_sky_errors(medium, methods, single_scattering_truth(medium, 1), 1, 1);
    const auto json = nlohmann::json::parse(sky_truth_report_json(report));
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["error"]["max"], 0);
    EXPECT_GT(json["rows"][1]["error"]["median"], 0);
    EXPECT_EQ(json["rows"][1]["error"]["dome_rms"].size(), 2u);
    EXPECT_EQ(json["rows"][1]["error"]["dome_rms"][0].size(), 3u);
    std::istringstream csv(sky_truth_report_csv(report));
    std::string line;
    int lines = 0;
    for (; std::getline(csv, line); ++lines) {
        const auto outside_quotes = [quoted = false](char letter) mutable {
            if (letter == '"') quoted = !quoted;
            return letter == ',' && !quoted;
        };
        EXPECT_EQ(std::count_if(line.begin(), line.end(), outside_quotes), 15) << line;
    }
    EXPECT_EQ(lines, 4);
    const Figure figure = sky_truth_figure(report);
    const std::vector<ChartPoint>& points = figure.charts.at(0).points;
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const ChartPoint& point) {
        return point.label.find("of old") != std::string::npos && point.emphasised;
    }));
    const std::string svg = report_svg(figure);
    EXPECT_EQ(svg.find("<of>"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(SkyTruthBudget, TheSameBitsForAnyThreads) {
    const SkyMedium medium = medium_of("earth_hillaire");
    const auto one = trace_sky_truth_within(medium, few_directions(), 3000, 1, nullptr);
    const auto three = trace_sky_truth_within(medium, few_directions(), 3000, 3, nullptr);
    ASSERT_TRUE(one && three);
    EXPECT_EQ(*one, *three);
}

TEST(SkyTruthBudget, SpendsWhereItCounts) {
    const SkyMedium medium = medium_of("earth_hillaire");
    constexpr std::int64_t kPaths = 16384;
    const auto shared = trace_sky_truth_within(medium, few_directions(), kPaths, 0, nullptr);
    const auto even = trace_sky_truth(medium, few_directions(), {1, kPaths}, 0);
    ASSERT_TRUE(shared);
    double worst_shared = 0;
    double worst_even = 0;
    for (std::size_t i = 0; i < even.size(); ++i) {
        worst_shared = std::max(worst_shared, (*shared)[i].standard_error / even[i].radiance);
        worst_even = std::max(worst_even, even[i].standard_error / even[i].radiance);
        // Neither is biased.
        EXPECT_LT(std::fabs((*shared)[i].radiance - even[i].radiance),
                  5 * std::hypot((*shared)[i].standard_error, even[i].standard_error));
    }
    EXPECT_LT(worst_shared, 0.8 * worst_even);
}

TEST(SkyTruthBudget, StopsWhenInterrupted) {
    Interrupted progress;
    EXPECT_FALSE(trace_sky_truth_within(medium_of("earth_hillaire"), few_directions(), 1 << 30, 1,
                                        &progress));
}

TEST(SkyTruthStore, KeepsEveryBitAndRefusesDamage) {
    const auto truth =
        *trace_sky_truth_within(medium_of("earth_hillaire"), {few_directions()[1]}, 64, 1, nullptr);
    const std::string key(32, 'a');
    const std::string text = stored_sky_truth(truth, key);
    EXPECT_TRUE(is_stored_sky_truth(text));
    const auto back = parse_stored_sky_truth(text, key);
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, truth);
    EXPECT_FALSE(parse_stored_sky_truth(text, std::string(32, 'b')));
    for (std::size_t length = 0; length < text.size(); ++length) {
        ASSERT_FALSE(parse_stored_sky_truth(text.substr(0, length), key)) << length;
    }
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string damaged = text;
        damaged[at] = damaged[at] == '1' ? '2' : '1';
        ASSERT_FALSE(parse_stored_sky_truth(damaged, key)) << at;
    }
    EXPECT_FALSE(load_sky_truth("/nowhere/sky_truth.csv", key));
}

TEST(SkyTruthStore, TheKeyIsOfTheAir) {
    const auto directions = few_directions();
    const std::string key = sky_truth_key(recipe("earth_hillaire"), directions, 64);
    EXPECT_EQ(sky_truth_key(recipe("earth_hillaire", {"atmosphere.ground_albedo=0.3",
                                                      "bake.transmittance.size=[8, 8]"}),
                            directions, 64),
              key);
    EXPECT_NE(
        sky_truth_key(recipe("earth_hillaire", {"atmosphere.ground_albedo=0.2"}), directions, 64),
        key);
    EXPECT_NE(
        sky_truth_key(recipe("earth_hillaire", {"atmosphere.layers.mie.g=0.7"}), directions, 64),
        key);
    EXPECT_NE(sky_truth_key(recipe("earth_hillaire"), directions, 65), key);
    EXPECT_NE(sky_truth_key(recipe("earth_hillaire"), {directions[0]}, 64), key);
}

// Layers of particles scatter as these do.
TEST(SkyTruthStore, TheKeyIsOfTheParticles) {
    const auto key_of = [](const std::string& radius) {
        const auto found = config::parse_recipe(
            "preset = \"earth_hillaire\"\n[particles.drop]\nmaterial = \"water\"\n"
            "sizes = \"monodisperse\"\nradius = \"" +
                radius +
                "\"\n[atmosphere.layers.fog]\nprofile = \"slab\"\nbottom_altitude = \"0 m\"\n"
                "top_altitude = \"100 m\"\nphase = { mie = \"drop\" }\n"
                "number_density = \"15 /cm3\"\n",
            "test");
        EXPECT_TRUE(found.value) << found.diagnostics.front().message;
        return found.value ? sky_truth_key(*found.value, few_directions(), 64) : radius;
    };
    EXPECT_EQ(key_of("2 um"), key_of("2 um"));
    EXPECT_NE(key_of("2 um"), key_of("3 um"));
}

}  // namespace
}  // namespace skybake
