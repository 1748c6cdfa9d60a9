#include "cli/bake_summary.h"

#include <fmt/format.h>

#include <cstdint>

#include "bakers/io/manifest.h"
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
    return fmt::format("{:.1f} MiB", bytes / (1024 * 1024));
}

std::string channels_text(const ManifestAsset& asset) {
    std::string text;
    for (const std::string& channel : asset.channels) text += channel;
    return text;
}

}  // namespace

std::string plan_text(std::span<const config::Bake> bakes) {
    TextTable table({Align::left, Align::right, Align::left, Align::right, Align::right});
    table.add_row({"asset", "size", "file", "about", "disk"});
    for (const config::Bake& bake : bakes) {
        const Estimate estimate = baker_of(bake).estimate(bake);
        const bool chosen = estimate.size[0] == 0;
        table.add_row(
            {bake.name,
             chosen ? "by max_error" : fmt::format("{}x{}", estimate.size[0], estimate.size[1]),
             table_file_name(bake.name), time_text(estimate.seconds),
             chosen ? "" : size_text(estimate.disk_mib * 1024 * 1024)});
    }
    return table.text();
}

std::string summary_text(const std::vector<EncodedTable>& tables, double seconds) {
    TextTable table({Align::left, Align::right, Align::left, Align::left, Align::left, Align::right,
                     Align::right, Align::left});
    table.add_row({"asset", "size", "", "file", "", "bake", "write", "lookup error max / rms"});
    std::uint64_t bytes = 0;
    std::string advice;
    for (const EncodedTable& encoded : tables) {
        const ManifestAsset& asset = encoded.asset;
        const ManifestFile& file = asset.files.front();
        bytes += file.bytes;
        table.add_row(
            {asset.name, fmt::format("{}x{}", asset.size[0], asset.size[1]), channels_text(asset),
             file.path, file.pixel_type == config::PixelType::half ? "half" : "float",
             time_text(asset.timing.bake_s), time_text(asset.timing.write_s),
             asset.error
                 ? fmt::format("{:.2g} / {:.2g}", asset.error->lookup.max, asset.error->lookup.rms)
                 : "not measured"});
        if (asset.error && !asset.error->advice.empty()) {
            advice += fmt::format("  {}: worst at {}; {}\n", asset.name, asset.error->worst,
                                  asset.error->advice);
        }
    }
    return table.text() + advice +
           fmt::format("{} asset{}, {}, {}, {}\n", tables.size(), tables.size() == 1 ? "" : "s",
                       time_text(seconds), size_text(static_cast<double>(bytes)), manifest_name);
}

}  // namespace skybake::cli
