#include "bakers/incremental/folder_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/io/file_input.h"
#include "bakers/io/file_names.h"
#include "bakers/registry.h"
#include "config/volume_files.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using config::Bake;
using config::Diagnostic;
using config::Outcome;

std::vector<std::string> output_files(const FolderBake& bake) {
    std::vector<std::string> names;
    for (const Bake& section : bake.bakes) {
        for (std::string& name : file_names(section)) names.push_back(std::move(name));
    }
    names.emplace_back(manifest_name);
    return names;
}

// Why the files of an entry are not those that it describes.
std::vector<std::string> file_faults(const fs::path& folder, const ManifestAsset& entry,
                                     const Bake& bake) {
    std::vector<std::string> faults;
    std::vector<std::string> listed;
    for (const ManifestFile& file : entry.files) {
        listed.push_back(file.path);
        const auto print = fingerprint(folder / file.path);
        if (!print.value) {
            faults.push_back(fmt::format("{} cannot be read", file.path));
        } else if (print.value->xxh3 != file.xxh3) {
            faults.push_back(fmt::format("{} has other bytes than manifest.json says", file.path));
        }
    }
    if (listed != file_names(bake)) faults.emplace_back("manifest.json lists other files");
    return faults;
}

void compare_with_folder(const OutputFolder& folder, PlannedAsset& planned) {
    const ManifestAsset* entry = nullptr;
    if (folder.previous) {
        for (const ManifestAsset& asset : folder.previous->assets) {
            if (asset.name == planned.bake->name) entry = &asset;
        }
    }
    if (!entry) {
        planned.reasons = {folder.reason.empty() ? "not baked yet" : folder.reason};
        return;
    }
    planned.reasons = differences(planned.identity, *entry);
    if (!planned.reasons.empty()) return;
    planned.reasons = file_faults(folder.path, *entry, *planned.bake);
    if (planned.reasons.empty()) planned.up_to_date = *entry;
}

// Of what is to be made.
const PlannedAsset* largest_asset(const FolderPlan& plan) {
    const PlannedAsset* largest = nullptr;
    for (const PlannedAsset& asset : plan.assets) {
        if (!asset.stale()) continue;
        if (!largest || asset.estimate.memory_mib > largest->estimate.memory_mib) largest = &asset;
    }
    return largest;
}

std::vector<Diagnostic> memory_excess(const FolderPlan& plan, std::optional<double> limit_mib) {
    if (!limit_mib || plan.memory_mib() <= *limit_mib) return {};
    Diagnostic diagnostic;
    diagnostic.code = "E0002";
    diagnostic.message = fmt::format(
        "baking may take {:.0f} MiB of memory, most of it for `bake.{}`, and {:.4g} MiB are "
        "allowed",
        std::ceil(plan.memory_mib()), largest_asset(plan)->bake->name, *limit_mib);
    diagnostic.label = "--max-memory allows more, --only bakes fewer assets at once";
    return {std::move(diagnostic)};
}

}  // namespace

std::size_t FolderPlan::stale_count() const {
    return static_cast<std::size_t>(std::count_if(
        assets.begin(), assets.end(), [](const PlannedAsset& asset) { return asset.stale(); }));
}

// Assets are made one after the other; tables are held until all files are written, volumes are
// made anew while they are.
double FolderPlan::memory_mib() const {
    const PlannedAsset* largest = largest_asset(*this);
    if (!largest) return 0;
    double held = 0;
    for (const PlannedAsset& asset : assets) {
        if (asset.stale() && &asset != largest && !config::volume_files(*asset.bake)) {
            held += asset.estimate.disk_mib;
        }
    }
    return largest->estimate.memory_mib + held;
}

Outcome<FolderPlan> plan_folder(const FolderBake& bake) {
    auto folder = inspect_output_folder(bake.folder, output_files(bake), bake.force, false);
    if (!folder.value) return {{}, std::move(folder.diagnostics)};
    FolderPlan plan;
    plan.folder = std::move(*folder.value);
    for (const Bake& section : bake.bakes) {
        PlannedAsset planned;
        planned.bake = &section;
        auto identity = asset_identity(*bake.recipe, section, bake.certification);
        if (!identity.value) return {{}, std::move(identity.diagnostics)};
        planned.identity = std::move(*identity.value);
        planned.estimate = baker_of(section).estimate(bake.recipe->parameters, section);
        compare_with_folder(plan.folder, planned);
        plan.assets.push_back(std::move(planned));
    }
    if (plan.stale_count() > 0) {
        auto writable = inspect_output_folder(bake.folder, {}, true);
        if (!writable.value) return {{}, std::move(writable.diagnostics)};
    }
    auto excess = memory_excess(plan, bake.memory_limit_mib);
    if (!excess.empty()) return {{}, std::move(excess)};
    return {std::move(plan), {}};
}

}  // namespace skybake
