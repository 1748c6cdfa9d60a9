#include "bakers/plan/kept_figures.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "bakers/assets/registry/registry.h"
#include "bakers/math/hash.h"
#include "bakers/plan/plan_files.h"
#include "bakers/workspace/cache_folder.h"
#include "config/assets/asset_kind.h"

namespace skybake {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kVersion = 1;  // of what is kept: a line of JSON, then the sheet

// All that is kept of a way, in the order of the line.
auto kept_of(MeasuredWay& way) {
    SkyError& error = way.error;
    auto& [compared, fetches, bytes, operations] = way.figures;
    return std::tie(error.median, error.ninth_decile, error.max, error.standard_error, error.points,
                    error.left_out, error.worst, error.reference, compared, fetches, bytes,
                    operations, way.bake_s);
}

}  // namespace

std::string figures_key(const Recipe& recipe, std::vector<config::Read> reads,
                        const WayAssets& assets, const MeasuredWays& plan,
                        const std::string& rest) {
    reads.push_back({"scene", {config::Role::content}});
    std::string text = rest + config::parameters_toml(recipe, reads);
    for (const AnyBaker& baker : bakers())
        text += fmt::format("{} {}\n", baker.asset, baker.version);
    for (const std::string& setting : assets.settings()) text += setting + '\n';
    for (const MeasuredWay& way : plan.ways) text += full_name(way.way) + '\n';
    return xxh3_hex(text);
}

bool find_figures(const fs::path& cache, const std::string& key, MeasuredWays& plan) {
    const auto bytes = CachedBytes(cache).find({"plan", kVersion, key});
    if (!bytes) return false;
    const std::size_t end = bytes->find('\n');
    const Json rows = Json::parse(bytes->substr(0, end));
    if (rows.size() != plan.ways.size()) return false;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        std::size_t k = 0;
        std::apply([&](auto&... values) { ((values = rows[i].at(k++)), ...); },
                   kept_of(plan.ways[i]));
    }
    plan.sheet = bytes->substr(end + 1);
    return true;
}

std::vector<Diagnostic> keep_figures(const fs::path& cache, const std::string& key,
                                     const MeasuredWays& plan) {
    Json rows = Json::array();
    for (MeasuredWay way : plan.ways) rows.push_back(kept_of(way));
    return CachedBytes(cache).offer({"plan", kVersion, key}, rows.dump() + '\n' + plan.sheet);
}

}  // namespace skybake
