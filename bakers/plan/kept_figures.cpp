#include "bakers/plan/kept_figures.h"

#include <nlohmann/json.hpp>

#include "bakers/workspace/cache_folder.h"

namespace skybake {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kVersion = 1;  // of what is kept: a line of JSON, then the sheet

Json to_json(const MeasuredWay& way) {
    const SkyError& error = way.error;
    return {{"median", error.median},     {"p90", error.ninth_decile},
            {"max", error.max},           {"standard_error", error.standard_error},
            {"points", error.points},     {"left_out", error.left_out},
            {"worst", error.worst},       {"reference", error.reference},
            {"error", way.figures.error}, {"fetches", way.figures.fetches},
            {"bytes", way.figures.bytes}, {"operations", way.figures.operations},
            {"bake_s", way.bake_s}};
}

void read(const Json& row, MeasuredWay& way) {
    SkyError& error = way.error;
    error.median = row.at("median");
    error.ninth_decile = row.at("p90");
    error.max = row.at("max");
    error.standard_error = row.at("standard_error");
    error.points = row.at("points");
    error.left_out = row.at("left_out");
    error.worst = row.at("worst");
    error.reference = row.at("reference");
    way.figures = {row.at("error"), row.at("fetches"), row.at("bytes"), row.at("operations")};
    way.bake_s = row.at("bake_s");
}

}  // namespace

bool find_figures(const fs::path& cache, const std::string& key, MeasuredWays& plan) {
    const auto bytes = CachedBytes(cache).find({"plan", kVersion, key});
    if (!bytes) return false;
    const std::size_t end = bytes->find('\n');
    const Json rows = Json::parse(bytes->substr(0, end));
    if (rows.size() != plan.ways.size()) return false;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) read(rows[i], plan.ways[i]);
    plan.sheet = bytes->substr(end + 1);
    return true;
}

std::vector<Diagnostic> keep_figures(const fs::path& cache, const std::string& key,
                                     const MeasuredWays& plan) {
    Json rows = Json::array();
    for (const MeasuredWay& way : plan.ways) rows.push_back(to_json(way));
    return CachedBytes(cache).offer({"plan", kVersion, key}, rows.dump() + '\n' + plan.sheet);
}

}  // namespace skybake
