#include "bakers/plan/kept_figures.h"

#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/math/hash.h"
#include "bakers/workspace/cache_folder.h"

namespace skybake {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::uintmax_t kLargestFile = 1 << 24;

fs::path path_of(const fs::path& cache, const std::string& key, const char* extension) {
    return cache / "plans" / key.substr(0, 2) / (key + extension);
}

Json to_json(const MeasuredWay& way) {
    const SkyError& error = way.error;
    return {{"median", error.median},     {"p90", error.ninth_decile},
            {"max", error.max},           {"standard_error", error.standard_error},
            {"points", error.points},     {"left_out", error.left_out},
            {"worst", error.worst},       {"reference", error.reference},
            {"error", way.figures.error}, {"fetches", way.figures.fetches},
            {"bytes", way.figures.bytes}, {"bake_s", way.bake_s}};
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
    way.figures = {row.at("error"), row.at("fetches"), row.at("bytes")};
    way.bake_s = row.at("bake_s");
}

}  // namespace

bool find_figures(const fs::path& cache, const std::string& key, MeasuredWays& plan) {
    if (cache.empty()) return false;
    const auto text = read_file(path_of(cache, key, ".json"), kLargestFile);
    auto sheet = read_file(path_of(cache, key, ".png"), kLargestFile);
    if (!text.value || !sheet.value) return false;
    const Json kept = Json::parse(*text.value, nullptr, false);
    if (!kept.is_object() || kept.value("key", "") != key) return false;
    const Json rows = kept.value("ways", Json::array());
    if (kept.value("values", "") != xxh3_hex(rows.dump() + *sheet.value) ||
        rows.size() != plan.ways.size()) {
        return false;
    }
    for (std::size_t i = 0; i < plan.ways.size(); ++i) read(rows[i], plan.ways[i]);
    plan.sheet = std::move(*sheet.value);
    return true;
}

std::vector<Diagnostic> keep_figures(const fs::path& cache, const std::string& key,
                                     const MeasuredWays& plan) {
    if (cache.empty()) return {};
    Json rows = Json::array();
    for (const MeasuredWay& way : plan.ways) rows.push_back(to_json(way));
    const Json kept = {
        {"key", key}, {"values", xxh3_hex(rows.dump() + plan.sheet)}, {"ways", rows}};
    const fs::path path = path_of(cache, key, ".json");
    std::vector<Diagnostic> problems = make_cache_folder(cache);
    std::error_code error;
    if (problems.empty()) fs::create_directories(path.parent_path(), error);
    if (error) problems = {file_error("E0301", path.string(), error.message())};
    if (problems.empty()) {
        problems = write_file_atomically(path_of(cache, key, ".png"), plan.sheet).diagnostics;
    }
    if (problems.empty()) problems = write_file_atomically(path, kept.dump()).diagnostics;
    for (Diagnostic& problem : problems) {
        problem.severity = Severity::warning;
        problem.code = "W0301";
        problem.message = "the cache could not keep the plan's figures: " + problem.message;
    }
    return problems;
}

}  // namespace skybake
