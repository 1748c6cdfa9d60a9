#include "bakers/plan/bake_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/intermediates.h"

namespace skybake {

using config::Outcome;
using config::Recipe;

namespace {

// The name in the recipe of the bake that makes an asset of a way.
std::string bake_name(std::size_t index) { return fmt::format("plan_{}", index); }

}  // namespace

WayAssets::WayAssets(const std::vector<SkyWay>& ways) {
    for (const SkyWay& way : ways) {
        for (const WayAsset& asset : way.assets) {
            if (std::find(all_.begin(), all_.end(), asset) == all_.end()) all_.push_back(asset);
        }
    }
}

std::vector<const BakedAsset*> WayAssets::of(const SkyWay& way,
                                             const std::vector<BakedAsset>& baked) const {
    std::vector<const BakedAsset*> own;
    for (const WayAsset& asset : way.assets) {
        const auto at = std::find(all_.begin(), all_.end(), asset);
        own.push_back(&baked[static_cast<std::size_t>(at - all_.begin())]);
    }
    return own;
}

std::vector<std::string> WayAssets::settings() const {
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        for (const auto& [key, value] : all_[i].keys) {
            settings.push_back(fmt::format("bake.{}.{}={}", bake_name(i), key, value));
        }
    }
    return settings;
}

namespace {

class AssetBakery {
  public:
    AssetBakery(const Recipe& recipe, std::size_t count, const BakeOptions& options)
        : recipe_(recipe), options_(options), shared_(options.held_voxel_bytes) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto& bakes = recipe.parameters.bakes;
            bakes_.push_back(&*std::find_if(bakes.begin(), bakes.end(), [&](const auto& bake) {
                return bake.name == bake_name(i);
            }));
        }
        options_.intermediates = &shared_;
        options_.certification = Certification::off;
    }

    Outcome<std::vector<BakedAsset>> bake() {
        std::vector<Need> all;
        for (const config::Bake* bake : bakes_) {
            for (Need& need : needs_of(*bake)) all.push_back(std::move(need));
        }
        const auto expected = shared_.expect(std::move(all));
        Outcome<std::vector<BakedAsset>> outcome;
        std::vector<BakedAsset> assets;
        for (const config::Bake* bake : bakes_) {
            BakeClock clock;
            Outcome<Baked> one = bake_asset(recipe_, *bake, options_);
            if (options_.cancelled()) return {};
            if (!one.value) return {{}, std::move(one.diagnostics)};
            assets.push_back({bake, std::move(*one.value), seconds_of(*bake, clock.seconds())});
        }
        outcome.value = std::move(assets);
        return outcome;
    }

  private:
    std::vector<Need> needs_of(const config::Bake& bake) const {
        return baker_of(bake).needs(recipe_.parameters, bake, Certification::off);
    }

    // Adds the time of light that another asset made.
    double seconds_of(const config::Bake& bake, const BakeSeconds& booked) {
        double light_s = 0;
        const std::vector<Need> needs = needs_of(bake);
        for (const Need& need : needs) {
            const auto known = std::find_if(light_.begin(), light_.end(), [&](const auto& one) {
                return one.first.key == need.key;
            });
            if (known != light_.end()) light_s += known->second;
        }
        if (light_s == 0 && !needs.empty()) {
            light_s = booked.light;
            for (const Need& need : needs) {
                light_.emplace_back(need, booked.light / static_cast<double>(needs.size()));
            }
        }
        return booked.texels + light_s;
    }

    const Recipe& recipe_;
    BakeOptions options_;
    Intermediates shared_;
    std::vector<const config::Bake*> bakes_;
    std::vector<std::pair<Need, double>> light_;
};

}  // namespace

Outcome<std::vector<BakedAsset>> bake_ways(const Recipe& recipe, const WayAssets& assets,
                                           BakeOptions options) {
    return AssetBakery(recipe, assets.size(), options).bake();
}

}  // namespace skybake
