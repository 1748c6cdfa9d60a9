#include "cli/bake_events.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/event_line.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string_view state_name(AssetState state) {
    switch (state) {
        case AssetState::up_to_date:
            return "up_to_date";
        case AssetState::copied:
            return "copied";
        case AssetState::baked:
            break;
    }
    return "baked";
}

Json file_event(const FinishedAsset& asset, std::size_t i, const std::filesystem::path& folder) {
    const ManifestAsset& entry = asset.entry;
    const ManifestFile& file = entry.files[i];
    Json event = {{"event", "asset"},
                  {"name", entry.name},
                  {"kind", entry.kind},
                  {"path", (folder / file.path).string()},
                  {"state", state_name(asset.state)},
                  {"changed", asset.files[i] == WriteResult::written},
                  {"size", size_of(entry, file)},
                  {"format", file.format},
                  {"level", file.level},
                  {"bake_s", entry.timing.bake_s},
                  {"certify_s", asset.certify_s},
                  {"write_s", entry.timing.write_s}};
    if (entry.error) {
        event["lookup_error"] = {{"max", entry.error->lookup.max},
                                 {"rms", entry.error->lookup.rms}};
        event["texel_error"] = {{"max", entry.error->texel.max}, {"rms", entry.error->texel.rms}};
    }
    return event;
}

// Relative to the folder, as the manifest has them.
Json paths_of(const std::vector<RetiredFile>& files) {
    Json paths = Json::array();
    for (const RetiredFile& file : files) paths.push_back(file.path);
    return paths;
}

}  // namespace

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
    return event_line({{"event", "plan"},
                       {"stale", plan.stale_count()},
                       {"assets", std::move(assets)},
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

}  // namespace skybake::cli
