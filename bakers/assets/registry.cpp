#include "bakers/assets/registry.h"

#include <algorithm>
#include <utility>

#include "bakers/air/particles/layer_phase.h"
#include "config/assets/asset_kind.h"
#include "config/assets/assets.h"
#include "config/text/key_path.h"

namespace skybake {

using config::Bake;
using config::Outcome;
using config::Parameters;

namespace {

template <class Asset>
AnyBaker any_baker(std::string_view asset, const Baker<Asset>& baker) {
    AnyBaker any;
    any.asset = asset;
    any.version = baker.version;
    any.inputs = [&baker](const Parameters& parameters, const Bake& bake) {
        return baker.inputs ? baker.inputs(parameters, bake.as<Asset>()) : std::vector<InputFile>{};
    };
    any.estimate = [&baker](const Parameters& parameters, const Bake& bake) {
        return baker.estimate(parameters, bake.as<Asset>());
    };
    any.places = [&baker](const Parameters& parameters, const Bake& bake,
                          const StoredTexels& stored) {
        return baker.places(parameters, bake.as<Asset>(), stored);
    };
    any.lookup = [&baker](const Parameters& parameters, const Bake& bake,
                          const StoredTexels& stored) {
        return baker.lookup(parameters, bake.as<Asset>(), stored);
    };
    any.draft = [&baker](Bake& bake, int most_voxels) {
        if (baker.draft) baker.draft(bake.as<Asset>(), most_voxels);
    };
    any.bake = [&baker](const Parameters& parameters, const Bake& bake, const BakeOptions& options,
                        AssetLabel label) {
        return baker.bake(parameters, bake.as<Asset>(), options, std::move(label));
    };
    return any;
}

}  // namespace

std::span<const AnyBaker> bakers() {
    static const std::vector<AnyBaker> all = [] {
        std::vector<AnyBaker> found;
        config::for_each_asset([&found]<class Asset>(config::Tag<Asset> asset) {
            found.push_back(any_baker(asset_kind(asset).facts.name, baker(BakerTag<Asset>{})));
        });
        return found;
    }();
    return all;
}

const AnyBaker& baker_of(const Bake& bake) {
    const std::string_view name = config::kind_of(bake).facts.name;
    return *std::find_if(bakers().begin(), bakers().end(),
                         [name](const AnyBaker& baker) { return baker.asset == name; });
}

std::string asset_parameters(const config::Recipe& recipe, const Bake& bake) {
    std::vector<config::Read> reads = config::kind_of(bake).reads(recipe.parameters, bake);
    reads.push_back({config::join_path("bake", bake.name), config::Roles::all()});
    return config::parameters_toml(recipe, reads);
}

Outcome<Baked> bake_asset(const config::Recipe& recipe, const Bake& bake,
                          const BakeOptions& options) {
    std::vector<config::Diagnostic> problems = check_particles(recipe.parameters);
    if (!problems.empty()) return {{}, std::move(problems)};
    const AnyBaker& baker = baker_of(bake);
    AssetLabel label;
    label.name = bake.name;
    label.parameters = asset_parameters(recipe, bake);
    label.details.emplace_back("baker_version", static_cast<double>(baker.version));
    return baker.bake(recipe.parameters, bake, options, std::move(label));
}

}  // namespace skybake
