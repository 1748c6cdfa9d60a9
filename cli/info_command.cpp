// skybake info: shows what a baked file or folder says of itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/metadata.h"
#include "cli/bake_output.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/info_foreign.h"
#include "cli/info_lookup.h"
#include "cli/table_printer.h"
#include "config/sections/file_formats.h"

namespace skybake::cli {

namespace options {
inline const Option<bool> lookup{"lookup"};

std::vector<Choice<ShadingLanguage>> language_choices() {
    std::vector<Choice<ShadingLanguage>> choices;
    for (const ShadingLanguageName& one : shading_languages)
        choices.push_back({one.word, one.language});
    return choices;
}
inline const Option<ShadingLanguage> language{"language", 0, "LANGUAGE", language_choices()};
}  // namespace options

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// --- One image ----------------------------------------------------------------------------------

// This is the range of the finite values of a channel.
struct ValueRange {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();
    long not_finite = 0;
};

// Returns one range per channel. It reads the file row by row.
Outcome<std::vector<ValueRange>> value_ranges(ExrRows& image) {
    const std::size_t channels = image.facts().channel_names.size();
    std::vector<ValueRange> ranges(channels);
    std::vector<float> texels;
    int step = image.rows_per_piece();
    for (int y = 0; y < image.facts().height; y += step) {
        step = std::min(step, image.facts().height - y);
        texels.resize(static_cast<std::size_t>(step) *
                      static_cast<std::size_t>(image.facts().width) * channels);
        if (auto problem = image.read(y, step, texels.data())) return *problem;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            ValueRange& range = ranges[i % channels];
            const double value = texels[i];
            if (!std::isfinite(value)) {
                ++range.not_finite;
                continue;
            }
            range.smallest = std::min(range.smallest, value);
            range.largest = std::max(range.largest, value);
        }
    }
    return {std::move(ranges), {}};
}

std::string image_json(const std::string& path, const ExrPartHead& head, const ExrRows& image,
                       const std::vector<ValueRange>& ranges) {
    Json values = Json::object();
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        values[image.facts().channel_names[i]] = {{"min", ranges[i].smallest},
                                                  {"max", ranges[i].largest},
                                                  {"not_finite", ranges[i].not_finite}};
    }
    return event_line({{"event", "image"},
                       {"path", path},
                       {"part", head.name},
                       {"data_window", head.data_window},
                       {"display_window", head.display_window},
                       {"size", {image.facts().width, image.facts().height}},
                       {"channels", image.facts().channel_names},
                       {"pixel_type", to_string(image.facts().pixel_type)},
                       {"compression", image.facts().codec},
                       {"values", std::move(values)},
                       {"attributes", attributes_json(image.facts().attributes)}});
}

std::string image_text(const std::string& name, const ExrRows& image,
                       const std::vector<ValueRange>& ranges) {
    TextTable facts;
    facts.add_row({"size", fmt::format("{} x {}", image.facts().width, image.facts().height)});
    facts.add_row({"channels", fmt::format("{}, {}", fmt::join(image.facts().channel_names, " "),
                                           to_string(image.facts().pixel_type))});
    facts.add_row({"compression", image.facts().codec});
    if (!image.facts().window.empty()) facts.add_row({"data window", image.facts().window});
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        std::string text = fmt::format("{:.6g} to {:.6g}", ranges[i].smallest, ranges[i].largest);
        if (ranges[i].not_finite > 0) text += fmt::format(", {} not finite", ranges[i].not_finite);
        facts.add_row({fmt::format("values {}", image.facts().channel_names[i]), std::move(text)});
    }
    return fmt::format("{}\n", name) + facts.text() + attribute_text(image.facts().attributes);
}

ExitCode show_image(const fs::path& path, Console& console) {
    const auto heads = read_exr_heads(path);
    if (!heads.value) return console.report(heads.diagnostics);
    std::string text;
    for (const ExrPartHead& head : *heads.value) {
        const auto part = static_cast<int>(&head - heads.value->data());
        auto image = ExrRows::open(path, part);
        if (!image.value) return show_exr_heads(path, image.diagnostics.at(0), console);
        const auto ranges = value_ranges(*image.value);
        if (!ranges.value) return console.report(ranges.diagnostics);
        const std::string title = path.string() + (head.name.empty() ? "" : ", part " + head.name);
        text += console.json() ? image_json(path.string(), head, *image.value, *ranges.value)
                               : image_text(title, *image.value, *ranges.value);
    }
    console.result(text);
    return ExitCode::done;
}

// --- One file of another format ------------------------------------------------------------------

void show_entry(const fs::path& path, const ManifestAsset& asset, const ManifestFile& file,
                Console& console) {
    console.result(console.json()
                       ? event_line({{"event", "file"},
                                     {"path", path.string()},
                                     {"asset", Json::parse(file_entry_json(asset, file))}})
                       : fmt::format("{}\n", path.string()) + lines_text(entry_lines(asset, file)));
}

ExitCode show_file(const fs::path& path, Console& console) {
    const auto entry = entry_of_file(path);
    if (!entry.value && path.extension() == ".nvdb") return show_grids(path, console);
    if (!entry.value) return console.report(entry.diagnostics);
    show_entry(path, *entry.value, entry.value->files[0], console);
    return ExitCode::done;
}

// Shows what the manifest says of a file that says nothing of itself.
ExitCode show_plain_file(const fs::path& path, const Format& format, Console& console) {
    if (const auto found = described_by_manifest(path)) {
        show_entry(path, found->asset, found->file, console);
        return ExitCode::done;
    }
    const char* content = format.read != nullptr ? "texels alone" : "references alone";
    Diagnostic diagnostic = file_error(
        "E0304", path.string(),
        fmt::format("`{}` holds {} and does not describe itself", path.string(), content));
    diagnostic.label = "no manifest.json beside it describes it";
    return console.report({&diagnostic, 1});
}

// --- One folder ---------------------------------------------------------------------------------

std::string error_text(const std::optional<Certificate>& error) {
    if (!error) return "not measured";
    return fmt::format("{:.1e} / {:.1e}", error->lookup.max, error->lookup.rms);
}

// Returns the wavelengths of the first asset that has them, such as "680, 550, 440 nm", or nothing
// if the recipe only has noises. All assets of a recipe have the same wavelengths.
std::string wavelengths_text(const Manifest& manifest) {
    for (const ManifestAsset& asset : manifest.assets) {
        const std::vector<double>& wavelengths = asset.conventions.wavelengths_nm;
        if (wavelengths.empty()) continue;
        return fmt::format(", wavelengths {} nm", fmt::join(wavelengths, ", "));
    }
    return "";
}

// Returns the size of a file, or "missing" if the manifest lists a file that does not exist.
std::string bytes_text(const fs::path& file, std::uint64_t bytes) {
    std::error_code error;
    return fs::exists(file, error) ? fmt::format("{}", bytes) : "missing";
}

std::string manifest_text(const fs::path& folder, const Manifest& manifest) {
    TextTable table({Align::left, Align::left, Align::right, Align::left, Align::left, Align::left,
                     Align::left, Align::right, Align::left, Align::left, Align::left});
    table.add_row({"asset", "kind", "size", "", "mapping", "file", "", "bytes",
                   "sky error median / max", "colour error median / max",
                   "lookup error max / rms"});
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) {
            table.add_row({asset.name, asset.kind, extent_text(size_of(asset, file)),
                           channels_text(asset), asset.mapping, file.path,
                           find_format(file.format) ? std::string(to_string(file.pixel_type)) : "",
                           bytes_text(folder / file.path, file.bytes), sky_error_text(asset.error),
                           color_error_text(asset.error), error_text(asset.error)});
        }
    }
    constexpr std::size_t kSkyError = 8;
    constexpr std::size_t kColorError = 9;
    table.drop_if_empty(kColorError);
    table.drop_if_empty(kSkyError);
    return fmt::format("{} {}{}\n", manifest.tool_name, manifest.tool_version,
                       wavelengths_text(manifest)) +
           table.text();
}

std::vector<std::string> missing_files(const fs::path& folder, const Manifest& manifest) {
    std::vector<std::string> missing;
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) {
            std::error_code error;
            if (!fs::exists(folder / file.path, error)) missing.push_back(file.path);
        }
    }
    return missing;
}

std::string folder_json(const fs::path& folder, const Manifest& manifest) {
    return event_line({{"event", "folder"},
                       {"path", folder.string()},
                       {"missing", missing_files(folder, manifest)},
                       {"manifest", Json::parse(manifest_json(manifest))}});
}

ExitCode show_manifest(const fs::path& folder, Console& console) {
    const auto manifest = read_manifest(folder);
    const ExitCode code = console.report(manifest.diagnostics);
    if (!manifest.value) return code;
    console.result(console.json() ? folder_json(folder, *manifest.value)
                                  : manifest_text(folder, *manifest.value));
    return ExitCode::done;
}

ExitCode run_info(const Invocation& invocation, Console& console) {
    const fs::path path = invocation.arguments()[0];
    if (invocation[options::lookup]) {
        return show_lookup(path, invocation[options::language], console);
    }
    if (invocation.has(options::language)) {
        return console.report(
            std::array{usage_error("--language needs --lookup", "a lookup is written in it")});
    }
    std::error_code error;
    if (fs::is_directory(path, error)) return show_manifest(path, console);
    if (path.filename() == manifest_name) {
        const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
        return show_manifest(folder, console);
    }
    if (path.extension() == ".toml") {
        return console.report(std::array{usage_error(
            fmt::format("`{}` is a recipe, and info describes baked files", path.string()),
            "`skybake show` shows its values")});
    }
    if (path.extension() == ".vdb") return show_grids(path, console);
    const Format* format = find_format(path.extension().string().substr(path.has_extension()));
    if (format && !format->has_metadata && fs::is_regular_file(path, error)) {
        return show_plain_file(path, *format, console);
    }
    const bool is_other = format && format->format != config::FileFormat::exr;
    if (is_other && format->has_metadata) return show_file(path, console);
    return show_image(path, console);
}

}  // namespace

Command info_command() {
    return {
        .name = "info",
        .brief = "describe baked files",
        .summary = "describe a baked file or the folder of a bake",
        .arguments = {{.name = "path",
                       .help = "a baked file, the folder of a bake, or its manifest.json"}},
        .options = {options::lookup("print a shader's functions for this file, or this folder"),
                    options::language("write them in this language", "glsl")},
        .examples = {{"skybake info out", "lists the assets of a bake and their errors"},
                     {"skybake info out/transmittance.exr",
                      "shows the mapping, units and parameters of a file"},
                     {"skybake info --lookup out/transmittance.exr",
                      "prints the file's lookup with its own radii and sizes"},
                     {"skybake info --lookup --language hlsl out/transmittance.exr",
                      "prints it for Direct3D"},
                     {"skybake info --lookup out", "prints one library for all assets of a bake"}},
        .exit_codes = {ExitCode::io},
        .run = run_info};
}

}  // namespace skybake::cli
