// skybake cache: inspects, verifies and trims the asset cache.
#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "bakers/io/files/to_string.h"
#include "bakers/workspace/asset_cache.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace options {

// Reads an amount in bytes.
Outcome<std::uint64_t> read_max_size(const std::string& text) {
    if (const auto bytes = parse_byte_size(text)) return {*bytes, {}};
    return bad_value("--max-size", text, std::string(byte_size_words));
}

inline const Option<std::uint64_t> max_size{"max-size", 0, "SIZE", {}, read_max_size};

}  // namespace options

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::uint64_t bytes_of(const std::vector<CacheEntry>& entries) {
    return std::accumulate(
        entries.begin(), entries.end(), std::uint64_t{0},
        [](std::uint64_t sum, const CacheEntry& entry) { return sum + entry.bytes; });
}

struct KindTotals {
    std::size_t assets = 0;
    std::uint64_t bytes = 0;
};

ExitCode stats(const fs::path& folder, Console& console) {
    const auto entries = cache_entries(folder);
    if (const ExitCode code = console.report(entries.diagnostics); !entries.value) return code;
    std::map<std::string, KindTotals> kinds;
    for (const CacheEntry& entry : *entries.value) {
        KindTotals& totals = kinds[entry.kind.empty() ? "damaged" : entry.kind];
        ++totals.assets;
        totals.bytes += entry.bytes;
    }
    if (console.json()) {
        Json by_kind = Json::object();
        for (const auto& [kind, totals] : kinds) {
            by_kind[kind] = {{"assets", totals.assets}, {"bytes", totals.bytes}};
        }
        console.result(event_line({{"event", "cache_stats"},
                                   {"assets", entries.value->size()},
                                   {"bytes", bytes_of(*entries.value)},
                                   {"kinds", std::move(by_kind)}}));
        return ExitCode::done;
    }
    TextTable table({Align::left, Align::right, Align::right});
    table.add_row({"kind", "assets", "size"});
    for (const auto& [kind, totals] : kinds) {
        table.add_row({kind, std::to_string(totals.assets),
                       byte_size_text(static_cast<double>(totals.bytes))});
    }
    const double bytes = static_cast<double>(bytes_of(*entries.value));
    console.result(
        (kinds.empty() ? "" : table.text()) +
        fmt::format("{}, {}\n", counted(entries.value->size(), "asset"), byte_size_text(bytes)));
    return ExitCode::done;
}

ExitCode gc(const fs::path& folder, std::uint64_t largest, Console& console) {
    const auto removed = collect_garbage(folder, largest);
    if (const ExitCode code = console.report(removed.diagnostics); !removed.value) return code;
    const std::uint64_t bytes = bytes_of(*removed.value);
    if (console.json()) {
        console.result(event_line(
            {{"event", "cache_trimmed"}, {"removed", removed.value->size()}, {"bytes", bytes}}));
    } else {
        console.result(fmt::format("{} removed, {}\n", counted(removed.value->size(), "asset"),
                                   byte_size_text(static_cast<double>(bytes))));
    }
    return ExitCode::done;
}

ExitCode verify(const fs::path& folder, Console& console) {
    const auto verified = verify_cache(folder);
    if (const ExitCode code = console.report(verified.diagnostics); !verified.value) return code;
    std::vector<std::string> damaged;
    for (const auto& file : verified.value->damaged) damaged.push_back(file.string());
    if (console.json()) {
        console.result(event_line({{"event", "cache_verified"},
                                   {"assets", verified.value->entries},
                                   {"damaged", damaged}}));
    } else {
        std::string text;
        for (const std::string& file : damaged)
            text += file + " is damaged; its asset was removed\n";
        text += counted(verified.value->entries, "asset");
        text += damaged.empty() ? ", none is damaged\n"
                                : fmt::format(", {}\n", counted(damaged.size(), "damaged file"));
        console.result(text);
    }
    return damaged.empty() ? ExitCode::done : ExitCode::differs;
}

ExitCode run_cache(const Invocation& invocation, Console& console) {
    const std::string& what = invocation.arguments()[0];
    const auto given = cache_folder(invocation);
    if (!given.value) return console.report(given.diagnostics);
    const fs::path& folder = *given.value;
    if (folder.empty()) {
        return console.report(std::array{usage_error(
            "no cache folder is given", "name one with --cache-dir or $SKYBAKE_CACHE_DIR")});
    }
    if (what == "stats") return stats(folder, console);
    if (what == "verify") return verify(folder, console);
    if (what != "gc") {
        return console.report(
            std::array{usage_error(fmt::format("`skybake cache` has no action `{}`", what),
                                   "its actions are stats, gc and verify")});
    }
    if (!invocation.has(options::max_size)) {
        return console.report(std::array{
            usage_error("`skybake cache gc` needs --max-size", "for example --max-size 10GiB")});
    }
    return gc(folder, invocation[options::max_size], console);
}

}  // namespace

Command cache_command() {
    return {.name = "cache",
            .brief = "manage the asset cache",
            .summary = "inspect, verify and trim the asset cache",
            .arguments = {{.name = "stats|gc|verify",
                           .help = "show its contents, remove old assets, or check its files",
                           .choices = {"stats", "gc", "verify"}}},
            .options = {options::cache_dir("the folder of the cache (default: $SKYBAKE_CACHE_DIR)"),
                        options::max_size(
                            "let gc remove the least recently used assets beyond this size")},
            .examples = {{"skybake cache stats --cache-dir ~/.cache/skybake", "shows its contents"},
                         {"skybake cache gc --cache-dir ~/.cache/skybake --max-size 10GiB",
                          "keeps at most 10 GiB"}},
            .exit_codes = {ExitCode::differs, ExitCode::io},
            .run = run_cache};
}

}  // namespace skybake::cli
