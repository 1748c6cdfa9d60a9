#include "cli/info_foreign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/volumes/grid_files.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/table_printer.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"

namespace skybake::cli {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string lines_text(const FactLines& lines) {
    TextTable short_ones;
    std::string long_ones;
    for (const auto& [name, text] : lines) {
        if (text.find('\n') == std::string::npos) {
            short_ones.add_row({config::printable(name), config::printable(text)});
            continue;
        }
        long_ones += fmt::format("  {}\n", config::printable(name));
        std::istringstream several(text);
        for (std::string line; std::getline(several, line);) {
            long_ones += fmt::format("    {}\n", config::printable(line));
        }
    }
    return short_ones.text() + long_ones;
}

std::string attribute_text(const Attributes& attributes) {
    FactLines lines;
    for (const auto& [name, text] : attributes) {
        const auto entry = parse_file_entry(text, "the file");
        const bool is_ours = name == metadata_name && entry.value;
        const FactLines found =
            is_ours ? entry_lines(*entry.value, entry.value->files[0]) : FactLines{{name, text}};
        lines.insert(lines.end(), found.begin(), found.end());
    }
    return lines_text(lines);
}

Json attributes_json(const Attributes& attributes) {
    Json json = Json::object();
    for (const auto& [name, text] : attributes) {
        const Json entry = name == metadata_name ? Json::parse(text, nullptr, false) : Json(text);
        json[name] = entry.is_discarded() ? Json(text) : entry;
    }
    return json;
}

namespace {

// "512 x 512 x 64", of the box of active voxels.
std::string active_extent(const VdbGrid& grid) {
    if (grid.empty) return "no active voxel";
    if (!grid.states_active) return "not stated";
    std::array<std::int64_t, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) size[i] = grid.last_active[i] - grid.first_active[i] + 1;
    return fmt::format("{}", fmt::join(size, " x "));
}

std::string grids_json(const std::string& path, const VdbFile& file) {
    Json grids = Json::array();
    for (const VdbGrid& grid : file.grids) {
        const bool has_box = grid.states_active && !grid.empty;
        grids.push_back({{"name", grid.name},
                         {"type", grid.type},
                         {"value_type", grid.value_type},
                         {"class", grid.grid_class},
                         {"compression", grid.compression},
                         {"half", grid.half},
                         {"voxel_size", grid.voxel_size},
                         {"first_centre", grid.first_centre ? Json(*grid.first_centre) : Json()},
                         {"first_active", has_box ? Json(grid.first_active) : Json()},
                         {"last_active", has_box ? Json(grid.last_active) : Json()},
                         {"active_voxels", grid.active_voxels},
                         {"metadata", attributes_json(grid.metadata)}});
    }
    return event_line({{"event", "grids"},
                       {"path", path},
                       {"uuid", file.uuid},
                       {"library", file.library},
                       {"grids", std::move(grids)},
                       {"attributes", attributes_json(file.attributes)}});
}

std::string grids_text(const std::string& name, const VdbFile& file) {
    TextTable table({Align::left, Align::right, Align::left, Align::left, Align::left});
    table.add_row({"grid", "active", "", "class", "compression", "voxel size"});
    for (const VdbGrid& grid : file.grids) {
        table.add_row({config::printable(grid.name), active_extent(grid), grid.value_type,
                       config::printable(grid.grid_class), grid.compression,
                       fmt::format("{}", fmt::join(grid.voxel_size, ", "))});
    }
    return fmt::format("{}\n", name) + table.text() + lines_text({{"library", file.library}}) +
           attribute_text(file.attributes);
}

std::string channels_text(const ExrPartHead& part) {
    std::vector<std::string> channels;
    for (const ExrChannelHead& channel : part.channels) {
        std::string text = fmt::format("{} {}", config::printable(channel.name), channel.type);
        if (channel.sampling != std::array{1, 1}) {
            text += fmt::format(" per {} x {} pixels", channel.sampling[0], channel.sampling[1]);
        }
        channels.push_back(std::move(text));
    }
    return fmt::format("{}", fmt::join(channels, ", "));
}

std::string part_text(const ExrPartHead& part) {
    const auto window = [](const std::array<int, 4>& box) {
        return fmt::format("({}, {}) to ({}, {})", box[0], box[1], box[2], box[3]);
    };
    FactLines lines = {
        {"size", fmt::format("{}", fmt::join(part.size(), " x "))},
        {"pixels", part.kind},
        {"channels", channels_text(part)},
        {"compression", part.compression},
    };
    if (!part.name.empty()) lines.insert(lines.begin(), {"part", part.name});
    if (part.data_window != part.display_window) {
        lines.emplace_back("data window", window(part.data_window));
        lines.emplace_back("display window", window(part.display_window));
    }
    return lines_text(lines) + attribute_text(part.attributes);
}

Json part_json(const ExrPartHead& part) {
    Json channels = Json::array();
    for (const ExrChannelHead& channel : part.channels) {
        channels.push_back(
            {{"name", channel.name}, {"type", channel.type}, {"sampling", channel.sampling}});
    }
    return {{"name", part.name},
            {"pixels", part.kind},
            {"compression", part.compression},
            {"size", part.size()},
            {"data_window", part.data_window},
            {"display_window", part.display_window},
            {"channels", std::move(channels)},
            {"attributes", attributes_json(part.attributes)}};
}

// "cannot read `a.exr` as an OpenEXR image: tiled images are not read": what follows the colon.
std::string reason_in(const std::string& message, const std::string& path) {
    const std::size_t file = message.find(path);
    const std::size_t colon = message.find(": ", file == message.npos ? 0 : file + path.size());
    return colon == message.npos ? message : message.substr(colon + 2);
}

}  // namespace

ExitCode show_grids(const fs::path& path, Console& console) {
    const auto file = read_grids(path);
    if (!file.value) return console.report(file.diagnostics);
    console.result(console.json() ? grids_json(path.string(), *file.value)
                                  : grids_text(path.string(), *file.value));
    return ExitCode::done;
}

ExitCode show_exr_heads(const fs::path& path, const Diagnostic& reason, Console& console) {
    const auto parts = read_exr_heads(path);
    if (!parts.value || reason.code != "E0304") return console.report({&reason, 1});
    const std::string unread = reason_in(reason.message, path.string());
    if (console.json()) {
        console.result(event_line({{"event", "parts"},
                                   {"path", path.string()},
                                   {"unread", unread},
                                   {"parts", mapped<Json>(*parts.value, part_json)}}));
        return ExitCode::done;
    }
    std::string text = fmt::format("{}\n", path.string());
    for (const ExrPartHead& part : *parts.value) text += part_text(part);
    console.result(text + lines_text({{"values", "not read: " + unread}}));
    return ExitCode::done;
}

}  // namespace skybake::cli
