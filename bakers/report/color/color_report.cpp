#include "bakers/report/color/color_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "bakers/io/manifest/release.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_colors.h"
#include "bakers/report/sweeps/sweep.h"
#include "bakers/report/truth/sky_truth_report.h"
#include "config/fields/wavelength_reader.h"
#include "config/sections/spectral_air.h"

namespace skybake {

using config::Length;

namespace {

constexpr int kRepetitions = 3;
// The wavelengths of most papers, and of the presets that have their air.
constexpr std::array kPlain_nm = {680.0, 550.0, 440.0};

struct WavelengthSet {
    std::string name;
    std::vector<Length> wavelengths;
    bool of_recipe = false;
};

std::vector<Length> lengths(std::span<const double> nm) {
    std::vector<Length> all;
    for (const double one : nm) all.push_back({one / 1e9});
    return all;
}

std::vector<double> in_nm(const std::vector<Length>& wavelengths) {
    std::vector<double> nm;
    for (const Length one : wavelengths) nm.push_back(std::round(one.meters * 1e15) / 1e6);
    return nm;
}

std::string name_of(const std::vector<Length>& wavelengths) {
    if (wavelengths.size() <= 4) return fmt::format("{} nm", fmt::join(in_nm(wavelengths), ", "));
    return fmt::format("{} wavelengths", wavelengths.size());
}

// Returns the plain triple, the best ones and, if it is another one, the recipe's list.
std::vector<WavelengthSet> wavelength_sets(const config::Parameters& parameters, bool quick) {
    std::vector<WavelengthSet> sets = {{name_of(lengths(kPlain_nm)), lengths(kPlain_nm), false}};
    for (const int count : {3, 4, 8, 16}) {
        if (quick && count == 16) continue;
        sets.push_back(
            {fmt::format("best {}", count), lengths(config::best_wavelengths_nm(count)), false});
    }
    for (WavelengthSet& set : sets) {
        set.of_recipe = in_nm(set.wavelengths) == in_nm(parameters.wavelengths);
    }
    const bool is_known = std::any_of(sets.begin(), sets.end(),
                                      [](const WavelengthSet& set) { return set.of_recipe; });
    if (!is_known && parameters.wavelengths.size() > 1) {
        sets.push_back({name_of(parameters.wavelengths), parameters.wavelengths, true});
    }
    return sets;
}

// Measures one set after the other.
class ColorMeasurement {
  public:
    ColorMeasurement(const config::Parameters& parameters, const BakeOptions& options)
        : color_(parameters.color.value_or(config::Color())),
          skies_(parameters.atmosphere, parameters.wavelengths, options) {}

    const config::Color& color() const { return color_; }

    void add_rows(const WavelengthSet& set, double time_ms, std::vector<ColorErrorRow>& rows) {
        const auto add = [&](const char* family, const char* baseline, bool is_own,
                             const std::vector<glm::dvec3>& weights) {
            rows.push_back({family, set.name, baseline, set.of_recipe && is_own, set.wavelengths,
                            time_ms, 0, skies_.error(set.wavelengths, color_, weights), false});
        };
        if (set.wavelengths.size() == 3) {
            const std::vector<glm::dvec3> plain = weights_as_rgb(set.wavelengths);
            const bool is_usual = in_nm(set.wavelengths) == in_nm(lengths(kPlain_nm));
            add("as R, G, B", is_usual ? "usual renderers" : "", false, plain);
            add("factors", "", false, skies_.fitted_factors(set.wavelengths, color_, plain));
        }
        add("linear spectrum", "", false, linear_color_weights(set.wavelengths, color_));
        add("fitted matrix", "", true, skies_.fitted_weights(set.wavelengths, color_));
    }

  private:
    config::Color color_;
    ColorSkies skies_;
};

// Returns the median time of the light of all orders of each set, or nothing after an interruption.
std::optional<std::vector<double>> light_times_ms(const config::Parameters& parameters,
                                                  const std::vector<WavelengthSet>& sets,
                                                  int repetitions, const BakeOptions& options) {
    std::vector<std::function<void()>> jobs;
    for (const WavelengthSet& set : sets) {
        jobs.emplace_back([&parameters, &set] {
            const config::Atmosphere air = config::atmosphere_at(
                parameters.atmosphere, parameters.wavelengths, set.wavelengths);
            for (const config::Atmosphere& packet : packets_of(air)) {
                const LightRequest request{.atmosphere = packet};
                light_of(request, medium_of(request), {.threads = 1});
            }
        });
    }
    const double runs = static_cast<double>(jobs.size()) * repetitions;
    const auto before_each = [&](int round, std::size_t job) {
        if (options.progress == nullptr) return true;
        const std::size_t done = static_cast<std::size_t>(round) * jobs.size() + job;
        options.progress->advance("timing", static_cast<double>(done) / runs);
        return !options.cancelled();
    };
    std::vector<double> seconds = interleaved_medians(jobs, repetitions, before_each);
    if (seconds.size() != jobs.size()) return std::nullopt;
    for (double& one : seconds) one = std::round(one * 1e9) / 1e6;  // the clock counts ns
    return seconds;
}

void mark_front(std::vector<ColorErrorRow>& rows) {
    std::vector<CostAndError> choices;
    double fastest = rows.front().time_ms;
    for (const ColorErrorRow& row : rows) {
        choices.push_back({row.time_ms, row.error.median});
        fastest = std::min(fastest, row.time_ms);
    }
    const std::vector<bool> front = pareto_front(choices, kTimingNoise);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].on_front = front[i];
        rows[i].time_ratio = fastest > 0 ? rows[i].time_ms / fastest : 0;
    }
}

}  // namespace

std::optional<ColorReport> measure_colors(const config::Parameters& parameters, bool quick,
                                          const BakeOptions& options) {
    ColorReport report;
    report.repetitions = quick ? 1 : kRepetitions;
    const std::vector<WavelengthSet> sets = wavelength_sets(parameters, quick);
    const auto times = light_times_ms(parameters, sets, report.repetitions, options);
    if (!times) return std::nullopt;
    ColorMeasurement measurement(parameters, options);
    if (options.cancelled()) return std::nullopt;
    report.space = words_of(measurement.color()).space;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        measurement.add_rows(sets[i], (*times)[i], report.rows);
    }
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [](const ColorErrorRow& a, const ColorErrorRow& b) {
                         const auto rank = [](const std::string& family) {
                             return family == "as R, G, B"        ? 0
                                    : family == "factors"         ? 1
                                    : family == "linear spectrum" ? 2
                                                                  : 3;
                         };
                         return rank(a.family) < rank(b.family);
                     });
    mark_front(report.rows);
    return report;
}

std::string color_report_csv(const ColorReport& report) {
    std::string text =
        "way,family,variant,baseline,wavelengths,of_recipe,time_ms,time_ratio,on_front,"
        "error_median,error_p90,error_max,error_disc_5,error_disc_1,error_disc_0\n";
    for (const ColorErrorRow& row : report.rows) {
        const ColorError& error = row.error;
        text +=
            fmt::format("color,{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_quoted(row.family),
                        csv_quoted(row.variant), csv_quoted(row.baseline), row.wavelengths.size(),
                        row.of_recipe, row.time_ms, row.time_ratio, row.on_front, error.median,
                        error.ninth_decile, error.max, fmt::join(error.disc, ","));
    }
    return text;
}

std::string color_report_json(const ColorReport& report) {
    using Json = nlohmann::ordered_json;
    Json rows = Json::array();
    for (const ColorErrorRow& row : report.rows) {
        rows.push_back({{"family", row.family},
                        {"variant", row.variant},
                        {"baseline", row.baseline},
                        {"of_recipe", row.of_recipe},
                        {"wavelengths_nm", in_nm(row.wavelengths)},
                        {"time_ms", row.time_ms},
                        {"time_ratio", row.time_ratio},
                        {"on_front", row.on_front},
                        {"error",
                         {{"median", row.error.median},
                          {"p90", row.error.ninth_decile},
                          {"max", row.error.max},
                          {"disc", row.error.disc},
                          {"skies", row.error.skies}}}});
    }
    const Json json = {{"report", {{"tool", tool_name()}, {"version", release()}, {"format", 1}}},
                       {"space", report.space},
                       {"repetitions", report.repetitions},
                       {"rows", std::move(rows)}};
    return json.dump(2) + "\n";
}

Figure color_figure(const ColorReport& report) {
    Figure plot;
    plot.title = "The sky's colour error by its wavelengths";
    plot.subtitles = {
        fmt::format("largest difference of a channel of {} over luminance, in {} views against "
                    "whole spectra",
                    report.space, report.rows.front().error.skies),
        fmt::format("time: processor time of the light of all orders, one thread, median of {}",
                    report.repetitions)};
    plot.front_name = "Pareto front";
    std::vector<ChartPoint> median, p90, disc;
    for (const ColorErrorRow& row : report.rows) {
        ChartPoint point;
        point.x = row.time_ms;
        point.family = family_index(plot.families, row.family);
        point.label = row.baseline.empty() ? row.variant : row.baseline;
        point.tooltip = fmt::format(
            "{}, {}: {:.3g} ms, error {:.2g} median, {:.2g} p90, {:.2g} max", row.family,
            row.variant, row.time_ms, row.error.median, row.error.ninth_decile, row.error.max);
        point.emphasised = row.of_recipe || !row.baseline.empty();
        const auto at = [&point](double error, bool on_front) {
            ChartPoint copy = point;
            copy.y = error;
            copy.on_front = on_front;
            return copy;
        };
        median.push_back(at(row.error.median, row.on_front));
        p90.push_back(at(row.error.ninth_decile, false));
        disc.push_back(at(row.error.disc.back(), false));
    }
    plot.charts = {scatter_chart(std::move(median), "Skies: median", "time (ms)", "error, median"),
                   scatter_chart(std::move(p90), "Skies: 9 of 10 are within", "time (ms)",
                                 "error, 90th percentile"),
                   scatter_chart(std::move(disc), "The sun on the horizon", "time (ms)", "error")};
    return plot;
}

}  // namespace skybake
