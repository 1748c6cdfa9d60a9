// The assets of ways in memory, each baked once however many ways have it.
//
// Figures of ways that were measured before, in a cache.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "bakers/plan/choose_way.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Work that assets share, such as a solution of light, and the time that it took.
struct SharedWork {
    NeedKey key;
    double seconds = 0;
};

// An asset in memory and what it took.
struct BakedAsset {
    const Bake* bake = nullptr;  // of the recipe
    Baked baked;
    double seconds = 0;  // of its texels alone
    std::vector<SharedWork> shared;
    LookupCost lookup;
};

// The assets of all ways, each once.
class WayAssets {
  public:
    // Ways are of any kind that is a Way.
    template <class OneWay>
    explicit WayAssets(const std::vector<OneWay>& ways) {
        for (const Way& way : ways) add(way);
    }

    std::size_t size() const { return all_.size(); }
    // Returns those of a way among all, which stand in the same order.
    std::vector<const BakedAsset*> of(const Way& way, const std::vector<BakedAsset>& baked) const;

    // Returns the settings that add them to a recipe.
    std::vector<std::string> settings() const;

  private:
    void add(const Way& way);
    // Returns the numbers of a way's assets, or of those that are among all.
    std::vector<std::size_t> numbers_of(const Way& way) const;

    std::vector<WayAsset> all_;  // `of` names the bake of one before it
};

// Returns the way with the size of its textures, in which three channels take the room of four, and the
// time of its bakes; all else is to be measured. What assets share counts once, whoever made it first.
MeasuredWay costed(const Way& way, const std::vector<const BakedAsset*>& assets);

// Adds what lookups of an asset take.
void add_lookups(const BakedAsset& asset, double lookups, WayFigures& figures);

// A way of any kind, and its assets.
template <class OneWay>
struct BakedWay {
    const OneWay* way = nullptr;
    std::vector<const BakedAsset*> assets;
};

// Bakes all assets, without certificates. `recipe` has the settings of `assets` and must outlive the
// result. After an interruption there is neither a value nor a diagnostic.
Outcome<std::vector<BakedAsset>> bake_ways(const Recipe& recipe, const WayAssets& assets,
                                           BakeOptions options);

// Returns a key that tells all that the figures of ways depend on: what the recipe says and reads, its
// scene without the limits, the bakers, the assets, the ways, and `rest`.
std::string figures_key(const Recipe& recipe, std::vector<config::Read> reads,
                        const WayAssets& assets, const MeasuredWays& plan, const std::string& rest);

// Fills in a plan's figures and its sheet from the cache. Returns false if it has none under this key.
bool find_figures(const std::filesystem::path& cache, const std::string& key, MeasuredWays& plan);

// Keeps them. W0301 if the cache cannot be written; a plan goes on without it.
std::vector<Diagnostic> keep_figures(const std::filesystem::path& cache, const std::string& key,
                                     const MeasuredWays& plan);

}  // namespace skybake
