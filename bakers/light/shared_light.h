// Solved light and sunlight as assets ask for them: by the recipe's values, so that a plan knows
// what is needed, and who shares it, before anything is solved.
#pragma once

#include <memory>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/sections/atmosphere.h"
#include "config/sections/scene.h"

namespace skybake {

// Whether some of the air are spheres, whose light has forward peaks.
bool has_spheres(const config::Atmosphere& atmosphere);

// The light that an asset is made from.
struct LightRequest {
    config::Atmosphere atmosphere;
    bool peaks_of_spheres = false;  // false: forward peaks count as not scattered
    int degree = 0;                 // of the moments; 0: as the sky needs (sky_degree)
    int orders = 0;                 // the last order; 0: all
    bool finer = false;             // a reference, of a degree higher by degree_more
    int degree_more = 0;
    bool operator==(const LightRequest&) const = default;
};

// Returns the medium of a request.
SkyMedium medium_of(const LightRequest& request);

Need need_of(const LightRequest& request);

// Returns the light of a request in its medium, for a solar irradiance of 1. After an interruption
// the light must not be used.
std::shared_ptr<const SolvedLight> light_of(const LightRequest& request, const SkyMedium& medium,
                                            const BakeOptions& options);

// A table of the transmittance towards the sun through the air of an atmosphere, in which light that
// goes into forward peaks counts as not scattered. On Earth its lookups are 3e-6 off in the root mean square, and 2e-4 where
// rays graze the edge of a layer.
struct SunlightRequest {
    config::Atmosphere atmosphere;
    bool peaks = false;  // true: of the air as it is, which has such peaks
    bool operator==(const SunlightRequest&) const = default;
};

// Returns what light of these orders asks for: light that is scattered once knows no peaks.
SunlightRequest sunlight_request(const config::Atmosphere& atmosphere, config::SkyOrders orders);

Need need_of(const SunlightRequest& request);

// Returns the table of an atmosphere whose air, as the request has it, is `air`.
std::shared_ptr<const TransmittanceField> sunlight_of(const SunlightRequest& request,
                                                      const Medium& air,
                                                      const BakeOptions& options);

// Returns the same, made for one asset.
std::shared_ptr<const TransmittanceField> make_sunlight(const Medium& air, int threads);

}  // namespace skybake
