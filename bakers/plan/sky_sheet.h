// A sheet of pictures: the sky by paths of light, and what each family of ways makes of it.
//
// A runtime finds a sky with the assets of a way: the light, and the fetches that it takes.
#pragma once

#include <string>
#include <vector>

#include "bakers/plan/bake_ways.h"
#include "bakers/plan/sky_truth.h"
#include "bakers/plan/sky_ways.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

class SkyOfWay {
  public:
    // The arguments must outlive it. The assets are those of the recipe.
    SkyOfWay(const Parameters& parameters, const SceneTruth& truth, int threads)
        : parameters_(parameters), truth_(truth), threads_(threads) {}

    // Returns the light in the truth's views, and sets the fetches of a mean pixel.
    std::vector<Spectrum> find(const SkyWay& way, const std::vector<const BakedAsset*>& assets,
                               double& fetches) const;

  private:
    std::vector<Spectrum> march(const SkyWay& way, const std::vector<const BakedAsset*>& assets,
                                double& fetches) const;
    std::vector<Spectrum> fetch(const BakedAsset& asset) const;
    std::vector<Spectrum> look_up(const BakedAsset& asset) const;

    const Parameters& parameters_;
    const SceneTruth& truth_;
    int threads_;
};

// Returns a PNG with a row for the truth and one for each of the skies. For up to three suns of the scene
// it has the sky, the sun in the middle and the horizon below, and its relative difference from the
// truth. `weights` are those of SceneTruth. Diagnostics are those of png_bytes. After an interruption
// the picture must not be used.
Outcome<std::string> sky_sheet(const Parameters& parameters, const SceneRange& range,
                               const std::vector<BakedWay<SkyWay>>& skies,
                               const std::vector<glm::dvec3>& weights, const BakeOptions& options);

}  // namespace skybake
