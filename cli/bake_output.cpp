#include "cli/bake_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/field/finish_volume.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/math/facts.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/progress.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

// In the order of AssetState.
constexpr std::array<std::string_view, 3> state_names = {"up_to_date", "copied", "baked"};

Json file_event(const FinishedAsset& asset, std::size_t i, const std::filesystem::path& folder) {
    const ManifestAsset& entry = asset.entry;
    const ManifestFile& file = entry.files[i];
    Json event = {{"event", "asset"},
                  {"name", entry.name},
                  {"kind", entry.kind},
                  {"path", (folder / file.path).string()},
                  {"state", state_names[static_cast<std::size_t>(asset.state)]},
                  {"changed", asset.files[i] == WriteResult::written},
                  {"size", size_of(entry, file)},
                  {"format", file.format},
                  {"level", file.level},
                  {"light_s", entry.timing.bake.light},
                  {"colors_s", entry.timing.bake.colors},
                  {"texels_s", entry.timing.bake.texels},
                  {"certificate_s", entry.timing.bake.certificate},
                  {"write_s", entry.timing.write_s}};
    if (entry.error) {
        event["lookup_error"] = {{"max", entry.error->lookup.max},
                                 {"rms", entry.error->lookup.rms}};
        event["texel_error"] = {{"max", entry.error->texel.max}, {"rms", entry.error->texel.rms}};
    }
    for (const Diagnostic& warning : entry.warnings) {
        event["warnings"].push_back(warning_json(warning));
    }
    return event;
}

// Returns the paths relative to the folder, as the manifest spells them.
Json paths_of(const std::vector<RetiredFile>& files) {
    Json paths = Json::array();
    for (const RetiredFile& file : files) paths.push_back(file.path);
    return paths;
}

// Returns the share of a cloud volume's columns that hold cloud: "29.3 %".
std::string cover_text(const ManifestAsset& asset) {
    const auto share = number_named(asset.details, covered_columns);
    return share ? fmt::format("{:.3g} %", 100 * *share) : "";
}

// Returns the cells of the first row of an asset. An asset that was copied has no times.
std::vector<std::string> first_row(const FinishedAsset& finished) {
    const ManifestAsset& asset = finished.entry;
    const ManifestFile& file = asset.files.front();
    const auto spent = [&finished](double seconds) {
        return finished.state == AssetState::baked && seconds > 0 ? time_text(seconds) : "";
    };
    return {asset.name,
            extent_text(asset.size),
            channels_text(asset),
            file.path,
            std::string(to_string(file.pixel_type)),
            spent(asset.timing.bake.light),
            spent(asset.timing.bake.colors),
            spent(asset.timing.bake.texels),
            spent(asset.timing.bake.certificate),
            spent(asset.timing.write_s),
            sky_error_text(asset.error),
            color_error_text(asset.error),
            cover_text(asset),
            asset.error ? fmt::format("{} / {}", to_digits(asset.error->lookup.max, 2),
                                      to_digits(asset.error->lookup.rms, 2))
                        : "not measured"};
}

// Returns the cells of a further file of a volume, which has another format or level of detail.
std::vector<std::string> further_row(const ManifestAsset& asset, const ManifestFile& file) {
    // Texts beside the texels have no type.
    return {"", file.level == 0 ? "" : extent_text(size_of(asset, file)), "", file.path,
            find_format(file.format) ? std::string(to_string(file.pixel_type)) : ""};
}

// Returns the table of what was made. It is empty if all was up to date.
std::string assets_text(const BakedFolder& baked, int columns) {
    TextTable table({Align::left, Align::right, Align::left, Align::left, Align::left, Align::right,
                     Align::right, Align::right, Align::right, Align::right, Align::left,
                     Align::left, Align::right, Align::left});
    // A narrow terminal does not show these columns: write, certificate, colours, light, pixel type,
    // channels.
    constexpr std::array<std::size_t, 6> expendable = {9, 8, 6, 5, 4, 2};
    constexpr std::array<std::size_t, 2> names = {0, 3};
    table.add_row({"asset", "size", "", "file", "", "light", "colours", "texels", "certificate",
                   "write", "sky error median / max", "colour error median / max", "cover",
                   "lookup error max / rms"});
    bool made = false;
    for (const FinishedAsset& finished : baked.assets) {
        if (finished.state == AssetState::up_to_date) continue;
        made = true;
        table.add_row(first_row(finished));
        for (const ManifestFile& file : finished.entry.files) {
            const bool first = &file == &finished.entry.files.front();
            if (!first) table.add_row(further_row(finished.entry, file));
        }
    }
    // Cover, errors of colours and of the sky, and the time of a certificate, of colours and of light.
    for (const std::size_t column : {12U, 11U, 10U, 8U, 6U, 5U}) table.drop_if_empty(column);
    return made ? table.text_within(columns, expendable, names) : "";
}

// Returns what leaps or distances save; nothing where a warning says that they do not.
std::string skipping_text(const ManifestAsset& asset) {
    const double without = number_named(asset.details, fetches_without).value_or(0);
    const double with = number_named(asset.details, fetches_with).value_or(0);
    if (with >= most_fetches * without) return "";
    return fmt::format("  {}: {:.2f} x fewer fetches from below, in steps of a voxel\n", asset.name,
                       without / with);
}

std::string advice_text(const ManifestAsset& asset) {
    std::string text = skipping_text(asset);
    if (!asset.error) return text;
    const bool is_of_sky = asset.error->sky && asset.error->sky->better == asset.error->advice;
    // A warning may have said it already.
    if (!asset.error->advice.empty() && !is_of_sky && large_errors(*asset.error).empty()) {
        const bool is_of_place = !asset.error->sky || asset.error->sky->points > 0;
        const std::string place =
            is_of_place ? fmt::format("its error is largest at {}; ", asset.error->worst) : "";
        text += fmt::format("  {}: {}{}\n", asset.name, place, asset.error->advice);
    }
    if (asset.error->sky && !asset.error->sky->better.empty()) {
        text += fmt::format("  {}: {}\n", asset.name, asset.error->sky->better);
    }
    return text;
}

std::string retired_text(const BakedFolder& baked, bool prune) {
    std::string text;
    for (const RetiredFile& file : baked.pruned) {
        text += fmt::format("  {} is no longer in the recipe; removed\n", file.path);
    }
    for (const RetiredFile& file : baked.retired) {
        text += fmt::format(
            "  {} is no longer in the recipe{}\n", file.path,
            prune ? ", but was changed since it was baked; kept" : "; kept (--prune removes it)");
    }
    return text;
}

// Says what a bake with --prune would do with files of earlier recipes.
std::string planned_retired_text(const FolderPlan& plan) {
    std::string text;
    for (const RetiredFile& file : plan.retired) {
        const bool pruned =
            std::ranges::find(plan.pruned, file.path, &RetiredFile::path) != plan.pruned.end();
        text += fmt::format("  {} is no longer in the recipe and would be {}\n", file.path,
                            pruned ? "removed" : "kept");
    }
    return text;
}

// Returns "2 assets (1 up to date) (1 from the cache)".
std::string count_text(const BakedFolder& baked) {
    const auto count_of = [&baked](AssetState state) {
        return std::ranges::count(baked.assets, state, &FinishedAsset::state);
    };
    const auto unchanged = count_of(AssetState::up_to_date);
    const auto copied = count_of(AssetState::copied);
    std::string text = counted(baked.assets.size(), "asset");
    if (std::cmp_equal(unchanged, baked.assets.size())) return text + " up to date";
    if (unchanged > 0) text += fmt::format(" ({} up to date)", unchanged);
    if (copied > 0) text += fmt::format(" ({} from the cache)", copied);
    return text;
}

}  // namespace

std::string sky_error_text(const std::optional<Certificate>& error) {
    if (!error || !error->sky) return "";
    const SkyError& sky = *error->sky;
    if (sky.points == 0) return "too noisy to tell";
    const std::string text = fmt::format("{} / {} ± {} %", to_percent(sky.median),
                                         to_percent(sky.max), to_percent(sky.standard_error));
    if (!sky.worst_sun_deg) return text;
    return text + fmt::format(" (sun {:.3g}°)", *sky.worst_sun_deg);
}

std::string color_error_text(const std::optional<Certificate>& error) {
    if (!error || !error->color) return "";
    return fmt::format("{} / {} %", to_percent(error->color->median),
                       to_percent(error->color->max));
}

std::string plan_event(const FolderPlan& plan) {
    Json assets = Json::array();
    for (const PlannedAsset& asset : plan.assets) {
        assets.push_back({{"name", asset.bake->name},
                          {"kind", asset.identity.kind},
                          {"stale", asset.stale()},
                          {"why", asset.reasons},
                          {"size", asset.estimate.size},
                          {"seconds", asset.estimate.seconds},
                          {"memory_mib", asset.estimate.memory_mib},
                          {"disk_mib", asset.estimate.disk_mib}});
    }
    Json intermediates = Json::array();
    for (const PlannedIntermediate& one : plan.intermediates()) {
        intermediates.push_back({{"name", one.need.name},
                                 {"seconds", one.need.seconds},
                                 {"memory_mib", one.need.memory_mib},
                                 {"assets", one.users}});
    }
    return event_line({{"event", "plan"},
                       {"stale", plan.stale_count()},
                       {"assets", std::move(assets)},
                       {"intermediates", std::move(intermediates)},
                       {"retired", paths_of(plan.retired)},
                       {"pruned", paths_of(plan.pruned)}});
}

std::string finished_events(const BakedFolder& baked, const std::filesystem::path& folder,
                            double seconds) {
    std::string text;
    std::size_t stale = 0;
    for (const FinishedAsset& asset : baked.assets) {
        stale += asset.state == AssetState::up_to_date ? 0 : 1;
        for (std::size_t i = 0; i < asset.files.size(); ++i) {
            text += event_line(file_event(asset, i, folder));
        }
    }
    return text + event_line({{"event", "done"},
                              {"assets", baked.assets.size()},
                              {"made", stale},
                              {"retired", paths_of(baked.retired)},
                              {"pruned", paths_of(baked.pruned)},
                              {"seconds", seconds}});
}

std::string channels_text(const ManifestAsset& asset) {
    const bool are_letters = std::ranges::all_of(
        asset.channels, [](const std::string& channel) { return channel.size() == 1; });
    return fmt::format("{}", fmt::join(asset.channels, are_letters ? "" : " "));
}

std::string extent_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

// Says what is made once for several assets.
std::string shared_text(const FolderPlan& plan) {
    std::string text;
    for (const PlannedIntermediate& one : plan.intermediates()) {
        if (one.users.size() < 2) continue;
        text += fmt::format(
            "made once: {} ({}, {}) for {}\n", one.need.name, time_text(one.need.seconds),
            byte_size_text(one.need.memory_mib * 1024 * 1024), fmt::join(one.users, ", "));
    }
    return text;
}

std::string plan_text(const FolderPlan& plan) {
    TextTable table({Align::left, Align::right, Align::left, Align::right, Align::right,
                     Align::left, Align::left});
    table.add_row({"asset", "size", "files", "time", "disk", "why"});
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
    return table.text() + shared_text(plan) + planned_retired_text(plan);
}

std::string reasons_text(const FolderPlan& plan) {
    std::string text;
    for (const PlannedAsset& asset : plan.assets) {
        if (!asset.stale() || !plan.folder.previous) continue;
        text += fmt::format("  {}: {}\n", asset.bake->name, fmt::join(asset.reasons, "; "));
    }
    return text;
}

std::string summary_text(const BakedFolder& baked, double seconds, int columns, bool prune) {
    std::string advice;
    std::uint64_t bytes = 0;
    for (const FinishedAsset& finished : baked.assets) {
        for (const ManifestFile& file : finished.entry.files) bytes += file.bytes;
        if (finished.state != AssetState::up_to_date) advice += advice_text(finished.entry);
    }
    return assets_text(baked, columns) + advice + retired_text(baked, prune) +
           fmt::format("{}, {}, {}, {}\n", count_text(baked), time_text(seconds),
                       byte_size_text(static_cast<double>(bytes)), manifest_name);
}

bool BakeReporter::cancelled() const { return interrupted(); }

void BakeReporter::waits() {
    console_.note("waiting: another skybake is baking into this folder\n");
}

std::vector<Diagnostic> long_bake(const FolderPlan& plan) {
    constexpr double kLong = 600;  // seconds
    const double seconds = plan.seconds();
    if (!(seconds > kLong)) return {};
    const auto longest =
        std::ranges::max_element(plan.assets, [](const auto& one, const auto& other) {
            return (one.stale() ? one.estimate.seconds : 0) <
                   (other.stale() ? other.estimate.seconds : 0);
        });
    return {diagnosis(
        "W0225",
        fmt::format(
            "baking may take {:.0f} minutes of one core, `{}` {:.0f} of them besides shared light",
            seconds / 60, longest->bake->name, longest->estimate.seconds / 60),
        "an estimate from sizes and from the depth of the air; --dry-run shows its parts")};
}

void BakeReporter::planned(const FolderPlan& plan) {
    console_.report(long_bake(plan));
    if (console_.json()) console_.result(plan_event(plan));
    if (console_.display().verbose) {
        console_.detail(plan_text(plan));
    } else {
        console_.note(reasons_text(plan));
    }
    for (const PlannedAsset& asset : plan.assets) {
        if (asset.stale()) stale_.push_back(asset.bake->name);
    }
}

std::unique_ptr<Progress> BakeReporter::begin(std::string_view asset) {
    const auto at = std::ranges::find(stale_, asset);
    const bool counted = at != stale_.end();
    return std::make_unique<BakeProgress>(std::string(asset), console_,
                                          counted ? static_cast<int>(at - stale_.begin()) + 1 : 0,
                                          counted ? static_cast<int>(stale_.size()) : 0);
}

}  // namespace skybake::cli
