// Spectra of a sky in many directions under many suns, and of the sun itself, for fitting colours.
//
// Only their shapes matter, so they are solved for with few nodes, and with spheres interpolated between
// every fiftieth nm.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/light/sky_ray.h"
#include "bakers/math/bake_options.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// A direction from a camera low in the air.
struct SpectrumView {
    SunZenith sun;
    double above_deg = 0;    // the horizon
    double azimuth_deg = 0;  // from the sun
};

// Elevations at which the sun is seen from the ground.
inline constexpr std::array kSpectrumDiscs_deg = {90.0, 40.0, 20.0, 10.0, 7.0, 5.0,
                                                  3.0,  2.0,  1.0,  0.5,  0.2, 0.0};

// Returns all views, and whether view number i is one of those that weights are fitted to: the views
// under every second sun.
std::vector<SpectrumView> spectrum_views();
bool is_fitted(std::size_t view);

// Returns the wavelengths of the spectra, every fifth nm from 380 to 780.
std::vector<double> spectrum_nm();

// [sample][wavelength]: in 1/sr of the views, then the transmittance to the sun at each elevation.
using Spectra = std::vector<std::vector<double>>;

// How views are integrated: those at one height above the horizon together (sky_row.h), or each ray
// by itself, which takes several times as long and is what tests compare with.
enum class SpectrumRays { in_rows, one_by_one };

// Returns the spectra of air that is given at `wavelengths`. After an interruption they must not be
// used.
Spectra sky_spectra(const config::Atmosphere& atmosphere,
                    const std::vector<config::Length>& wavelengths,
                    const std::vector<SpectrumView>& views, const BakeOptions& options,
                    SpectrumRays rays = SpectrumRays::in_rows);

// Returns the spectra at other wavelengths, by lines; beyond their ends they are constant.
Spectra at_wavelengths(const Spectra& spectra, const std::vector<config::Length>& wavelengths);

}  // namespace skybake
