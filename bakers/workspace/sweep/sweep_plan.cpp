#include "bakers/workspace/sweep/sweep_plan.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "bakers/math/parallel.h"
#include "bakers/workspace/bake_folder.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

// Whether the folder's manifest says what it would say if it were written now. It also contains the
// recipe's parameters that no asset depends on.
bool is_settled(const FolderPlan& plan, const Recipe& recipe) {
    if (plan.stale_count() > 0 || !plan.folder.previous || plan.folder.is_unfinished) return false;
    const Manifest& previous = *plan.folder.previous;
    const Manifest fresh = new_manifest(recipe);
    const auto parse = [](const std::string& text) {
        return nlohmann::json::parse(text, nullptr, false);
    };
    const bool same_assets =
        std::equal(previous.assets.begin(), previous.assets.end(), plan.assets.begin(),
                   plan.assets.end(), [](const ManifestAsset& asset, const PlannedAsset& planned) {
                       return asset.name == planned.bake->name;
                   });
    return same_assets && previous.tool_version == fresh.tool_version &&
           parse(previous.parameters) == parse(fresh.parameters);
}

void take_plan(const FolderPlan& plan, const Recipe& recipe, PlannedVariant& variant) {
    for (const PlannedAsset& asset : plan.assets) {
        variant.keys.push_back(asset.identity.key);
        if (asset.up_to_date) {
            variant.result.assets.push_back(variant_asset(*asset.up_to_date));
            continue;
        }
        variant.stale.push_back(
            {asset.bake->name, asset.identity.key, asset.reasons.empty() ? "" : asset.reasons[0]});
        variant.seconds += asset.estimate.seconds;
        variant.needs.insert(variant.needs.end(), asset.needs.begin(), asset.needs.end());
    }
    variant.memory_mib = plan.memory_mib();
    if (is_settled(plan, recipe)) variant.result.status = VariantStatus::done;
}

Diagnostic nothing_to_bake() {
    return diagnosis("E0124", "the variant bakes nothing: it has no [bake.*]",
                     "add [bake.transmittance]");
}

std::string last_failure(const std::filesystem::path& folder) {
    const std::vector<Diagnostic> errors = read_failure(folder);
    return errors.empty() ? "" : errors[0].code + ": " + errors[0].message;
}

// Whether the folder is that of a variant: it is named like "0007_seed=2" and has the files that a
// variant leaves.
bool is_variant_folder(const std::filesystem::path& folder) {
    constexpr std::size_t fewest_digits = 4;
    const std::string name = folder.filename().string();
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (digits < fewest_digits || digits == name.size() || name[digits] != '_') return false;
    std::error_code error;
    return std::filesystem::exists(folder / manifest_name, error) ||
           std::filesystem::exists(folder / failure_name, error);
}

PlannedVariant plan_variant(const SweepJob& job, const VariantNames& names, int index) {
    PlannedVariant variant;
    variant.result.index = index;
    variant.result.name = names.name(index);
    auto recipe = config::load_variant(job.recipe, job.settings, job.sweep, index);
    variant.result.diagnostics = std::move(recipe.diagnostics);
    if (recipe.value && recipe.value->parameters.bakes.empty()) {
        variant.result.diagnostics.push_back(nothing_to_bake());
    } else if (recipe.value) {
        const FolderBake bake = variant_bake(job, *recipe.value, variant.result.name);
        auto plan = plan_folder(bake);  // points into the bake
        std::ranges::move(plan.diagnostics, std::back_inserter(variant.result.diagnostics));
        if (plan.value) take_plan(*plan.value, *recipe.value, variant);
    }
    if (config::exit_code(variant.result.diagnostics) != 0) {
        variant.result.status = VariantStatus::failed;
    }
    if (variant.to_be_made()) {
        variant.last_failure = last_failure(job.folder / variant.result.name);
    }
    return variant;
}

// The libraries of modules begin threads when they are loaded, and end the process where they cannot.
// So modules are loaded before the sweep's own threads take those that the system grants.
void load_modules(const SweepJob& job) {
    const auto recipe = config::load_variant(job.recipe, job.settings, job.sweep, 0);
    if (!recipe.value) return;
    for (const Bake& bake : recipe.value->parameters.bakes) {
        static_cast<void>(missing_module(bake, job.folder));  // its variant will say so
    }
}

}  // namespace

FolderBake variant_bake(const SweepJob& job, const Recipe& recipe, const std::string& name) {
    FolderBake bake;
    bake.recipe = &recipe;
    bake.bakes = recipe.parameters.bakes;
    bake.folder = job.folder / name;
    bake.threads = 1;
    bake.certification = job.certification;
    bake.force = job.force;
    bake.memory_limit_mib = job.memory_limit_mib;
    // The limit is for all variants that are made at once, and none knows what it leaves.
    if (job.memory_limit_mib) bake.held_voxel_bytes = 0;
    return bake;
}

std::vector<PlannedVariant> plan_sweep(const SweepJob& job,
                                       const std::function<bool()>& cancelled) {
    load_modules(job);
    const VariantNames names(job.sweep);
    std::vector<int> indices;
    for (int i = job.shard - 1; i < variant_count(job.sweep); i += job.shards) indices.push_back(i);
    std::vector<PlannedVariant> variants(indices.size());
    parallel_for(static_cast<int>(indices.size()), job.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        if (!cancelled()) variants[at] = plan_variant(job, names, indices[at]);
    });
    if (cancelled()) variants.clear();
    return variants;
}

std::vector<std::string> folders_of_earlier_sweeps(const SweepJob& job) {
    const VariantNames names(job.sweep);
    std::set<std::string> own;
    for (int i = 0; i < variant_count(job.sweep); ++i) own.insert(names.name(i));
    std::vector<std::string> earlier;
    std::error_code error;
    std::filesystem::directory_iterator at(job.folder, error);
    for (; !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
        std::string name = at->path().filename().string();
        if (!own.contains(name) && is_variant_folder(at->path()))
            earlier.push_back(std::move(name));
    }
    std::ranges::sort(earlier);
    return earlier;
}

std::vector<PlannedIntermediate> shared_intermediates(const std::vector<PlannedVariant>& variants) {
    std::vector<PlannedIntermediate> found;
    for (const PlannedVariant& variant : variants) {
        if (!variant.to_be_made()) continue;
        for (const Need& need : variant.needs) add_need(need, variant.result.name, found);
    }
    return found;
}

std::vector<SharedAsset> shared_assets(const std::vector<PlannedVariant>& variants) {
    std::map<std::string, int> users;  // by key
    for (const PlannedVariant& variant : variants) {
        for (const StaleAsset& asset : variant.stale) ++users[asset.key];
    }
    std::vector<SharedAsset> shared;
    std::map<std::string, bool> counted;  // keys
    for (const PlannedVariant& variant : variants) {
        for (const StaleAsset& asset : variant.stale) {
            if (users[asset.key] < 2 || std::exchange(counted[asset.key], true)) continue;
            auto entry = std::ranges::find(shared, asset.name, &SharedAsset::name);
            if (entry == shared.end()) entry = shared.insert(entry, {asset.name, 0, 0});
            entry->variants += users[asset.key];
            ++entry->bakes;
        }
    }
    return shared;
}

void ReadyAssets::add(const std::string& key, std::filesystem::path folder) {
    const auto state = states_.find(key);
    if (state != states_.end()) state->second.folder = std::move(folder);
}

bool ReadyAssets::claim(const std::vector<std::string>& keys, std::vector<std::string>& made) {
    const std::lock_guard lock(mutex_);
    made.clear();
    for (const std::string& key : keys) {
        const auto state = states_.find(key);
        if (state == states_.end() || !state->second.folder.empty()) continue;
        if (state->second.making) return false;
        made.push_back(key);
    }
    for (const std::string& key : made) states_[key].making = true;
    return true;
}

void ReadyAssets::release(const std::vector<std::string>& made) {
    const std::lock_guard lock(mutex_);
    for (const std::string& key : made) states_[key].making = false;
}

std::optional<ReadyAsset> ReadyAssets::find(const std::string& key) {
    std::filesystem::path folder;
    {
        const std::lock_guard lock(mutex_);
        const auto state = states_.find(key);
        if (state != states_.end()) folder = state->second.folder;
    }
    if (folder.empty()) return std::nullopt;
    return asset_in_folder(folder, key);
}

void ReadyAssets::offer(const ReadyAsset& asset) {
    const std::lock_guard lock(mutex_);
    const auto state = states_.find(asset.entry.key);
    if (state != states_.end()) state->second.folder = asset.folder;
}

}  // namespace skybake
