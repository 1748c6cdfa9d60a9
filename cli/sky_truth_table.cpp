#include "cli/sky_truth_table.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

// Three digits, and no more than two decimals.
std::string percent(double share) {
    const double value = 100 * share;
    return fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

std::string method_time_text(const SkyErrorRow& row) {
    if (!row.method.takes_time()) return "-";
    return fmt::format("{:.{}f} ms", row.time_ms, row.time_ms < 10 ? 2 : row.time_ms < 100 ? 1 : 0);
}

void add_figures(const SkyErrorFigures& error, int channels, std::vector<std::string>& cells) {
    for (const double figure : {error.median, error.p90, error.max}) {
        cells.push_back(percent(figure));
    }
    for (const Spectrum& rms : error.dome_rms) cells.push_back(percent(joined(rms, channels)));
}

}  // namespace

std::string sky_truth_table(const SkyErrorReport& report) {
    std::vector<Align> alignment = {Align::left, Align::left};
    std::vector<std::string> heading = {
        "multiple scattering", "", "time", "ratio", "median", "p90 %", "max"};
    for (const double sun : report.sun_zenith_degrees) heading.push_back(fmt::format("{:g}°", sun));
    heading.emplace_back();
    alignment.resize(heading.size() - 1, Align::right);
    TextTable table(alignment);
    table.add_row(std::move(heading));
    std::string family;
    for (const SkyErrorRow& row : report.rows) {
        std::vector<std::string> cells = {
            row.method.family == family ? "" : row.method.family, row.method.name,
            method_time_text(row),
            row.method.takes_time() ? fmt::format("{:.1f}", row.time_ratio) : "-"};
        add_figures(row.error, report.channels, cells);
        std::string remark = row.on_front ? "front" : "";
        if (!row.method.baseline.empty()) {
            remark += (remark.empty() ? "baseline: " : ", baseline: ") + row.method.baseline;
        }
        cells.push_back(std::move(remark));
        table.add_row(std::move(cells));
        family = row.method.family;
    }
    std::vector<std::string> noise = {"truth's standard error", "", "", ""};
    add_figures(report.truth_error, report.channels, noise);
    table.add_row(std::move(noise));
    return fmt::format(
        "sky radiance against path tracing ({} directions, {} paths each on average)\n"
        "  error: of radiance, relative, in %: median, 90th percentile, largest; under each sun's "
        "zenith angle the RMS over the dome as a share of its mean\n"
        "  time: processor time of all that comes before the first view ray, one thread, median "
        "of {}; ratio to the cheapest\n"
        "  front: no other method has a smaller median in as little time (within 5 %)\n{}\n{}",
        report.directions, report.mean_paths, report.repetitions,
        report.black == 0
            ? ""
            : fmt::format("  {} values are left out, because they are black in the reference\n",
                          report.black),
        table.text());
}

}  // namespace skybake::cli
