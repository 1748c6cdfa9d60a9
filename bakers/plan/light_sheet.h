// A sheet of pictures: light by paths, and what each family of ways makes of it.
//
// A runtime finds light with the assets of a way.
#pragma once

#include <string>
#include <vector>

#include "bakers/plan/bake_ways.h"
#include "bakers/plan/light_truth.h"
#include "bakers/plan/light_ways.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

class LightOfWay {
  public:
    // The arguments must outlive it. The assets are those of the recipe.
    LightOfWay(const Parameters& parameters, const SceneTruth& truth, int threads)
        : parameters_(parameters), truth_(truth), threads_(threads) {}

    // Returns the light in the truth's views.
    std::vector<Spectrum> find(const LightWay& way,
                               const std::vector<const BakedAsset*>& assets) const;

  private:
    std::vector<Spectrum> march(const LightWay& way,
                                const std::vector<const BakedAsset*>& assets) const;
    std::vector<Spectrum> fetch(const BakedAsset& asset) const;
    std::vector<Spectrum> look_up(const LightWay& way,
                                  const std::vector<const BakedAsset*>& assets) const;

    const Parameters& parameters_;
    const SceneTruth& truth_;
    int threads_;
};

// Returns a PNG with a row for the truth and one for each of the ways. For up to three suns of the scene
// it has a picture all around, the sun in the middle, and its relative difference from the truth: of the
// sky, of the air before the most distant things, or of all directions. Light on the ground has no
// pictures. `weights` are those of SceneTruth. Diagnostics are those of png_bytes. After an
// interruption the picture must not be used.
Outcome<std::string> light_sheet(config::Draws light, const Parameters& parameters,
                                 const SceneRange& range,
                                 const std::vector<BakedWay<LightWay>>& ways,
                                 const std::vector<glm::dvec3>& weights,
                                 const BakeOptions& options);

}  // namespace skybake
