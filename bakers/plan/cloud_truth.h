// The sunlight of a cloud's views by paths, traced once for all ways.
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <string>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"
#include "bakers/plan/cloud_views.h"

namespace skybake {

class CloudTruth {
  public:
    // The arguments must outlive it. The sun has the irradiance 1; sky and ground are black.
    CloudTruth(const cloud_light::CloudLayer& layer, const CloudRange& range,
               std::vector<CloudView> views, const BakeOptions& options);

    // Traces the views in which the cloud covers more than a hundredth of what is behind it, with as
    // many paths each. After an interruption the light must not be used.
    void trace(double paths);

    const std::vector<CloudView>& views() const { return views_; }
    glm::dvec3 sun(const CloudView& view) const;
    const std::vector<cloud_light::TracedRadiance>& light() const { return light_; }

    // Compares the covered views as a picture shows them: a radiance L is the share 1 - exp(-k L) of
    // white, with the k that shows the ninth decile as 0.78. Sets `rms` to the root mean square without
    // the noise of paths. Where no light is seen, one value is left out.
    SkyError error(const std::vector<double>& found, double& rms) const;

  private:
    double exposure() const;
    bool is_covered(const CloudView& view) const;

    const cloud_light::CloudLayer& layer_;
    const CloudRange& range_;
    const BakeOptions& options_;
    std::vector<CloudView> views_;
    std::vector<cloud_light::TracedRadiance> light_;
    std::vector<std::size_t> covered_;
    int paths_ = 0;  // of a view
};

}  // namespace skybake
