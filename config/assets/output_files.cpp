#include "config/assets/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "config/assets/asset_kind.h"
#include "config/assets/bruneton.h"
#include "config/assets/environment.h"
#include "config/sections/frames.h"
#include "config/sections/targets.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

// In bytes, of Linux, macOS and Windows.
constexpr std::size_t longest_name = 255;

// Whether Windows takes a file of this name, whatever follows its first dot, for a device
// (learn.microsoft.com, "Naming Files, Paths, and Namespaces").
bool is_device_of_windows(std::string_view file) {
    const std::string name = lower_case(file.substr(0, file.find('.')));
    constexpr std::array<std::string_view, 6> devices = {"con", "prn",    "aux",
                                                         "nul", "conin$", "conout$"};
    if (std::ranges::find(devices, name) != devices.end()) return true;
    const bool is_port = name.size() == 4 && (name.starts_with("com") || name.starts_with("lpt"));
    return is_port && name[3] >= '1' && name[3] <= '9';
}

// A file, and the bake that writes it.
struct Written {
    std::string file;
    std::string bake;  // empty: every bake, as manifest.json
};

void report_same(const Written& first, const Written& second, const Place& place,
                 Decoder& decoder) {
    const std::string by = second.bake == first.bake ? "twice"
                           : first.bake.empty()
                               ? "which is the manifest of every bake"
                               : fmt::format("as [bake.{}] does `{}`", first.bake, first.file);
    const bool are_equal = first.file == second.file;
    decoder.diagnostics.error(
        "E0177", place, fmt::format("[bake.{}] would write `{}`, {}", second.bake, second.file, by),
        are_equal
            ? "choose another name"
            : "choose names that differ in more than capital letters, which macOS and Windows "
              "do not tell apart");
}

}  // namespace

std::string file_name(const std::string& name, FileFormat format, int level) {
    const std::string_view extension = facts_of(format).name;
    if (level == 0) return fmt::format("{}.{}", name, extension);
    return fmt::format("{}.mip{}.{}", name, level, extension);
}

std::string file_name(const std::string& name, const AssetFiles& files, FileFormat format,
                      int level) {
    const bool plays_all = facts_of(format).only_refers && files.frames > 0;
    return file_name(plays_all ? sequence_name(name) : name, format, level);
}

std::string companion_file_name(const std::string& name, const std::string& format) {
    return fmt::format("{}.{}", name, format);
}

std::vector<std::string> file_names(const Bake& bake) {
    const AssetFiles& files = files_of(bake);
    std::vector<std::string> names;
    for (const FileFormat format : files.formats) {
        const int count = files_of_levels(format, files.mips);
        for (int level = 0; level < count; ++level) {
            names.push_back(file_name(bake.name, files, format, level));
        }
    }
    const auto* bruneton = bake.find<BrunetonBake>();
    const auto* environment = bake.find<EnvironmentBake>();
    if ((bruneton && has_companion(*bruneton)) || (environment && environment->lights)) {
        names.push_back(companion_file_name(bake.name, "json"));
    }
    for (std::string& name : sidecar_names(files, kind_of(bake).facts.name, bake.name)) {
        names.push_back(std::move(name));
    }
    return names;
}

void check_output_files(std::span<const Bake> bakes, std::span<const Place> places,
                        Decoder& decoder) {
    const std::string manifest(manifest_file);
    std::map<std::string, Written> all = {{manifest, {manifest, ""}}};
    for (std::size_t i = 0; i < bakes.size(); ++i) {
        bool is_told = false;  // one report for each bake
        const std::vector<std::string> files = file_names(bakes[i]);
        for (const std::string& file : files) {
            const Written written{file, bakes[i].name};
            const auto [first, is_new] = all.try_emplace(lower_case(file), written);
            if (!is_new && !is_told) report_same(first->second, written, places[i], decoder);
            is_told = is_told || !is_new;
        }
        if (!files.empty() && is_device_of_windows(files.front())) {
            decoder.diagnostics.warning(
                "W0223", places[i], fmt::format("Windows takes `{}` for a device", files.front()),
                "choose another name, with which Windows can have this file");
        }
        const auto longest = std::ranges::max_element(
            files, [](const auto& a, const auto& b) { return a.size() < b.size(); });
        if (longest == files.end() || longest->size() <= longest_name) continue;
        decoder.diagnostics.error(
            "E0178", places[i],
            fmt::format("a file of this name would have {} bytes, of which `{}` are the last",
                        longest->size(), longest->substr(bakes[i].name.size())),
            fmt::format("names of files may have {} bytes: shorten this by {}", longest_name,
                        longest->size() - longest_name));
    }
}

}  // namespace skybake::config
