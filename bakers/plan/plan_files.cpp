#include "bakers/plan/plan_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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
#include "config/text/key_path.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

double figure(double value) { return to_digits(value, 4); }

// The columns of CSV, which are keys of JSON too.
Json row_of(const MeasuredWay& measured) {
    const auto& [way, error, figures, bake_s, on_front] = measured;
    return {{"by", way.by},
            {"family", way.family},
            {"variant", way.name},
            {"baseline", way.baseline},
            {"median", figure(error.median)},
            {"p90", figure(error.ninth_decile)},
            {"max", figure(error.max)},
            {"standard_error", figure(error.standard_error)},
            {"fetches", std::llround(figures.fetches)},
            {"operations", std::llround(figures.operations)},
            {"bytes", std::llround(figures.bytes)},
            {"bake_s", figure(bake_s)},
            {"on_front", on_front}};
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json limit(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

ChartPoint point_of(const Plan& plan, std::size_t index, double cost,
                    std::vector<std::string>& families) {
    const MeasuredWay& way = plan.ways[index];
    ChartPoint point;
    point.x = cost;
    point.y = way.figures.error;
    point.family = family_index(families, way.way.family);
    point.tooltip = fmt::format("{}: {}", full_name(way.way), figures_text(plan, way.figures));
    point.emphasised = index == plan.chosen;
    if (index == plan.chosen) point.label = plan.keeps_limits ? "chosen" : "least error";
    return point;
}

// Names each baseline once, at its least error.
void label_baselines(const Plan& plan, std::vector<ChartPoint>& points) {
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

Chart chart_of(const Plan& plan, const std::string& title, double WayFigures::*cost, double unit,
               std::vector<std::string>& families) {
    std::vector<ChartPoint> points;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        points.push_back(point_of(plan, i, plan.ways[i].figures.*cost / unit, families));
    }
    mark_front(points);
    label_baselines(plan, points);
    for (ChartPoint& point : points) point.y *= 100;
    return scatter_chart(std::move(points), "", title, plan.words.compared);
}

std::string asset_text(const WayAsset& asset) {
    std::string text = fmt::format("\n[{}]\n", config::join_path("bake", asset.name));
    for (const auto& [key, value] : asset.keys) text += fmt::format("{} = {}\n", key, value);
    return text;
}

std::string neighbour_text(const Plan& plan, std::string_view what, std::size_t index) {
    const MeasuredWay& way = plan.ways[index];
    return fmt::format("# The next {} on the front is {}: {}.\n", what, full_name(way.way),
                       figures_text(plan, way.figures));
}

Json to_json(const Plan& plan) {
    Json ways = Json::array();
    for (const MeasuredWay& way : plan.ways) {
        Json entry = row_of(way);
        Json assets = Json::object();
        for (const WayAsset& asset : way.way.assets) {
            for (const auto& [key, value] : asset.keys)
                assets[asset.name][key] = Json::parse(value);  // TOML that is JSON too
        }
        entry["assets"] = std::move(assets);
        ways.push_back(std::move(entry));
    }
    return {{"subject", word_of(plan.subject)},
            {"views", plan.scene},
            {"reference", plan.reference},
            {"compared", plan.words.compared},
            {"limits",
             {{"error", limit(plan.limits.error)},
              {"fetches", limit(plan.limits.fetches)},
              {"bytes", limit(plan.limits.bytes)}}},
            {"chosen", plan.keeps_limits ? Json(plan.chosen) : Json(nullptr)},
            {"knee", plan.knee},
            {"notes", plan.notes},
            {"ways", std::move(ways)}};
}

// Says what was chosen, at what cost, and what its neighbours on the front have.
std::string choice_text(const Plan& plan) {
    const MeasuredWay& chosen = plan.ways[plan.chosen];
    std::string text =
        fmt::format("# {}: {}.\n# {}, for {}.\n", name_of(plan.subject), full_name(chosen.way),
                    figures_text(plan, chosen.figures), plan.scene);
    std::vector<std::size_t> front = by_error(plan.ways);
    std::erase_if(front, [&](std::size_t i) { return !plan.ways[i].on_front; });
    const auto at = std::ranges::find(front, plan.chosen);
    if (at != front.begin()) text += neighbour_text(plan, "better way", *(at - 1));
    if (at + 1 != front.end()) text += neighbour_text(plan, "less accurate way", *(at + 1));
    if (chosen.way.steps > 0) {
        text += fmt::format("# The runtime marches in {} steps.\n", chosen.way.steps);
    }
    return text + plan.words.remark;
}

}  // namespace

std::string figures_text(const Plan& plan, const WayFigures& figures) {
    return fmt::format(
        "{}, {:.0f} {}, {}", fmt::format(fmt::runtime(plan.words.claim), to_percent(figures.error)),
        figures.fetches, figures.fetches == 1 ? "fetch" : "fetches", byte_size_text(figures.bytes));
}

std::string full_name(const Way& way) { return fmt::format("{}, {}", way.family, way.name); }

std::string plan_csv(std::span<const Plan> plans) {
    std::string text = "subject";
    const Json first = row_of(plans.front().ways.front());
    for (const auto& [name, value] : first.items()) text += "," + name;
    text += ",chosen\n";
    for (const Plan& plan : plans) {
        for (std::size_t i = 0; i < plan.ways.size(); ++i) {
            text += word_of(plan.subject);
            for (const Json& value : row_of(plan.ways[i]))
                text += fmt::format(",{}", dump(value, -1));
            text += i == plan.chosen && plan.keeps_limits ? ",true\n" : ",false\n";
        }
    }
    return text;
}

std::string plan_json(std::span<const Plan> plans) {
    Json all = Json::array();
    for (const Plan& plan : plans) all.push_back(to_json(plan));
    const Json json = {{"plan", {{"tool", tool_name()}, {"version", release()}, {"format", 1}}},
                       {"subjects", std::move(all)}};
    return dump(json, 2) + "\n";
}

Figure plan_figure(const Plan& plan) {
    Figure chart;
    chart.title = fmt::format("Ways to draw {}", name_of(plan.subject));
    chart.subtitles = {"against " + plan.reference, plan.scene};
    chart.front_name = "front";
    chart.charts.push_back(
        chart_of(plan, "textures (KiB)", &WayFigures::bytes, 1024, chart.families));
    chart.charts.push_back(
        chart_of(plan, "fetches per pixel", &WayFigures::fetches, 1, chart.families));
    return chart;
}

std::string planned_recipe(std::span<const Plan> plans, const Recipe& recipe) {
    std::string text = "# Chosen by `skybake plan`.\n";
    std::vector<config::Read> reads = {{"scene", config::Roles::all()}};
    for (const Plan& plan : plans) {
        text += "#\n" + choice_text(plan);
        reads.insert(reads.end(), plan.reads.begin(), plan.reads.end());
    }
    text += "\n" + config::parameters_toml(recipe, reads);
    std::vector<WayAsset> written;
    for (const Plan& plan : plans) {
        for (const WayAsset& asset : plan.ways[plan.chosen].way.assets) {
            // An asset that two plans chose is baked once.
            if (std::ranges::find(written, asset.keys, &WayAsset::keys) != written.end()) continue;
            text += asset_text(asset);
            written.push_back(asset);
        }
    }
    return text;
}

}  // namespace skybake
