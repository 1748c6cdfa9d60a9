// A runtime finds a cloud with the assets of a way: the light, and the fetches that it takes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/cloud_truth.h"
#include "bakers/plan/cloud_ways.h"
#include "bakers/plan/marched_cloud.h"
#include "config/sections/cloud.h"

namespace skybake {

struct FoundCloud {
    std::vector<double> radiance;  // of each view
    double fetches = 0;            // of a mean view
};

class CloudOfWay {
  public:
    // The arguments must outlive it. `cloud` is the recipe's, as its volume spans it.
    CloudOfWay(const config::Cloud& cloud, const CloudTruth& truth, const BakeOptions& options)
        : cloud_(cloud), truth_(truth), options_(options) {}

    // Returns the light in the truth's views, and the fetches of a mean view.
    FoundCloud find(const CloudWay& way, const std::vector<const BakedAsset*>& assets);

    // Returns the textures of a way for a sun, which live as long as this does.
    CloudTextures textures(const CloudWay& way, const std::vector<const BakedAsset*>& assets,
                           std::size_t sun);

  private:
    const cloud_light::CloudLayer& layer_of(const BakedAsset& asset);
    const StoredTexture& texture_of(const BakedAsset& asset);
    const std::vector<MarchedRay>& marched(const CloudWay& way,
                                           const std::vector<const BakedAsset*>& assets);

    const config::Cloud& cloud_;
    const CloudTruth& truth_;
    const BakeOptions& options_;
    std::map<const BakedAsset*, cloud_light::CloudLayer> layers_;
    std::map<const BakedAsset*, StoredTexture> textures_;
    std::map<std::string, std::vector<MarchedRay>> marched_;  // by CloudWay::drawing
};

}  // namespace skybake
