// A sheet of pictures: a cloud in sunlight by paths, and what each family of ways makes of it.
//
// A runtime finds a cloud with the assets of a way: the light, and the lookups that it takes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/math/bake_options.h"
#include "bakers/plan/bake_ways.h"
#include "bakers/plan/cloud_truth.h"
#include "bakers/plan/cloud_ways.h"
#include "bakers/plan/marched_cloud.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"

namespace skybake {

struct FoundCloud {
    std::vector<double> radiance;  // of each view
    // Lookups of a mean view: of densities, of cells, and how often of light.
    double densities = 0, cells = 0, lit = 0;
};

class CloudOfWay {
  public:
    // The arguments must outlive it. `cloud` is the recipe's, as its volume spans it.
    CloudOfWay(const Cloud& cloud, const CloudTruth& truth, const BakeOptions& options)
        : cloud_(cloud), truth_(truth), options_(options) {}

    // Returns the light in the truth's views, and the lookups of a mean view.
    FoundCloud find(const CloudWay& way, const std::vector<const BakedAsset*>& assets);

    // Returns the textures of a way for a sun, which live as long as this does.
    CloudTextures textures(const CloudWay& way, const std::vector<const BakedAsset*>& assets,
                           std::size_t sun);

  private:
    const cloud_light::CloudLayer& layer_of(const BakedAsset& asset);
    const StoredTexture& texture_of(const BakedAsset& asset);
    const std::vector<MarchedRay>& marched(const CloudWay& way,
                                           const std::vector<const BakedAsset*>& assets);

    const Cloud& cloud_;
    const CloudTruth& truth_;
    const BakeOptions& options_;
    std::map<const BakedAsset*, cloud_light::CloudLayer> layers_;
    std::map<const BakedAsset*, StoredTexture> textures_;
    std::map<std::string, std::vector<MarchedRay>> marched_;  // by CloudWay::drawing
};

// Returns a PNG with a row for the truth and one for each of the clouds, under up to two suns of the
// scene, which shine from the right. The camera looks up at the layer or, where all cameras are above
// it, down. `layer` has the finest voxels. Diagnostics are those of png_bytes. After an interruption the
// picture must not be used.
Outcome<std::string> cloud_sheet(const Cloud& cloud, const cloud_light::CloudLayer& layer,
                                 const CloudRange& range,
                                 const std::vector<BakedWay<CloudWay>>& clouds,
                                 const BakeOptions& options);

}  // namespace skybake
