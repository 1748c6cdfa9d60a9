// The sky as a runtime makes it from stored tables: by the published lookups, in as many steps.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/field/baked.h"
#include "bakers/light/higher_orders.h"

namespace skybake {

// The tables of a march through the air. All members must outlive it.
struct MarchedTables {
    const SkyMedium& medium;
    const Baked& transmittance;
    AssetPlaces places;                    // of the transmittance's probes
    const HigherOrders* orders = nullptr;  // null: light that is scattered once
};

// Returns the radiance of the air at the samples. A ray is cut into `steps` parts that are equal in the
// root of the distance from its densest point, as the previews and examples/renderer.md do it; each
// has the air, the sunlight and the light scattered before of its middle, and dims what is behind it
// exactly.
std::vector<Spectrum> march_sky(const MarchedTables& tables, const std::vector<SkySample>& samples,
                                int steps, int threads);

}  // namespace skybake
