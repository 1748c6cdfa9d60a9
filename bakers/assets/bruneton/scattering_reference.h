// What tables of scattering are measured against: each value by direct integration along its view
// ray (sky_radiance.h), each group of layers on its own.
#pragma once

#include <memory>
#include <vector>

#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"

namespace skybake {

class ScatteringReference {
  public:
    // All must outlive it; without `higher` there are no higher orders.
    ScatteringReference(const SkyMedium& medium, const ScatteringContent& content,
                        const HigherOrders* higher);

    // Of directions that there are.
    ScatteringParts parts(const ScatteringView& view, double sun_cos_zenith, double nu) const;

  private:
    const ScatteringContent& content_;
    SkyMedium air_;  // the medium, where no Mie layer scatters
    SkyMedium mie_;  // where none but they do
    SkyIntegrator all_;
    SkyIntegrator air_alone_;
    SkyIntegrator mie_alone_;
};

}  // namespace skybake
