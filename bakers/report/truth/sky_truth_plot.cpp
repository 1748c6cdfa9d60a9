#include "bakers/report/truth/sky_truth_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bakers/plot/svg_plot.h"

namespace skybake {

namespace {

PlotPoint point_of(const SkyErrorRow& row, int family, double error) {
    PlotPoint point;
    point.x = row.time_ms;
    point.y = error;
    point.family = family;
    point.label = row.method.baseline.empty() ? row.method.name : row.method.baseline;
    point.tooltip = fmt::format("{}, {}: {:.3g} ms, error {:.2g} median, {:.2g} p90, {:.2g} max",
                                row.method.family, row.method.name, row.time_ms, row.error.median,
                                row.error.p90, row.error.max);
    point.emphasised = !row.method.baseline.empty();
    point.on_front = row.on_front;
    return point;
}

}  // namespace

std::string sky_truth_svg(const SkyErrorReport& report) {
    Plot plot;
    plot.title = "The sky's error by its multiple scattering";
    plot.subtitles = {
        fmt::format("relative error of sky radiance in {} directions against path tracing, whose "
                    "standard error is {:.2g} median, {:.2g} p90",
                    report.directions, report.truth_error.median, report.truth_error.p90),
        fmt::format("time: processor time of all that comes before the first view ray, one "
                    "thread, median of {}",
                    report.repetitions)};
    plot.front_name = "Pareto front";
    PlotPanel median = {"Median", "time (ms)", "relative error, median", {}};
    PlotPanel p90 = {"9 of 10 are within", "time (ms)", "relative error, 90th percentile", {}};
    for (const SkyErrorRow& row : report.rows) {
        if (!row.method.takes_time()) {  // no time, which a logarithmic axis has no place for
            plot.subtitles.push_back(fmt::format("{}: {:.2g} median, {:.2g} p90", row.method.family,
                                                 row.error.median, row.error.p90));
            continue;
        }
        const int family = family_index(plot.families, row.method.family);
        median.points.push_back(point_of(row, family, row.error.median));
        p90.points.push_back(point_of(row, family, row.error.p90));
        p90.points.back().on_front = false;  // the front is that of medians
    }
    plot.panels = {std::move(median), std::move(p90)};
    return svg_of(plot);
}

}  // namespace skybake
