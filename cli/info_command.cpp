// skybake info: what a baked file or folder says of itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "bakers/io/exr.h"
#include "bakers/io/manifest.h"
#include "bakers/io/spelling.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// --- One image ----------------------------------------------------------------------------------

// Of the finite values of a channel.
struct ValueRange {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();
    long not_finite = 0;
};

ValueRange range_of(const Image2<float>& pixels, std::size_t channel) {
    ValueRange range;
    const auto step = static_cast<std::size_t>(pixels.channels);
    for (std::size_t i = channel; i < pixels.texels.size(); i += step) {
        const double value = pixels.texels[i];
        if (!std::isfinite(value)) {
            ++range.not_finite;
            continue;
        }
        range.smallest = std::min(range.smallest, value);
        range.largest = std::max(range.largest, value);
    }
    return range;
}

std::string image_json(const ExrImage& image) {
    Json ranges = Json::object();
    for (std::size_t i = 0; i < image.channel_names.size(); ++i) {
        const ValueRange range = range_of(image.pixels, i);
        ranges[image.channel_names[i]] = {
            {"min", range.smallest}, {"max", range.largest}, {"not_finite", range.not_finite}};
    }
    Json attributes = Json::object();
    for (const auto& [name, text] : image.attributes) attributes[name] = text;
    const Json json = {{"size", {image.pixels.width, image.pixels.height}},
                       {"channels", image.channel_names},
                       {"pixel_type", spell(image.pixel_type)},
                       {"compression", spell(image.compression)},
                       {"values", std::move(ranges)},
                       {"attributes", std::move(attributes)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Texts of several lines stand below their name, the others beside it.
std::string attribute_text(const Attributes& attributes) {
    TextTable short_ones;
    std::string long_ones;
    for (const auto& [name, text] : attributes) {
        if (text.find('\n') == std::string::npos) {
            short_ones.add_row({name, text});
            continue;
        }
        long_ones += fmt::format("  {}\n    ", name);
        for (std::size_t i = 0; i < text.size(); ++i) {
            long_ones += text[i];
            if (text[i] == '\n' && i + 1 < text.size()) long_ones += "    ";
        }
        if (text.back() != '\n') long_ones += '\n';
    }
    return short_ones.text() + long_ones;
}

std::string image_text(const std::string& name, const ExrImage& image) {
    TextTable facts;
    facts.add_row({"size", fmt::format("{} x {}", image.pixels.width, image.pixels.height)});
    facts.add_row({"channels", fmt::format("{}, {}", fmt::join(image.channel_names, " "),
                                           spell(image.pixel_type))});
    facts.add_row({"compression", std::string(spell(image.compression))});
    for (std::size_t i = 0; i < image.channel_names.size(); ++i) {
        const ValueRange range = range_of(image.pixels, i);
        std::string text = fmt::format("{:.6g} to {:.6g}", range.smallest, range.largest);
        if (range.not_finite > 0) text += fmt::format(", {} not finite", range.not_finite);
        facts.add_row({fmt::format("values {}", image.channel_names[i]), std::move(text)});
    }
    return fmt::format("{}\n", name) + facts.text() + attribute_text(image.attributes);
}

ExitCode show_image(const fs::path& path, bool json, Console& console) {
    const auto image = read_exr(path);
    const ExitCode code = console.report(image.diagnostics);
    if (!image.value) return code;
    console.result(json ? image_json(*image.value) : image_text(path.string(), *image.value));
    return ExitCode::done;
}

// --- One folder ---------------------------------------------------------------------------------

std::string error_text(const std::optional<Certificate>& error) {
    if (!error) return "not measured";
    return fmt::format("{:.1e} / {:.1e}", error->lookup.max, error->lookup.rms);
}

std::string manifest_text(const Manifest& manifest) {
    TextTable table({Align::left, Align::left, Align::right, Align::left, Align::left, Align::left,
                     Align::left, Align::right});
    table.add_row(
        {"asset", "kind", "size", "", "mapping", "file", "", "bytes", "lookup error max / rms"});
    for (const ManifestAsset& asset : manifest.assets) {
        for (const ManifestFile& file : asset.files) {
            table.add_row({asset.name, asset.kind,
                           fmt::format("{}x{}", asset.size[0], asset.size[1]),
                           fmt::format("{}", fmt::join(asset.channels, "")), asset.mapping,
                           file.path, std::string(spell(file.pixel_type)),
                           fmt::format("{}", file.bytes), error_text(asset.error)});
        }
    }
    return fmt::format("{} {}, wavelengths {} nm\n", manifest.tool_name, manifest.tool_version,
                       fmt::join(manifest.wavelengths_nm, ", ")) +
           table.text();
}

ExitCode show_manifest(const config::Outcome<Manifest>& manifest, bool json, Console& console) {
    const ExitCode code = console.report(manifest.diagnostics);
    if (!manifest.value) return code;
    console.result(json ? manifest_json(*manifest.value) : manifest_text(*manifest.value));
    return ExitCode::done;
}

ExitCode run(const Invocation& invocation, Console& console) {
    const fs::path path = invocation.arguments()[0];
    const bool json = invocation.has("json");
    std::error_code error;
    if (fs::is_directory(path, error)) return show_manifest(read_manifest(path), json, console);
    if (path.filename() == manifest_name) {
        const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
        return show_manifest(read_manifest(folder), json, console);
    }
    return show_image(path, json, console);
}

}  // namespace

Command info_command() {
    return {.name = "info",
            .summary = "look into a baked file or folder",
            .arguments = {{.name = "path",
                           .help = "an EXR file, a folder of a bake, or its manifest.json"}},
            .options = {{.name = "json", .help = "the same as JSON"}},
            .examples = {{"skybake info out", "the assets of a bake and their errors"},
                         {"skybake info out/transmittance.exr",
                          "mapping, units, parameters of a file"}},
            .exit_codes = {ExitCode::io},
            .run = run};
}

}  // namespace skybake::cli
