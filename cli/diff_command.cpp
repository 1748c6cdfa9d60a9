// skybake diff: says how far two baked files or folders are apart.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/compare.h"
#include "bakers/io/volumes/grid_files.h"
#include "cli/console.h"
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

namespace fs = std::filesystem;

// These are two files with the same name, or one file without a counterpart.
struct FileDifference {
    std::string name;
    std::string only_in;  // the only folder that has it; empty if both have it
    ImageDifference image;
};

struct Comparison {
    std::vector<FileDifference> files;
    std::vector<Diagnostic> diagnostics;
};

struct Judgement {
    double tolerance = 0;
    bool metadata = false;  // differences in the metadata count too

    bool equal(const FileDifference& file) const {
        return file.only_in.empty() && equal_within(file.image, tolerance) &&
               (!metadata || file.image.attributes.empty());
    }
    bool equal(const Comparison& comparison) const {
        for (const FileDifference& file : comparison.files) {
            if (!equal(file)) return false;
        }
        return true;
    }
};

// --- Comparing ----------------------------------------------------------------------------------

void append(const std::vector<Diagnostic>& from, std::vector<Diagnostic>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

// Compares two images, which have been opened. A name tells them apart from others.
template <class Image, class Compared>
void compare_opened(config::Outcome<Image> first, config::Outcome<Image> second,
                    const Compared& compared, const std::string& name, Comparison& comparison) {
    append(first.diagnostics, comparison.diagnostics);
    append(second.diagnostics, comparison.diagnostics);
    if (!first.value || !second.value) return;
    auto difference = skybake::compare_images(compared(*first.value), compared(*second.value));
    append(difference.diagnostics, comparison.diagnostics);
    if (!difference.value) return;
    comparison.files.push_back({name, "", std::move(*difference.value)});
}

void compare_images(const fs::path& first, const fs::path& second, Comparison& comparison) {
    const auto parts = read_exr_heads(first);
    const auto others = read_exr_heads(second);
    const std::string name = second.filename().string();
    const std::size_t count = parts.value ? parts.value->size() : 1;
    if (others.value && parts.value && others.value->size() != count) {
        ImageDifference difference;
        difference.layout = fmt::format("{} parts against {}", count, others.value->size());
        comparison.files.push_back({name, "", std::move(difference)});
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_one = count == 1;
        const auto part = static_cast<int>(i);
        compare_opened(
            ExrRows::open(first, part), ExrRows::open(second, part),
            [](ExrRows& file) { return compared(file); },
            is_one ? name : fmt::format("{}, part {}", name, (*parts.value)[i].name), comparison);
    }
}

bool is_radiance(const fs::path& path) { return path.extension() == ".hdr"; }

// Compares the levels that both files have.
void compare_levels(const ListedFile& first, const ListedFile& second, Comparison& comparison) {
    const std::string name = second.path.filename().string();
    if (first.file.levels != second.file.levels) {
        FileDifference& file = comparison.files.emplace_back();
        file.name = name;
        file.image.layout =
            fmt::format("{} levels against {}", first.file.levels, second.file.levels);
        return;
    }
    for (int level = 0; level < first.file.levels; ++level) {
        auto difference = compare_listed(first, second, level);
        append(difference.diagnostics, comparison.diagnostics);
        if (!difference.value) return;
        comparison.files.push_back(
            {first.file.levels == 1 ? name : fmt::format("{}, level {}", name, level), "",
             std::move(*difference.value)});
    }
}

// Compares files by their bytes. If these differ, those with grids, Radiance pictures and files that their
// manifests list are compared by their values.
void compare_bytes(const fs::path& first, const fs::path& second, Comparison& comparison) {
    const auto a = fingerprint(first);
    const auto b = fingerprint(second);
    append(a.diagnostics, comparison.diagnostics);
    append(b.diagnostics, comparison.diagnostics);
    if (!a.value || !b.value) return;
    FileDifference file{second.filename().string(), "", {}};
    if (a.value->bytes == b.value->bytes && a.value->xxh3 == b.value->xxh3) {
        comparison.files.push_back(std::move(file));
        return;
    }
    if (is_radiance(first) && is_radiance(second)) {
        return compare_opened(
            compared_radiance(first), compared_radiance(second),
            [](const ComparedImage& image) { return image; }, file.name, comparison);
    }
    const bool have_grids = has_grids(first) && has_grids(second);
    const auto one = have_grids ? std::nullopt : listed_file(first);
    const auto other = one ? listed_file(second) : std::nullopt;
    if (other) return compare_levels(*one, *other, comparison);
    if (have_grids) {
        auto difference = compare_volumes(first, second);
        append(difference.diagnostics, comparison.diagnostics);
        if (!difference.value) return;
        file.image = std::move(*difference.value);
    } else if (a.value->bytes != b.value->bytes) {
        file.image.layout = fmt::format("{} bytes against {}", a.value->bytes, b.value->bytes);
    } else {
        file.image.layout =
            "the bytes differ; only values of EXR, VDB, NanoVDB and HDR files are compared "
            "without a manifest that lists them";
    }
    comparison.files.push_back(std::move(file));
}

bool is_image(const fs::path& path) { return path.extension() == ".exr"; }

// Whether the file is a volume in a format other than EXR, or a file that stands beside a volume.
// The manifest does not count: it says how each file was made and how long that took.
bool is_other_volume(const fs::path& path) {
    if (path.extension() == ".json") return path.filename() != "manifest.json";
    return !is_image(path) && path.has_extension() &&
           find_format(path.extension().string().substr(1)) != nullptr;
}

void compare_files(const fs::path& first, const fs::path& second, Comparison& comparison) {
    if (is_other_volume(first) && is_other_volume(second)) {
        compare_bytes(first, second, comparison);
    } else {
        compare_images(first, second, comparison);
    }
}

std::set<std::string> files_in(const fs::path& folder, std::vector<Diagnostic>& diagnostics) {
    std::set<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (is_image(entry->path()) || is_other_volume(entry->path())) {
            names.insert(entry->path().filename().string());
        }
    }
    if (error || names.empty()) {
        diagnostics.push_back(file_error(
            "E0300", folder.string(),
            fmt::format("cannot compare `{}`: {}", folder.string(),
                        error ? error.message() : "it holds no .exr, .vdb or .bin file")));
    }
    return names;
}

// Returns the bytes of those files of a folder that are there.
double bytes_of(const fs::path& folder, const std::set<std::string>& names) {
    double bytes = 0;
    for (const std::string& name : names) {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(folder / name, error);
        if (!error) bytes += static_cast<double>(size);
    }
    return bytes;
}

void compare_folders(const fs::path& first, const fs::path& second, Progress& progress,
                     Comparison& comparison) {
    const auto in_first = files_in(first, comparison.diagnostics);
    const auto in_second = files_in(second, comparison.diagnostics);
    if (!comparison.diagnostics.empty()) return;
    std::set<std::string> names = in_first;
    names.insert(in_second.begin(), in_second.end());
    double bytes_left = bytes_of(second, in_second);
    const double bytes = std::max(bytes_left, 1.0);
    for (const std::string& name : names) {
        if (progress.cancelled()) return;
        progress.advance("files", 1 - bytes_left / bytes);
        bytes_left -= bytes_of(second, {name});
        if (in_first.count(name) == 0) {
            comparison.files.push_back({name, second.string(), {}});
        } else if (in_second.count(name) == 0) {
            comparison.files.push_back({name, first.string(), {}});
        } else {
            compare_files(first / name, second / name, comparison);
        }
    }
}

Comparison compare(const fs::path& first, const fs::path& second, Progress& progress) {
    Comparison comparison;
    std::error_code error;
    const bool folders = fs::is_directory(first, error);
    if (folders != fs::is_directory(second, error) && fs::exists(first, error) &&
        fs::exists(second, error)) {
        comparison.diagnostics.push_back(usage_error("a file cannot be compared with a folder"));
    } else if (folders) {
        compare_folders(first, second, progress, comparison);
    } else {
        compare_files(first, second, comparison);
    }
    return comparison;
}

// --- Showing ------------------------------------------------------------------------------------

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
    std::size_t same = 0;
    while (same < entry.first->size() && same < entry.second->size() &&
           (*entry.first)[same] == (*entry.second)[same]) {
        ++same;
    }
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

using Json = nlohmann::ordered_json;

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
    console.result(console.display().json ? as_json(comparison, judgement)
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
