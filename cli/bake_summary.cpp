#include "cli/bake_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

#include "bakers/io/file_names.h"
#include "bakers/io/spelling.h"
#include "cli/byte_size.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

std::string time_text(double seconds) {
    if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
    const double ms = seconds * 1e3;
    return ms < 9.95 ? fmt::format("{:.2g} ms", ms) : fmt::format("{:.0f} ms", ms);
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

std::string plan_text(const FolderPlan& plan) {
    TextTable table(
        {Align::left, Align::right, Align::left, Align::right, Align::right, Align::left});
    table.add_row({"asset", "size", "files", "about", "disk", "why"});
    for (const PlannedAsset& asset : plan.assets) {
        const Estimate& estimate = asset.estimate;
        const bool chosen = estimate.size[0] == 0;
        table.add_row(
            {asset.bake->name, chosen ? "by max_error" : extent_text(estimate.size),
             fmt::format("{}", fmt::join(file_names(*asset.bake), ", ")),
             asset.stale() ? time_text(estimate.seconds) : "",
             asset.stale() && !chosen ? byte_size_text(estimate.disk_mib * 1024 * 1024) : "",
             asset.stale() ? fmt::format("{}", fmt::join(asset.reasons, "; ")) : "up to date"});
    }
    return table.text();
}

std::string reasons_text(const FolderPlan& plan) {
    std::string text;
    for (const PlannedAsset& asset : plan.assets) {
        if (!asset.stale() || !plan.folder.previous) continue;
        text += fmt::format("  {}: {}\n", asset.bake->name, fmt::join(asset.reasons, "; "));
    }
    return text;
}

std::string summary_text(const BakedFolder& baked, double seconds) {
    TextTable table({Align::left, Align::right, Align::left, Align::left, Align::left, Align::right,
                     Align::right, Align::left});
    table.add_row({"asset", "size", "", "file", "", "bake", "write", "lookup error max / rms"});
    std::uint64_t bytes = 0;
    std::size_t made = 0;
    std::size_t copied = 0;
    std::string advice;
    for (const FinishedAsset& finished : baked.assets) {
        const ManifestAsset& asset = finished.entry;
        for (const ManifestFile& file : asset.files) bytes += file.bytes;
        if (finished.state == AssetState::up_to_date) continue;
        ++made;
        if (finished.state == AssetState::copied) ++copied;
        table.add_row(first_row(asset));
        for (const ManifestFile& file : asset.files) {
            if (&file != &asset.files.front()) table.add_row(further_row(asset, file));
        }
        if (asset.error && asset.error->sky) {
            const SkyError& sky = *asset.error->sky;
            advice += fmt::format(
                "  {}: sky made with it is off by {:.2g} % (median), {:.2g} % (nine in ten below), "
                "against {}\n",
                asset.name, 100 * sky.median, 100 * sky.ninth_decile, sky.reference);
        }
        if (asset.error && !asset.error->advice.empty()) {
            advice += fmt::format("  {}: worst at {}; {}\n", asset.name, asset.error->worst,
                                  asset.error->advice);
        }
    }
    for (const RetiredFile& file : baked.retired) {
        advice += fmt::format("  {}: of an earlier recipe, left as it is\n", file.path);
    }
    const std::size_t count = baked.assets.size();
    std::string state;
    if (made == 0) state = " up to date";
    if (made > 0 && made < count) state = fmt::format(" ({} up to date)", count - made);
    if (copied > 0) state += fmt::format(" ({} ready-made)", copied);
    return (made > 0 ? table.text() : "") + advice +
           fmt::format("{} asset{}{}, {}, {}, {}\n", count, count == 1 ? "" : "s", state,
                       time_text(seconds), byte_size_text(static_cast<double>(bytes)),
                       manifest_name);
}

}  // namespace skybake::cli
