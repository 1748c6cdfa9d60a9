// The light of a scene's views by paths, traced once for all ways.
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <vector>

#include "bakers/assets/sky/sky_comparison.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/assets/sky/traced_light.h"
#include "config/sections/atmosphere.h"

namespace skybake {

class SceneTruth {
  public:
    // The air has at most four wavelengths, of which `weights` make colours; none: their light is
    // compared itself.
    SceneTruth(const config::Atmosphere& air, std::vector<SkySample> views,
               std::vector<glm::dvec3> weights, BakeOptions options);

    // Traces `most_paths` paths in all views together. After an interruption the light must not be used.
    void trace(double most_paths) { comparison_.trace(most_paths); }

    const std::vector<SkySample>& views() const { return views_; }
    const SkyMedium& medium() const { return air_->medium(); }
    const std::shared_ptr<const TracedAir>& air() const { return air_; }
    // Returns the channels that are compared, of light of the wavelengths.
    std::vector<Spectrum> as_compared(std::vector<Spectrum> light) const;
    SkyError error(const std::vector<Spectrum>& found) const { return comparison_.error(found); }

  private:
    std::vector<SkySample> views_;
    BakeOptions options_;
    std::shared_ptr<const TracedAir> air_;
    std::vector<glm::dvec3> weights_;
    TracedLight light_;
    SkyComparison comparison_;
};

}  // namespace skybake
