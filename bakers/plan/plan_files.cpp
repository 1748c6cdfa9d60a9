#include "bakers/plan/plan_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/release.h"
#include "bakers/math/facts.h"
#include "bakers/report/measurement.h"
#include "config/assets/asset_kind.h"

namespace skybake {

namespace {

using Json = nlohmann::ordered_json;

std::string_view by_text(config::SkyBy by) {
    switch (by) {
        case config::SkyBy::march:
            return "march";
        case config::SkyBy::fetch:
            return "fetch";
        case config::SkyBy::picture:
            return "picture";
    }
    return "";
}

// A column of CSV and a key of JSON.
struct Column {
    std::string_view name;
    std::function<Json(const MeasuredWay&)> value;
};

double figure(double value) { return to_digits(value, 4); }

const std::vector<Column>& columns() {
    static const std::vector<Column> all = {
        {"by", [](const MeasuredWay& way) { return Json(by_text(way.way.by)); }},
        {"family", [](const MeasuredWay& way) { return Json(way.way.family); }},
        {"variant", [](const MeasuredWay& way) { return Json(way.way.name); }},
        {"baseline", [](const MeasuredWay& way) { return Json(way.way.baseline); }},
        {"sky_median", [](const MeasuredWay& way) { return Json(figure(way.error.median)); }},
        {"sky_p90", [](const MeasuredWay& way) { return Json(figure(way.error.ninth_decile)); }},
        {"sky_max", [](const MeasuredWay& way) { return Json(figure(way.error.max)); }},
        {"standard_error",
         [](const MeasuredWay& way) { return Json(figure(way.error.standard_error)); }},
        {"fetches", [](const MeasuredWay& way) { return Json(std::llround(way.figures.fetches)); }},
        {"bytes", [](const MeasuredWay& way) { return Json(std::llround(way.figures.bytes)); }},
        {"bake_s", [](const MeasuredWay& way) { return Json(figure(way.bake_s)); }},
        {"on_front", [](const MeasuredWay& way) { return Json(way.on_front); }},
    };
    return all;
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json limit(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

ChartPoint point_of(const SkyPlan& plan, std::size_t index, double cost,
                    std::vector<std::string>& families) {
    const MeasuredWay& way = plan.ways[index];
    ChartPoint point;
    point.x = cost;
    point.y = way.figures.error;
    point.family = family_index(families, way.way.family);
    point.tooltip = fmt::format("{}: {}", full_name(way.way), figures_text(way.figures));
    point.emphasised = index == plan.chosen;
    if (index == plan.chosen) point.label = plan.keeps_limits ? "chosen" : "least error";
    return point;
}

// Marks the front of a chart's own two figures, which is what its line joins.
void mark_front(std::vector<ChartPoint>& points) {
    std::vector<CostAndError> choices;
    for (const ChartPoint& point : points) choices.push_back({point.x, point.y});
    const std::vector<bool> front = pareto_front(choices);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].on_front = front[i];
}

// Names each baseline once, at its least error.
void label_baselines(const SkyPlan& plan, std::vector<ChartPoint>& points) {
    std::map<std::string_view, std::size_t> least;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (plan.ways[i].way.baseline.empty()) continue;
        const auto [best, is_first] = least.try_emplace(plan.ways[i].way.baseline, i);
        if (points[i].y < points[best->second].y) best->second = i;
    }
    for (const auto& [name, i] : least) {
        if (points[i].label.empty()) points[i].label = name;
    }
}

Chart chart_of(const SkyPlan& plan, const std::string& title, double WayFigures::*cost, double unit,
               std::vector<std::string>& families) {
    std::vector<ChartPoint> points;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        points.push_back(point_of(plan, i, plan.ways[i].figures.*cost / unit, families));
    }
    mark_front(points);
    label_baselines(plan, points);
    for (ChartPoint& point : points) point.y *= 100;
    return scatter_chart(std::move(points), "", title, "sky error, ninth decile (%)");
}

std::string suns_text(const SceneRange& range) {
    if (range.suns_deg.empty()) {
        return fmt::format("suns from {:.3g} to {:.3g} degrees", range.lowest_sun_deg,
                           range.highest_sun_deg);
    }
    std::vector<std::string> suns;
    for (const double sun : range.suns_deg) suns.push_back(fmt::format("{:.3g}", sun));
    return fmt::format("suns at {} degrees", fmt::join(suns, ", "));
}

std::string asset_text(const WayAsset& asset) {
    std::string text = fmt::format("\n[bake.{}]\n", asset.name);
    for (const auto& [key, value] : asset.keys) text += fmt::format("{} = {}\n", key, value);
    return text;
}

std::string neighbour_text(const SkyPlan& plan, std::string_view what, std::size_t index) {
    const MeasuredWay& way = plan.ways[index];
    return fmt::format("# The next {} on the front is {}: {}.\n", what, full_name(way.way),
                       figures_text(way.figures));
}

}  // namespace

std::string views_text(const SkyPlan& plan) {
    return fmt::format("cameras from {:.3g} to {:.3g} km, {}", plan.range.lowest_altitude_km,
                       plan.range.highest_altitude_km, suns_text(plan.range));
}

std::string figures_text(const WayFigures& figures) {
    return fmt::format("at most {} % off in nine of ten views, {:.0f} {}, {}",
                       to_percent(figures.error), figures.fetches,
                       figures.fetches == 1 ? "fetch" : "fetches", byte_size_text(figures.bytes));
}

std::string full_name(const SkyWay& way) { return fmt::format("{}, {}", way.family, way.name); }

std::vector<std::size_t> front_by_error(const SkyPlan& plan) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        if (plan.ways[i].on_front) front.push_back(i);
    }
    std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
        return plan.ways[a].figures.error < plan.ways[b].figures.error;
    });
    return front;
}

std::string plan_csv(const SkyPlan& plan) {
    std::string text;
    for (const Column& column : columns()) {
        text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
    }
    text += ",chosen\n";
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        for (const Column& column : columns()) text += dump(column.value(plan.ways[i]), -1) + ",";
        text += i == plan.chosen && plan.keeps_limits ? "true\n" : "false\n";
    }
    return text;
}

std::string plan_json(const SkyPlan& plan) {
    Json ways = Json::array();
    for (const MeasuredWay& way : plan.ways) {
        Json entry = Json::object();
        for (const Column& column : columns()) entry[std::string(column.name)] = column.value(way);
        Json assets = Json::object();
        for (const WayAsset& asset : way.way.assets) {
            for (const auto& [key, value] : asset.keys)
                assets[asset.name][key] = Json::parse(value);  // TOML that is JSON too
        }
        entry["assets"] = std::move(assets);
        ways.push_back(std::move(entry));
    }
    const Json json = {{"plan", {{"tool", tool_name()}, {"version", release()}, {"format", 1}}},
                       {"views", views_text(plan)},
                       {"reference", plan.reference},
                       {"limits",
                        {{"sky_p90", limit(plan.limits.error)},
                         {"fetches", limit(plan.limits.fetches)},
                         {"bytes", limit(plan.limits.bytes)}}},
                       {"chosen", plan.keeps_limits ? Json(plan.chosen) : Json(nullptr)},
                       {"knee", plan.knee},
                       {"notes", plan.notes},
                       {"ways", std::move(ways)}};
    return dump(json, 2) + "\n";
}

Figure plan_figure(const SkyPlan& plan) {
    Figure chart;
    chart.title = "Ways to draw the sky";
    chart.subtitles = {"the error that nine in ten views stay below, against " + plan.reference,
                       views_text(plan)};
    chart.front_name = "front";
    chart.charts.push_back(
        chart_of(plan, "textures (KiB)", &WayFigures::bytes, 1024, chart.families));
    chart.charts.push_back(
        chart_of(plan, "fetches per pixel", &WayFigures::fetches, 1, chart.families));
    return chart;
}

std::string planned_recipe(const SkyPlan& plan, const config::Recipe& recipe) {
    const MeasuredWay& chosen = plan.ways[plan.chosen];
    std::string text =
        fmt::format("# Chosen by `skybake plan`: {}.\n# {}, for {}.\n", full_name(chosen.way),
                    figures_text(chosen.figures), views_text(plan));
    const std::vector<std::size_t> front = front_by_error(plan);
    const auto at = std::find(front.begin(), front.end(), plan.chosen);
    if (at != front.begin()) text += neighbour_text(plan, "better way", *(at - 1));
    if (at + 1 != front.end()) text += neighbour_text(plan, "less accurate way", *(at + 1));
    if (chosen.way.steps > 0) {
        text += fmt::format("# The runtime marches in {} steps.\n", chosen.way.steps);
    }
    text += "# A bake's own error.sky is larger: it looks where skies are hardest, not evenly.\n";
    std::vector<config::Read> reads =
        config::reads_of_light(recipe.parameters, config::Roles::all());
    reads.push_back({"scene", config::Roles::all()});
    text += "\n" + config::parameters_toml(recipe, reads);
    for (const WayAsset& asset : chosen.way.assets) text += asset_text(asset);
    return text;
}

}  // namespace skybake
