#include "cli/bake_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

#include "bakers/io/file_names.h"
#include "bakers/io/manifest.h"
#include "bakers/io/spelling.h"
#include "bakers/registry.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

std::string time_text(double seconds) {
    if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
    const double ms = seconds * 1e3;
    return ms < 9.95 ? fmt::format("{:.2g} ms", ms) : fmt::format("{:.0f} ms", ms);
}

std::string size_text(double bytes) {
    if (bytes < 1024 * 1024) return fmt::format("{:.0f} KiB", bytes / 1024);
    if (bytes < 1024.0 * 1024 * 1024) return fmt::format("{:.1f} MiB", bytes / (1024 * 1024));
    return fmt::format("{:.1f} GiB", bytes / (1024.0 * 1024 * 1024));
}

std::string channels_text(const ManifestAsset& asset) {
    std::string text;
    for (const std::string& channel : asset.channels) text += channel;
    return text;
}

// What the first row of an asset says.
std::vector<std::string> first_row(const ManifestAsset& asset) {
    const ManifestFile& file = asset.files.front();
    return {asset.name,
            extent_text(asset.size),
            channels_text(asset),
            file.path,
            std::string(spell(file.pixel_type)),
            time_text(asset.timing.bake_s),
            time_text(asset.timing.write_s),
            asset.error
                ? fmt::format("{:.2g} / {:.2g}", asset.error->lookup.max, asset.error->lookup.rms)
                : "not measured"};
}

// Further files of a volume: another format or level of detail.
std::vector<std::string> further_row(const ManifestAsset& asset, const ManifestFile& file) {
    const auto& size = asset.levels[static_cast<std::size_t>(file.level)].size;
    return {"", file.level == 0 ? "" : extent_text(size), "", file.path,
            std::string(spell(file.pixel_type))};
}

}  // namespace

std::string extent_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

std::string plan_text(const config::Parameters& parameters, std::span<const config::Bake> bakes) {
    TextTable table({Align::left, Align::right, Align::left, Align::right, Align::right});
    table.add_row({"asset", "size", "files", "about", "disk"});
    for (const config::Bake& bake : bakes) {
        const Estimate estimate = baker_of(bake).estimate(parameters, bake);
        const bool chosen = estimate.size[0] == 0;
        table.add_row({bake.name, chosen ? "by max_error" : extent_text(estimate.size),
                       fmt::format("{}", fmt::join(file_names(bake), ", ")),
                       time_text(estimate.seconds),
                       chosen ? "" : size_text(estimate.disk_mib * 1024 * 1024)});
    }
    return table.text();
}

std::string summary_text(const std::vector<ManifestAsset>& assets, double seconds) {
    TextTable table({Align::left, Align::right, Align::left, Align::left, Align::left, Align::right,
                     Align::right, Align::left});
    table.add_row({"asset", "size", "", "file", "", "bake", "write", "lookup error max / rms"});
    std::uint64_t bytes = 0;
    std::string advice;
    for (const ManifestAsset& asset : assets) {
        table.add_row(first_row(asset));
        for (const ManifestFile& file : asset.files) {
            bytes += file.bytes;
            if (&file != &asset.files.front()) table.add_row(further_row(asset, file));
        }
        if (asset.error && !asset.error->advice.empty()) {
            advice += fmt::format("  {}: worst at {}; {}\n", asset.name, asset.error->worst,
                                  asset.error->advice);
        }
    }
    return table.text() + advice +
           fmt::format("{} asset{}, {}, {}, {}\n", assets.size(), assets.size() == 1 ? "" : "s",
                       time_text(seconds), size_text(static_cast<double>(bytes)), manifest_name);
}

}  // namespace skybake::cli
