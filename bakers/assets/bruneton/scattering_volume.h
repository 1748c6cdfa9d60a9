// The tables with four axes as volumes, and the places of their probes.
#pragma once

#include <array>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/field/choose_probes.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct Baked;

// The air at the wavelengths that are computed together, and its light; null: no higher orders.
struct ScatteringPacket {
    const config::Atmosphere& atmosphere;
    SkyMedium medium;  // without forward peaks
    std::shared_ptr<const SolvedLight> light;
    SkyMedium air = {};  // with them
};

// Bakes the volume: of the wavelengths of one packet, or of the colours that `weights` make of those
// of all packets. `volume` comes with name, parameters, details and channels.
Outcome<Baked> bake_scattering(const std::vector<ScatteringPacket>& packets,
                               const std::vector<glm::dvec3>& weights, const BrunetonBake& bake,
                               const BakeOptions& options, Baked volume);

// A ray, a sun and the cosine between them: the arguments of a runtime's lookup in a table of
// scattering.
struct ScatteringPlace {
    ScatteringView view;
    double sun_cos_zenith = 1;
    double nu = 1;
};

// Returns the place of texture coordinates, with the nearest possible cosine between ray and sun.
// The ray is at least kHorizonMargin away from the horizon, and rays to the ground start above it.
ScatteringPlace scattering_place(const ScatteringMapping& mapping,
                                 const std::array<double, 3>& uvw);

// Returns the two lookups that a runtime blends along nu, or one where there is only one sub-image.
std::vector<ProbeLookup> scattering_lookups(const ScatteringMapping& mapping,
                                            const ScatteringPlace& place);

// Returns the probe's place by altitude_km, cos_zenith, sun_cos_zenith, nu, and ground, which is 1
// if the ray meets the ground, else 0.
ProbePlace scattering_probe_place(const ScatteringMapping& mapping,
                                  const std::array<double, 3>& uvw);

// Returns the place that a probe names: the inverse of scattering_probe_place.
ScatteringPlace scattering_place(const ScatteringMapping& mapping, double altitude_km,
                                 double cos_zenith, double sun_cos_zenith, double nu, bool ground);

}  // namespace skybake
