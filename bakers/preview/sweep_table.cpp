#include "bakers/preview/sweep_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/report/measurement.h"

namespace skybake {
namespace {

// Figures with their titles and the page's functions that make texts of them.
constexpr std::array<std::array<const char*, 3>, 6> known_figures = {{
    {"sky_median", "sky error, median", "percent"},
    {"sky_p90", "sky error, 9 in 10", "percent"},
    {"sky_max", "sky error, max", "percent"},
    {"lookup_max", "lookup error, max", "figure"},
    {"lookup_rms", "lookup error, RMS", "figure"},
    {"bytes", "files", "byteCount"},
}};

// Returns the names of the figures that any variant has of an asset.
std::set<std::string> measured_figures(const PreviewSweep& sweep, const std::string& asset) {
    std::set<std::string> names;
    for (const SweepVariant& variant : sweep.variants) {
        const auto figures = variant.figures.find(asset);
        if (figures == variant.figures.end()) continue;
        for (const auto& [name, value] : figures->second) names.insert(name);
    }
    return names;
}

// Whether an asset has the same errors and bytes in all variants.
bool is_the_same_everywhere(const PreviewSweep& sweep, const std::string& asset) {
    for (const auto& [name, title, shown] : known_figures) {
        for (const SweepVariant& variant : sweep.variants) {
            if (figure_of(variant, asset, name) != figure_of(sweep.variants[0], asset, name)) {
                return false;
            }
        }
    }
    return true;
}

// A figure as an axis of a plot shows it.
struct PlottedFigure {
    std::string_view figure;  // empty: the time of the bake
    const char* title;
    double factor;  // from the index's unit to the title's
    bool has_light = true;
};

constexpr PlottedFigure sky_error_axis = {"sky_median", "sky error, median (%)", 100};
constexpr PlottedFigure lookup_error_axis = {"lookup_rms", "lookup error, RMS", 1};
constexpr PlottedFigure bytes_axis = {"bytes", "files (KiB)", 1.0 / 1024};
constexpr PlottedFigure time_axis = {"", "time of the bake (s)", 1};
constexpr PlottedFigure own_time_axis = {"", "time without shared light (s)", 1, false};

// Returns the time of an asset's bake, without those of certificate and files, or nothing if it is
// not known.
std::optional<double> bake_seconds(const SweepVariant& variant, const std::string& asset,
                                   bool has_light) {
    const auto figures = variant.figures.find(asset);
    if (figures == variant.figures.end()) return std::nullopt;
    std::optional<double> seconds;
    for (const auto& [name, value] : figures->second) {
        if (!name.ends_with("_s") || name == "certificate_s" || name == "write_s") continue;
        if (name == "light_s" && !has_light) continue;
        seconds = seconds.value_or(0) + value;
    }
    return seconds;
}

// Whether some variants took the light that others made, which alone have its time.
bool shares_light(const PreviewSweep& sweep, const std::string& asset) {
    constexpr double nothing_s = 1e-3;
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (const SweepVariant& variant : sweep.variants) {
        const double seconds = figure_of(variant, asset, "light_s").value_or(0);
        least = std::min(least, seconds);
        most = std::max(most, seconds);
    }
    return least < nothing_s && most >= nothing_s;
}

bool is_measured(const PreviewSweep& sweep, const std::string& asset, std::string_view figure) {
    return std::ranges::any_of(sweep.variants, [&](const SweepVariant& variant) {
        return figure_of(variant, asset, figure).has_value();
    });
}

// Returns the points of the variants that have both figures. The first axis of several gives the
// families, and the others the labels.
std::vector<ChartPoint> points_of(const PreviewSweep& sweep, const std::string& asset,
                                  const PlottedFigure& cost, const PlottedFigure& error,
                                  std::vector<std::string>& families) {
    const bool has_families = sweep.axes.size() > 1;
    std::vector<ChartPoint> points;
    for (const SweepVariant& variant : sweep.variants) {
        const auto x = cost.figure.empty() ? bake_seconds(variant, asset, cost.has_light)
                                           : figure_of(variant, asset, cost.figure);
        const auto y = figure_of(variant, asset, error.figure);
        if (!x || !y) continue;
        ChartPoint point;
        point.x = *x * cost.factor;
        point.y = *y * error.factor;
        point.family = family_index(
            families, has_families ? sweep.axes[0][sweep.place(variant, 0)] : "variants");
        point.label = sweep.label(variant, has_families ? 1 : 0);
        points.push_back(std::move(point));
    }
    return points;
}

// Marks the front. Only its points keep their labels, and of equal points only the first.
void mark_points(std::vector<ChartPoint>& points, double noise) {
    mark_front(points, noise);
    std::set<std::pair<double, double>> labelled;
    for (ChartPoint& point : points) {
        if (!point.on_front || !labelled.emplace(point.x, point.y).second) point.label.clear();
    }
}

// Whether not all points are at one place.
bool differ_in_place(const std::vector<ChartPoint>& points) {
    std::set<std::pair<double, double>> places;
    for (const ChartPoint& point : points) places.emplace(point.x, point.y);
    return places.size() > 1;
}

std::optional<PreviewPicture> plot_of(const PreviewSweep& sweep, const std::string& asset) {
    const PlottedFigure& error =
        is_measured(sweep, asset, "sky_median") ? sky_error_axis : lookup_error_axis;
    Figure figure;
    figure.title = asset + ": what accuracy costs";
    figure.front_name = "Pareto front";
    const PlottedFigure& time = shares_light(sweep, asset) ? own_time_axis : time_axis;
    for (const PlottedFigure& cost : {bytes_axis, time}) {
        auto points = points_of(sweep, asset, cost, error, figure.families);
        if (!differ_in_place(points)) continue;
        mark_points(points, cost.figure.empty() ? kTimingNoise : 0);
        figure.charts.push_back(scatter_chart(std::move(points), "", cost.title, error.title));
    }
    if (figure.charts.empty()) return std::nullopt;
    figure.subtitles = {fmt::format("variants of {}", fmt::join(sweep.names, ", "))};
    return as_plot(
        {asset + "_variants", figure.title,
         "A variant on the front is beaten by no other in both error and cost. Times are wall "
         "times of the bakes. Where variants share light, it is in none of them.",
         painted(drawing_of(figure))});
}

}  // namespace

SweepTable::SweepTable(const PreviewSweep& sweep) : sweep_(sweep) {
    // Figures that differ are to be seen without scrolling.
    std::vector<std::string> assets = sweep.assets;
    std::stable_partition(assets.begin(), assets.end(), [&](const std::string& asset) {
        return !is_the_same_everywhere(sweep, asset);
    });
    for (const std::string& asset : assets) {
        const std::set<std::string> measured = measured_figures(sweep, asset);
        for (const auto& [name, title, shown] : known_figures) {
            if (!measured.contains(name)) continue;
            figures_.push_back({asset, name, {fmt::format("{}: {}", asset, title), shown}});
        }
        for (const std::string& name : measured) {  // times: "texels_s"
            if (!name.ends_with("_s")) continue;
            const auto title = fmt::format("{}: {}", asset, name.substr(0, name.size() - 2));
            figures_.push_back({asset, name, {title, "duration"}});
        }
    }
}

std::vector<PageTable::Column> SweepTable::columns() const {
    std::vector<PageTable::Column> columns;
    for (std::size_t i = 0; i < sweep_.names.size(); ++i) {
        const bool numbers = std::ranges::all_of(sweep_.variants, [&](const SweepVariant& variant) {
            return variant.values[i].number.has_value();
        });
        columns.push_back({sweep_.names[i], numbers ? "number" : ""});
    }
    for (const Figure& figure : figures_) columns.push_back(figure.column);
    columns.push_back({"Picture: difference, RMS of 255", "figure"});
    columns.push_back({"Status", ""});
    return columns;
}

PageVariant SweepTable::row(const SweepVariant& variant, std::optional<double> difference,
                            const std::filesystem::path& folder) const {
    PageVariant row;
    row.name = variant.name;
    row.folder = (folder / variant.name).generic_string() + "/";
    for (const SweptValue& value : variant.values) row.cells.push_back({value.number, value.text});
    for (const Figure& figure : figures_) {
        row.cells.push_back({figure_of(variant, figure.asset, figure.name), ""});
    }
    row.cells.push_back({difference, ""});
    row.cells.push_back({std::nullopt, variant.status});
    return row;
}

std::vector<PreviewPicture> sweep_plots(const PreviewSweep& sweep) {
    std::vector<PreviewPicture> plots;
    for (const std::string& asset : sweep.assets) {
        if (auto plot = plot_of(sweep, asset)) plots.push_back(std::move(*plot));
    }
    return plots;
}

}  // namespace skybake
