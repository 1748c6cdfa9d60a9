// The tables of four axes as volumes.
#pragma once

#include <array>
#include <memory>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/field/baked.h"
#include "bakers/field/choose_probes.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// `volume` has its name, parameters, details and channels; without `light` there are no higher
// orders.
config::Outcome<Baked> bake_scattering(const SkyMedium& medium,
                                       const std::shared_ptr<const SolvedLight>& light,
                                       const config::BrunetonBake& bake, const BakeOptions& options,
                                       Baked volume);

// Where the probes of a table of scattering may lie.

// A ray, a sun and the cosine between them: what a runtime asks a table of scattering for.
struct ScatteringPlace {
    ScatteringView view;
    double sun_cos_zenith = 1;
    double nu = 1;
};

// The place of texture coordinates, of the nearest cosine that there is between ray and sun. It
// keeps off the horizon by kHorizonMargin, and rays to the ground start above it.
ScatteringPlace scattering_place(const ScatteringMapping& mapping,
                                 const std::array<double, 3>& uvw);

// The two lookups that a runtime blends along nu; one where there is but one sub-image.
std::vector<ProbeLookup> scattering_lookups(const ScatteringMapping& mapping,
                                            const ScatteringPlace& place);

// altitude_km, cos_zenith, sun_cos_zenith, nu, and ground: 1 where the ray meets it, else 0.
ProbePlace scattering_probe_place(const ScatteringMapping& mapping,
                                  const std::array<double, 3>& uvw);

// The place that a probe names: the inverse of the above.
ScatteringPlace scattering_place(const ScatteringMapping& mapping, double altitude_km,
                                 double cos_zenith, double sun_cos_zenith, double nu, bool ground);

}  // namespace skybake
