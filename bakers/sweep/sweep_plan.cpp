#include "bakers/sweep/sweep_plan.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "bakers/core/parallel.h"
#include "bakers/sweep/variant_failure.h"
#include "bakers/sweep/variant_names.h"
#include "config/diagnostic_codes.h"
#include "config/recipe.h"

namespace skybake {
namespace {

using config::Outcome;

// Whether the manifest of the folder says what it would say if it were written now: the parameters
// of the recipe are in it, also those that no asset depends on.
bool is_settled(const FolderPlan& plan, const config::Recipe& recipe) {
    if (plan.stale_count() > 0 || !plan.folder.previous) return false;
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
           previous.wavelengths_nm == fresh.wavelengths_nm &&
           parse(previous.parameters) == parse(fresh.parameters);
}

void take_plan(const FolderPlan& plan, const config::Recipe& recipe, PlannedVariant& variant) {
    for (const PlannedAsset& asset : plan.assets) {
        if (asset.up_to_date) {
            variant.result.assets.push_back(variant_asset(*asset.up_to_date));
            continue;
        }
        variant.stale.push_back(
            {asset.bake->name, asset.identity.key, asset.reasons.empty() ? "" : asset.reasons[0]});
        variant.seconds += asset.estimate.seconds;
    }
    variant.memory_mib = plan.memory_mib();
    if (is_settled(plan, recipe)) variant.result.status = VariantStatus::done;
}

config::Diagnostic nothing_to_bake() {
    return {config::Severity::error,
            "E0124",
            "the variant asks for nothing: it has no [bake.*]",
            {},
            "add [bake.transmittance]"};
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
        std::move(plan.diagnostics.begin(), plan.diagnostics.end(),
                  std::back_inserter(variant.result.diagnostics));
        if (plan.value) take_plan(*plan.value, *recipe.value, variant);
    }
    if (config::exit_code(variant.result.diagnostics) != 0) {
        variant.result.status = VariantStatus::failed;
    }
    return variant;
}

}  // namespace

FolderBake variant_bake(const SweepJob& job, const config::Recipe& recipe,
                        const std::string& name) {
    FolderBake bake;
    bake.recipe = &recipe;
    bake.bakes = recipe.parameters.bakes;
    bake.folder = job.folder / name;
    bake.threads = 1;
    bake.certification = job.certification;
    bake.force = job.force;
    bake.memory_limit_mib = job.memory_limit_mib;
    return bake;
}

std::vector<PlannedVariant> plan_sweep(const SweepJob& job,
                                       const std::function<bool()>& cancelled) {
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
            auto entry = std::find_if(shared.begin(), shared.end(), [&](const SharedAsset& known) {
                return known.name == asset.name;
            });
            if (entry == shared.end()) entry = shared.insert(entry, {asset.name, 0, 0});
            entry->variants += users[asset.key];
            ++entry->bakes;
        }
    }
    return shared;
}

}  // namespace skybake
