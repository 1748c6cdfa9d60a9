// Separates the forward peak of spheres from the rest of their phase function.
//
// Diffraction sends half of the light that large spheres scatter into a cone of about a degree
// around its incoming direction. No ray bundle resolves that, and no small number of Legendre
// moments represents it. Within 10 degrees of the incoming direction the phase function is cut down
// to its value at 10 degrees; the part that is cut off is the peak.
//
// For light that is scattered many times, scattering into the peak may be treated as no scattering
// at all (delta-M: Wiscombe 1977): extinction is reduced by what the peak scatters, and the rest of
// the phase function is wide. The eye sees the peak only in light that is scattered once, which
// therefore keeps the true phase function (Nakajima & Tanaka 1988). Closed forms have no peak in
// this sense and stay whole.
#pragma once

#include "bakers/air/medium.h"

namespace skybake {

// A phase function without its peak.
struct WidePhase {
    LayerPhase phase;                // normalised
    Spectrum share = Spectrum(1.0);  // of the scattered light, per channel
    bool has_peak = false;           // true if a peak was cut off
};

WidePhase without_peak(const LayerPhase& phase);

// Returns the medium in which light that is scattered into a peak counts as not scattered. Layers
// with a peak keep their true phase function as `first_phase`.
SkyMedium without_forward_peaks(SkyMedium medium);

// Returns the same layer without scattering: its extinction is what is left without the peak.
config::Layer without_scattering(config::Layer layer);

}  // namespace skybake
