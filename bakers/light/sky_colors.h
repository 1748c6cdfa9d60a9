// How the light of a few wavelengths becomes the colours of a sky.
//
// A colour is an integral over all wavelengths. For the light of one planet's sky a sum over a few
// wavelengths comes near it:
//
//   colour = sum over wavelengths i of weight_i L(lambda_i)
//
// The weights are fitted by least squares, relative to luminance, to skies of the very air: radiances
// in many directions under many suns, and the sun's own light at several elevations. Their spectra
// are solved for at every fifth nm from 380 to 780 nm with few nodes, since only their shape
// matters. Other suns, which the fit has not seen, tell the error.
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/sections/atmosphere.h"
#include "config/sections/color.h"

namespace skybake {

struct SkyColors {
    std::vector<glm::dvec3> weights;  // one per wavelength, in the recipe's order
    ColorError error;
};

// What the weights follow from. The space must not be `none`.
struct ColorRequest {
    std::vector<config::Length> wavelengths;  // of the recipe, at least two
    config::Color color;
    config::Atmosphere atmosphere;  // at these wavelengths
    bool operator==(const ColorRequest&) const = default;
};

Need need_of(const ColorRequest& request);

// Returns the weights, shared by all assets that ask for them. Null after an interruption.
std::shared_ptr<const SkyColors> colors_of(const ColorRequest& request, const BakeOptions& options);

// Returns the parts of an atmosphere whose wavelengths are computed together, kMaxChannels each.
std::vector<config::Atmosphere> packets_of(const config::Atmosphere& atmosphere);

}  // namespace skybake
