// The generalised minimal residual method (Saad & Schultz 1986, Saad 1993) for x - K x = b, where K
// takes light to its next order of scattering.
//
// Each direction of the search is corrected first: a guess of (1 - K)^-1 applied to it makes the few
// directions that follow tell almost all. The guess may be rough, or none. Channels are searched
// for separately, with the same directions.
#pragma once

#include <functional>
#include <vector>

#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Applies K: computes the light of the next order.
using NextOrder = std::function<void(const LightField& light, LightField& next)>;

// Errors are shares of these values: for each level and sun the mean light, then for each sun the sky's
// irradiance; kChannelSlots values each, all above 0.
using LightScale = std::vector<double>;

// Returns the light that the search tells apart, in the order of a scale: where light is darker than
// 1e-12 of a channel's brightest, or than 1e-3 of the brightest level under the same sun, that. It is 0
// in channels without light.
LightScale resolved_light(const LightField& light);

// Returns the same as a scale, which is 1 in channels without light.
LightScale light_scale(const LightField& light);

// Returns approximately (1 - K)^-1 residual.
using CorrectResidual =
    std::function<LightField(const LightField& residual, const LightScale& scale)>;

// Returns the residual first + K light - light.
LightField residual_of(const LightField& first, const NextOrder& next, const LightField& light);

// to += from
void add(const LightField& from, LightField& to);

// Return the size of a field relative to a scale: the root mean square over all moments of the
// channel for which it is largest, and the largest share anywhere.
double mean_share(const LightField& field, const LightScale& scale);
double largest_share(const LightField& field, const LightScale& scale);

struct ResidualSearch {
    double tolerance = 0;  // the mean share of the light that may be missing
    int most_applications = 0;
};

// Adds to `light` the best combination of directions, and leaves its new residual in `residual`.
// Returns how often K was applied.
int search_residual(const NextOrder& next, const CorrectResidual& correct, const LightScale& scale,
                    const ResidualSearch& search, Progress* progress, LightField& residual,
                    LightField& light);

}  // namespace skybake
