// skybake diff: says how far two baked files or folders are apart.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "cli/console.h"
#include "cli/diff_files.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace options {

// Reads a number that is at least 0.
Outcome<double> read_tolerance(const std::string& text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, number);
    if (parsed.ec == std::errc{} && parsed.ptr == end && number >= 0) return {number, {}};
    return bad_value("--tolerance", text, "it takes a number of at least 0, such as 1e-6");
}

inline const Option<double> tolerance{"tolerance", 0, "NUMBER", {}, read_tolerance};
inline const Option<bool> metadata{"metadata"};

}  // namespace options

namespace {

using Json = nlohmann::ordered_json;

struct Judgement {
    double tolerance = 0;
    bool metadata = false;  // differences in the metadata count too

    bool equal(const FileDifference& file) const {
        return file.only_in.empty() && equal_within(file.image, tolerance) &&
               (!metadata || file.image.attributes.empty());
    }
    bool equal(const Comparison& comparison) const {
        return std::ranges::all_of(comparison.files,
                                   [this](const FileDifference& file) { return equal(file); });
    }
};

// Returns the nearest position at or before this one that does not cut a UTF-8 character.
std::size_t sign_begin(const std::string& text, std::size_t position) {
    while (position > 0 && position < text.size() && (text[position] & 0xC0) == 0x80) --position;
    return position;
}

// Returns the line of a text around a position, cut if it is long.
std::string line_around(const std::string& text, std::size_t position) {
    constexpr std::size_t longest = 60;
    constexpr std::size_t before = 20;
    position = std::min(position, text.size());
    const std::size_t start = position == 0 ? 0 : text.rfind('\n', position - 1) + 1;
    std::string line = text.substr(start, text.find('\n', start) - start);
    const std::size_t column = position - start;
    if (line.size() <= longest) return line;
    const std::size_t begin = column + before <= longest ? 0 : sign_begin(line, column - before);
    const std::size_t end = sign_begin(line, std::min(begin + longest, line.size()));
    return fmt::format("{}{}{}", begin > 0 ? "..." : "", line.substr(begin, end - begin),
                       end < line.size() ? "..." : "");
}

// Shows both texts where they first differ, because metadata may hold pages of text.
std::string difference_text(const AttributeDifference& entry) {
    if (!entry.first) return "only in the second";
    if (!entry.second) return "only in the first";
    const auto same = static_cast<std::size_t>(
        std::ranges::mismatch(*entry.first, *entry.second).in1 - entry.first->begin());
    return fmt::format("{} | {}", line_around(*entry.first, same),
                       line_around(*entry.second, same));
}

std::string channel_table(const ImageDifference& image) {
    TextTable table({Align::left, Align::right, Align::right, Align::right, Align::right});
    table.add_row({"channel", "max", "rms", "max relative", "texels", "largest at"});
    for (const ChannelDifference& channel : image.channels) {
        const std::vector<int>& worst = channel.worst;
        table.add_row({channel.channel, fmt::format("{:.3g}", channel.max_absolute),
                       fmt::format("{:.3g}", channel.rms),
                       fmt::format("{:.3g}", channel.max_relative),
                       fmt::format("{}", channel.differing),
                       channel.differing == 0 ? ""
                       : worst.size() == 2    ? fmt::format("column {}, row {}", worst[0], worst[1])
                                              : fmt::format("voxel {}", fmt::join(worst, ", "))});
    }
    return table.text();
}

std::string as_text(const FileDifference& file, const Judgement& judgement) {
    if (!file.only_in.empty()) return fmt::format("{}: only in {}\n", file.name, file.only_in);
    std::string text =
        fmt::format("{}: {}\n", file.name, judgement.equal(file) ? "equal" : "differs");
    if (!file.image.layout.empty()) text += fmt::format("  {}\n", file.image.layout);
    if (!equal_within(file.image, 0) && !file.image.channels.empty())
        text += channel_table(file.image);
    for (const AttributeDifference& entry : file.image.attributes) {
        text += fmt::format("  {}: {}\n", entry.name, difference_text(entry));
    }
    return text;
}

Json as_json(const FileDifference& file, const Judgement& judgement) {
    Json channels = Json::array();
    for (const ChannelDifference& channel : file.image.channels) {
        channels.push_back({{"channel", channel.channel},
                            {"max_absolute", channel.max_absolute},
                            {"rms", channel.rms},
                            {"max_relative", channel.max_relative},
                            {"differing", channel.differing},
                            {"worst", channel.worst}});
    }
    Json metadata = Json::array();
    for (const AttributeDifference& entry : file.image.attributes) {
        metadata.push_back({{"name", entry.name},
                            {"first", entry.first ? Json(*entry.first) : Json()},
                            {"second", entry.second ? Json(*entry.second) : Json()}});
    }
    return {{"file", file.name},
            {"equal", judgement.equal(file)},
            {"only_in", file.only_in},
            {"layout", file.image.layout},
            {"channels", std::move(channels)},
            {"metadata", std::move(metadata)}};
}

std::string as_json(const Comparison& comparison, const Judgement& judgement) {
    Json files = Json::array();
    for (const FileDifference& file : comparison.files) files.push_back(as_json(file, judgement));
    return event_line({{"event", "compared"},
                       {"equal", judgement.equal(comparison)},
                       {"tolerance", judgement.tolerance},
                       {"files", std::move(files)}});
}

std::string as_text(const Comparison& comparison, const Judgement& judgement) {
    std::string text;
    for (const FileDifference& file : comparison.files) text += as_text(file, judgement);
    return text;
}

ExitCode run_diff(const Invocation& invocation, Console& console) {
    const Comparison comparison = [&] {
        BakeProgress progress("diff", console);
        return compare(invocation.arguments()[0], invocation.arguments()[1], progress);
    }();
    if (interrupted()) return ExitCode::interrupted;
    const Judgement judgement{invocation[options::tolerance], invocation[options::metadata]};
    const ExitCode code = console.report(comparison.diagnostics);
    if (comparison.files.empty() && code != ExitCode::done) return code;
    console.result(console.json() ? as_json(comparison, judgement)
                                  : as_text(comparison, judgement));
    if (code != ExitCode::done) return code;
    return judgement.equal(comparison) ? ExitCode::done : ExitCode::differs;
}

}  // namespace

Command diff_command() {
    return {
        .name = "diff",
        .brief = "compare baked files",
        .summary = "compare two baked files or folders",
        .arguments = {{.name = "first",
                       .help =
                           "a baked file, an EXR, VDB, NanoVDB or HDR file, or a folder of them"},
                      {.name = "second", .help = "the file or folder to compare it with"}},
        .options = {options::tolerance("count values as equal up to this difference", "0"),
                    options::metadata("count differences in the metadata too")},
        .examples = {{"skybake diff old new", "compares all files of two folders"},
                     {"skybake diff a.exr b.exr --tolerance 1e-6", "allows for rounding"},
                     {"skybake diff a.vdb b.nvdb", "compares the values of their grids"}},
        .exit_codes = {ExitCode::differs, ExitCode::io},
        .run = run_diff};
}

}  // namespace skybake::cli
