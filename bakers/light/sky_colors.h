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

#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/light/sky_spectra.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/sections/atmosphere.h"
#include "config/sections/color.h"

namespace skybake {

struct SkyColors {
    std::vector<glm::dvec3> weights;  // one per wavelength, in the recipe's order
    ColorError error;
};

// A recipe's colours in its own words, as files state them. Where the space is `none` it is
// that of the weights.
struct ColorWords {
    std::string space, white, sun, observer;
};
ColorWords words_of(const config::Color& color);

// The skies of an air, to which weights are fitted and by which they are measured.
class ColorSkies {
  public:
    // Solves for the spectra of air that is given at some wavelengths. After an interruption it must
    // not be used.
    ColorSkies(const config::Atmosphere& atmosphere, const std::vector<config::Length>& given,
               const BakeOptions& options);

    // Takes the spectra of spectrum_views.
    explicit ColorSkies(Spectra spectra);

    // Returns the weights of wavelengths in any order, fitted to the views under every second sun
    // and to the sun's disc.
    std::vector<glm::dvec3> fitted_weights(const std::vector<config::Length>& wavelengths,
                                           const config::Color& color) const;

    // Returns the error of any weights, in the other views and of the sun's disc.
    ColorError error(const std::vector<config::Length>& wavelengths, const config::Color& color,
                     const std::vector<glm::dvec3>& weights) const;

  private:
    std::size_t views_ = 0;
    Spectra spectra_;
};

// Returns the weights for spectra that are linear between wavelengths of any order, each of which
// stands there once (bakers/color/spectral_color.h).
std::vector<glm::dvec3> linear_color_weights(const std::vector<config::Length>& wavelengths,
                                             const config::Color& color);

// The request that the weights follow from.
struct ColorRequest {
    std::vector<config::Length> wavelengths;  // of the recipe, at least two
    config::Color color;
    config::Atmosphere atmosphere;  // at these wavelengths
    bool operator==(const ColorRequest&) const = default;
};

Need need_of(const ColorRequest& request);

// Returns a text that is another one for another request.
std::string key_text(const ColorRequest& request);

// Raise it with every change of what is fitted: of the skies, of how they are solved for, of the fit.
constexpr int kColorFitVersion = 2;

// Returns the weights, shared by all assets that ask for them, and kept for later runs. Null after an
// interruption.
std::shared_ptr<const SkyColors> colors_of(const ColorRequest& request, const BakeOptions& options);

// Returns the parts of an atmosphere whose wavelengths are computed together, kMaxChannels each.
std::vector<config::Atmosphere> packets_of(const config::Atmosphere& atmosphere);

}  // namespace skybake
