#include "bakers/plan/bake_ways.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/io/formats/texture.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/hash.h"
#include "bakers/plan/plan_files.h"
#include "bakers/render/stage_progress.h"
#include "bakers/workspace/cache_folder.h"
#include "config/assets/asset_kind.h"
#include "config/text/key_path.h"

namespace skybake {

namespace {

// The name in the recipe of the bake that makes an asset of a way.
std::string bake_name(std::size_t index) { return fmt::format("plan_{}", index); }

// Returns an asset whose `of` names the bake of another one of its way. `numbers` are those of the
// way's assets before it.
WayAsset resolved(const Way& way, const std::vector<std::size_t>& numbers) {
    WayAsset asset = way.assets[numbers.size()];
    for (auto& [key, value] : asset.keys) {
        for (std::size_t i = 0; key == "of" && i < numbers.size(); ++i) {
            if (value != config::toml_string(way.assets[i].name)) continue;
            value = config::toml_string(bake_name(numbers[i]));
            break;
        }
    }
    return asset;
}

class AssetBakery {
  public:
    AssetBakery(const Recipe& recipe, std::size_t count, const BakeOptions& options)
        : recipe_(recipe), options_(options), shared_(options.held_voxel_bytes) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto& bakes = recipe.parameters.bakes;
            bakes_.push_back(&*std::ranges::find_if(
                bakes, [&](const auto& bake) { return bake.name == bake_name(i); }));
        }
        options_.intermediates = &shared_;
        options_.certification = Certification::off;
    }

    Outcome<std::vector<BakedAsset>> bake() {
        std::vector<Need> all;
        for (const Bake* bake : bakes_) {
            for (Need& need : needs_of(*bake)) all.push_back(std::move(need));
        }
        const auto expected = shared_.expect(std::move(all));
        std::vector<BakedAsset> assets;
        const double share = 1.0 / static_cast<double>(bakes_.size());
        for (const Bake* bake : bakes_) {
            ProgressPart part(options_.progress, "baking assets",
                              share * static_cast<double>(assets.size()), share);
            BakeOptions options = options_;
            options.progress = &part;
            BakeClock clock;
            Outcome<Baked> one = bake_asset(recipe_, *bake, options);
            if (options.cancelled()) return {};
            if (!one.value) return {{}, std::move(one.diagnostics)};
            const BakeSeconds seconds = clock.seconds();
            const LookupCost lookup = cost_of(
                baker_of(*bake).lookup(recipe_.parameters, *bake, stored_texels(*one.value)));
            assets.push_back({bake, std::move(*one.value), seconds.texels,
                              shared_by(*bake, seconds.light), lookup});
        }
        return {std::move(assets), {}};
    }

  private:
    std::vector<Need> needs_of(const Bake& bake) const {
        return baker_of(bake).needs(recipe_.parameters, bake, Certification::off);
    }

    // Returns what a bake shares with others. The time that it took to make some of it is booked evenly
    // to what no other bake had made.
    std::vector<SharedWork> shared_by(const Bake& bake, double seconds) {
        std::vector<SharedWork> shared;
        std::vector<std::size_t> made;
        for (const Need& need : needs_of(bake)) {
            const auto known = std::ranges::find(known_, need.key, &SharedWork::key);
            if (known == known_.end()) made.push_back(shared.size());
            shared.push_back(known == known_.end() ? SharedWork{need.key, 0} : *known);
        }
        for (const std::size_t i : made) {
            shared[i].seconds = seconds / static_cast<double>(made.size());
            known_.push_back(shared[i]);
        }
        return shared;
    }

    const Recipe& recipe_;
    BakeOptions options_;
    Intermediates shared_;
    std::vector<const Bake*> bakes_;
    std::vector<SharedWork> known_;
};

double bake_seconds(const std::vector<const BakedAsset*>& assets) {
    double seconds = 0;
    std::vector<SharedWork> counted;
    for (const BakedAsset* asset : assets) {
        seconds += asset->seconds;
        for (const SharedWork& work : asset->shared) {
            const auto is_same = [&](const SharedWork& other) { return other.key == work.key; };
            if (std::ranges::any_of(counted, is_same)) continue;
            seconds += work.seconds;
            counted.push_back(work);
        }
    }
    return seconds;
}

constexpr int kVersion = 1;  // of what is kept: a line of JSON, then the sheet

// All that is kept of a way, in the order of the line.
auto kept_of(MeasuredWay& way) {
    SkyError& error = way.error;
    auto& [compared, fetches, bytes, operations] = way.figures;
    return std::tie(error.median, error.ninth_decile, error.max, error.standard_error, error.points,
                    error.left_out, error.worst, error.reference, compared, fetches, bytes,
                    operations, way.bake_s);
}

}  // namespace

std::vector<std::size_t> WayAssets::numbers_of(const Way& way) const {
    std::vector<std::size_t> numbers;
    while (numbers.size() < way.assets.size()) {
        const auto at = std::ranges::find(all_, resolved(way, numbers));
        if (at == all_.end()) break;
        numbers.push_back(static_cast<std::size_t>(at - all_.begin()));
    }
    return numbers;
}

void WayAssets::add(const Way& way) {
    for (;;) {
        const std::vector<std::size_t> numbers = numbers_of(way);
        if (numbers.size() == way.assets.size()) return;
        all_.push_back(resolved(way, numbers));
    }
}

std::vector<const BakedAsset*> WayAssets::of(const Way& way,
                                             const std::vector<BakedAsset>& baked) const {
    std::vector<const BakedAsset*> own;
    for (const std::size_t number : numbers_of(way)) own.push_back(&baked[number]);
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

Outcome<std::vector<BakedAsset>> bake_ways(const Recipe& recipe, const WayAssets& assets,
                                           BakeOptions options) {
    return AssetBakery(recipe, assets.size(), options).bake();
}

MeasuredWay costed(const Way& way, const std::vector<const BakedAsset*>& assets) {
    MeasuredWay measured;
    measured.way = way;
    for (const BakedAsset* asset : assets) {
        const Baked& baked = asset->baked;
        measured.figures.bytes += static_cast<double>(
            texture_bytes(baked.levels.front().size, baked.pixel_type, baked.channel_names.size()));
    }
    measured.bake_s = bake_seconds(assets);
    return measured;
}

void add_lookups(const BakedAsset& asset, double lookups, WayFigures& figures) {
    const LookupCost& one = asset.lookup;
    figures.fetches += lookups * one.fetches;
    figures.operations += lookups * (one.operations + 4 * (one.divisions + one.special_functions));
}

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string figures_key(const Recipe& recipe, std::vector<config::Read> reads,
                        const WayAssets& assets, const MeasuredWays& plan,
                        const std::string& rest) {
    reads.push_back({"scene", {config::Role::content}});
    std::string text = rest + config::parameters_toml(recipe, reads);
    for (const AnyBaker& baker : bakers())
        text += fmt::format("{} {}\n", baker.asset, baker.version);
    for (const std::string& setting : assets.settings()) text += setting + '\n';
    for (const MeasuredWay& way : plan.ways) text += full_name(way.way) + '\n';
    return xxh3_hex(text);
}

bool find_figures(const fs::path& cache, const std::string& key, MeasuredWays& plan) {
    const auto bytes = CachedBytes(cache).find({"plan", kVersion, key});
    if (!bytes) return false;
    const std::size_t end = bytes->find('\n');
    const Json rows = Json::parse(bytes->substr(0, end));
    if (rows.size() != plan.ways.size()) return false;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        std::size_t k = 0;
        std::apply([&](auto&... values) { ((values = rows[i].at(k++)), ...); },
                   kept_of(plan.ways[i]));
    }
    plan.sheet = bytes->substr(end + 1);
    return true;
}

std::vector<Diagnostic> keep_figures(const fs::path& cache, const std::string& key,
                                     const MeasuredWays& plan) {
    Json rows = Json::array();
    for (MeasuredWay way : plan.ways) rows.push_back(kept_of(way));
    return CachedBytes(cache).offer({"plan", kVersion, key}, rows.dump() + '\n' + plan.sheet);
}

}  // namespace skybake
