// A runtime finds a sky with the assets of a way: the light, and the fetches that it takes.
#pragma once

#include <vector>

#include "bakers/plan/bake_ways.h"
#include "bakers/plan/sky_truth.h"
#include "bakers/plan/sky_ways.h"
#include "config/sections/parameters.h"

namespace skybake {

class SkyOfWay {
  public:
    // The arguments must outlive it. The assets are those of the recipe.
    SkyOfWay(const config::Parameters& parameters, const SceneTruth& truth, int threads)
        : parameters_(parameters), truth_(truth), threads_(threads) {}

    // Returns the light in the truth's views, and sets the fetches of a mean pixel.
    std::vector<Spectrum> find(const SkyWay& way, const std::vector<const BakedAsset*>& assets,
                               double& fetches) const;

  private:
    std::vector<Spectrum> march(const SkyWay& way, const std::vector<const BakedAsset*>& assets,
                                double& fetches) const;
    std::vector<Spectrum> fetch(const BakedAsset& asset) const;
    std::vector<Spectrum> look_up(const BakedAsset& asset) const;

    const config::Parameters& parameters_;
    const SceneTruth& truth_;
    int threads_;
};

}  // namespace skybake
