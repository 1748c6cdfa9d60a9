// skybake cache: looks after the folder of ready-made assets.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "bakers/incremental/asset_cache.h"
#include "cli/byte_size.h"
#include "cli/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/parse_arguments.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string counted(std::size_t count, std::string_view what, std::string_view plural) {
    return fmt::format("{} {}", count, count == 1 ? what : plural);
}

std::uint64_t bytes_of(const std::vector<CacheEntry>& entries) {
    return std::accumulate(
        entries.begin(), entries.end(), std::uint64_t{0},
        [](std::uint64_t sum, const CacheEntry& entry) { return sum + entry.bytes; });
}

struct KindTotals {
    std::size_t assets = 0;
    std::uint64_t bytes = 0;
};

ExitCode stats(const std::string& folder, bool json, Console& console) {
    const auto entries = cache_entries(folder);
    if (const ExitCode code = console.report(entries.diagnostics); !entries.value) return code;
    std::map<std::string, KindTotals> kinds;
    for (const CacheEntry& entry : *entries.value) {
        KindTotals& totals = kinds[entry.kind.empty() ? "damaged" : entry.kind];
        ++totals.assets;
        totals.bytes += entry.bytes;
    }
    if (json) {
        Json by_kind = Json::object();
        for (const auto& [kind, totals] : kinds) {
            by_kind[kind] = {{"assets", totals.assets}, {"bytes", totals.bytes}};
        }
        const Json result = {{"assets", entries.value->size()},
                             {"bytes", bytes_of(*entries.value)},
                             {"kinds", std::move(by_kind)}};
        console.result(result.dump(2) + "\n");
        return ExitCode::done;
    }
    TextTable table({Align::left, Align::right, Align::right});
    table.add_row({"asset", "kept", "size"});
    for (const auto& [kind, totals] : kinds) {
        table.add_row({kind, std::to_string(totals.assets),
                       byte_size_text(static_cast<double>(totals.bytes))});
    }
    const double bytes = static_cast<double>(bytes_of(*entries.value));
    console.result((kinds.empty() ? "" : table.text()) +
                   fmt::format("{}, {}\n", counted(entries.value->size(), "asset", "assets"),
                               byte_size_text(bytes)));
    return ExitCode::done;
}

ExitCode gc(const std::string& folder, const std::string& size, bool json, Console& console) {
    const auto largest = parse_byte_size(size);
    if (!largest) return console.report(std::array{byte_size_error("--max-size", size)});
    const auto removed = collect_garbage(folder, *largest);
    if (const ExitCode code = console.report(removed.diagnostics); !removed.value) return code;
    const std::uint64_t bytes = bytes_of(*removed.value);
    if (json) {
        console.result(Json({{"removed", removed.value->size()}, {"bytes", bytes}}).dump(2) + "\n");
    } else {
        console.result(fmt::format("{} removed, {}\n",
                                   counted(removed.value->size(), "asset", "assets"),
                                   byte_size_text(static_cast<double>(bytes))));
    }
    return ExitCode::done;
}

ExitCode verify(const std::string& folder, bool json, Console& console) {
    const auto verified = verify_cache(folder);
    if (const ExitCode code = console.report(verified.diagnostics); !verified.value) return code;
    std::vector<std::string> damaged;
    for (const auto& file : verified.value->damaged) damaged.push_back(file.string());
    if (json) {
        const Json result = {{"assets", verified.value->entries}, {"damaged", damaged}};
        console.result(result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    } else {
        std::string text;
        for (const std::string& file : damaged) text += file + ": damaged, its asset was removed\n";
        text += counted(verified.value->entries, "asset", "assets");
        text +=
            damaged.empty()
                ? ", all whole\n"
                : fmt::format(", {}\n", counted(damaged.size(), "damaged file", "damaged files"));
        console.result(text);
    }
    return damaged.empty() ? ExitCode::done : ExitCode::differs;
}

ExitCode run_cache(const Invocation& invocation, Console& console) {
    const std::string& what = invocation.arguments()[0];
    const std::string folder = cache_folder(invocation);
    if (folder.empty()) {
        return console.report(
            std::array{usage_error("no cache is named", "--cache-dir or $SKYBAKE_CACHE_DIR")});
    }
    const bool json = invocation.has("json");
    if (what == "stats") return stats(folder, json, console);
    if (what == "verify") return verify(folder, json, console);
    if (what != "gc") {
        return console.report(std::array{usage_error(
            fmt::format("`{}` is nothing that a cache does", what), "stats, gc or verify")});
    }
    if (!invocation.has("max-size")) {
        return console.report(
            std::array{usage_error("gc: --max-size is missing", "such as --max-size 10GiB")});
    }
    return gc(folder, invocation.value("max-size"), json, console);
}

}  // namespace

Command cache_command() {
    return {.name = "cache",
            .brief = "keep ready-made assets",
            .summary = "look after the folder of ready-made assets",
            .arguments = {{.name = "stats|gc|verify",
                           .help = "what it holds, make room, prove that all is whole"}},
            .options = {{.name = "cache-dir",
                         .value = "FOLDER",
                         .help = "the cache (default: $SKYBAKE_CACHE_DIR)"},
                        {.name = "max-size",
                         .value = "SIZE",
                         .help = "gc: remove what was used least recently until this is left"},
                        {.name = "json", .help = "the result as JSON"}},
            .examples = {{"skybake cache stats --cache-dir ~/.cache/skybake", "what it holds"},
                         {"skybake cache gc --cache-dir ~/.cache/skybake --max-size 10GiB",
                          "make room"}},
            .exit_codes = {ExitCode::differs, ExitCode::io},
            .run = run_cache};
}

}  // namespace skybake::cli
