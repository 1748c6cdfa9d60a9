#include "bakers/report/truth/sky_truth_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bakers/io/manifest/release.h"

namespace skybake {

std::string csv_quoted(const std::string& text) { return text.empty() ? "" : '"' + text + '"'; }

namespace {

using Json = nlohmann::ordered_json;

std::string figures_cells(const SkyErrorFigures& error, int channels) {
    std::string cells = fmt::format("{},{},{}", error.median, error.p90, error.max);
    for (const Spectrum& rms : error.dome_rms) {
        for (int c = 0; c < channels; ++c) {
            cells += fmt::format(",{}", rms[static_cast<std::size_t>(c)]);
        }
    }
    return cells;
}

Json to_json(const SkyErrorFigures& error, int channels) {
    Json suns = Json::array();
    for (const Spectrum& rms : error.dome_rms) {
        Json values = Json::array();
        for (int c = 0; c < channels; ++c) values.push_back(rms[static_cast<std::size_t>(c)]);
        suns.push_back(std::move(values));
    }
    return {{"median", error.median},
            {"p90", error.p90},
            {"max", error.max},
            {"dome_rms", std::move(suns)}};
}

}  // namespace

std::string sky_truth_report_csv(const SkyErrorReport& report) {
    std::string text =
        "method,family,variant,baseline,time_ms,time_ratio,on_front,error_median,error_p90,"
        "error_max";
    for (const double sun : report.sun_zenith_degrees) {
        for (int c = 0; c < report.channels; ++c) text += fmt::format(",dome_rms_{}_{}", sun, c);
    }
    text += '\n';
    for (const SkyErrorRow& row : report.rows) {
        text +=
            fmt::format("{},{},{},{},{},{},{},{}\n", row.method.key, csv_quoted(row.method.family),
                        csv_quoted(row.method.name), csv_quoted(row.method.baseline), row.time_ms,
                        row.time_ratio, row.on_front, figures_cells(row.error, report.channels));
    }
    return text + fmt::format("truth,\"standard error\",,,,,,{}\n",
                              figures_cells(report.truth_error, report.channels));
}

std::string sky_truth_report_json(const SkyErrorReport& report) {
    Json rows = Json::array();
    for (const SkyErrorRow& row : report.rows) {
        rows.push_back({{"method", row.method.key},
                        {"family", row.method.family},
                        {"variant", row.method.name},
                        {"baseline", row.method.baseline},
                        {"time_ms", row.time_ms},
                        {"time_ratio", row.time_ratio},
                        {"on_front", row.on_front},
                        {"error", to_json(row.error, report.channels)}});
    }
    Json ladder = Json::array();
    for (const LadderStep& step : report.ladder) {
        ladder.push_back({{"step", step.name},
                          {"typical", step.size ? Json(step.size->typical) : Json(nullptr)},
                          {"high", step.size ? Json(step.size->high) : Json(nullptr)},
                          {"sentence", step.sentence}});
    }
    const Json json = {{"report", {{"tool", tool_name()}, {"version", release()}, {"format", 1}}},
                       {"channels", report.channels},
                       {"sun_zenith_degrees", report.sun_zenith_degrees},
                       {"directions", report.directions},
                       {"mean_paths", report.mean_paths},
                       {"black", report.black},
                       {"repetitions", report.repetitions},
                       {"truth_error", to_json(report.truth_error, report.channels)},
                       {"ladder", std::move(ladder)},
                       {"rows", std::move(rows)}};
    return json.dump(2) + "\n";
}

}  // namespace skybake
