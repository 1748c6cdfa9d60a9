// Separates the forward peaks of phase functions from the rest of them.
//
// Diffraction sends half of the light that large spheres scatter into a cone of about a degree
// around its incoming direction. No ray bundle resolves that, and no small number of Legendre
// moments represents it. For light that is scattered many times, scattering into the peak may be
// treated as no scattering at all: extinction is reduced by what the peak scatters, and the rest of
// the phase function is wide. The eye sees the peak only in light that is scattered once, which
// therefore keeps the true phase function (Nakajima & Tanaka 1988).
//
// Two peaks are told apart here. For spheres the phase function is cut down, within 10 degrees of
// the incoming direction, to its value at 10 degrees. For other phase functions, and for what is left
// of spheres, the peak is what moments up to a degree cannot represent: with f the next moment, the
// moments of the rest are (chi_l - f) / (1 - f) (delta-M: Wiscombe 1977).
#pragma once

#include <string>
#include <vector>

#include "bakers/air/medium.h"

namespace skybake {

// A phase function without its peak.
struct WidePhase {
    LayerPhase phase;                // normalised
    Spectrum share = Spectrum(1.0);  // of the scattered light, per channel
    bool has_peak = false;           // true if a peak was cut off
};

// Cuts the peak of spheres off. Closed forms stay whole.
WidePhase without_peak(const LayerPhase& phase);

// True if a layer of spheres scatters light whose peak has not been cut off.
bool has_peaks_of_spheres(const SkyMedium& medium);

// The largest degree of moments with which assets of the sky scatter light again.
inline constexpr int kLargestDegree = 32;

// Returns an estimate of the share of its light that the sky would lack if moments ended at a
// degree, in the worst channel: the sum over layers of the next moment times the zenith depth of
// what the layer scatters, over the depth of all layers where that is above 1.
double light_beyond_degree(const SkyMedium& medium, int degree);

// Light beyond a degree that may be neglected. Earth's haze leaves 0.1 % beyond degree 8, and a sky
// whose solution ends there is 0.2 % off in the median.
inline constexpr double kNegligibleLight = 2e-3;

// Returns the medium in which light that is scattered into a peak counts as not scattered. Layers
// with a peak keep their true phase function as `first_phase`. Closed forms have a peak if moments
// up to kLargestDegree leave out more than kNegligibleLight of the medium.
SkyMedium without_forward_peaks(SkyMedium medium);

// Returns the medium in which no layer scatters light forward more than moments up to a degree
// represent: each layer's forward_share is its moment of the next degree.
SkyMedium delta_scaled(SkyMedium medium, int degree);

// Returns the medium in which only the named layers scatter; the others still dim the light. With
// no names, returns the medium unchanged.
SkyMedium scattering_only(SkyMedium medium, const std::vector<std::string>& layers);

// Returns the depth of what the layer scatters, from a point where r mu_s = `s_km` to the top.
Spectrum scattering_depth(const SkyLayer& layer, double altitude_km, double s_km);

}  // namespace skybake
