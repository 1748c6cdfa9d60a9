// The forward peak of spheres, apart from the rest of their phase function.
//
// Diffraction sends half of what large spheres scatter into a degree or so about the light's way:
// no fan of rays resolves that, and no few Legendre moments hold it. Up to 10 degrees from it the
// phase function is cut down to its value there; what is cut off is the peak.
//
// For light that is scattered again and again the peak may be taken as no scattering at all
// (delta-M: Wiscombe 1977): extinction loses what the peak scatters, and the rest is wide. Only of
// light that is scattered once the eye sees the peak, so that it has the true phase function there
// (Nakajima & Tanaka 1988). Closed forms have no peak in this sense and stay whole.
#pragma once

#include "bakers/air/medium.h"

namespace skybake {

// A phase function without its peak.
struct WidePhase {
    LayerPhase phase;                // normalised
    Spectrum share = Spectrum(1.0);  // of the light that is scattered, per channel
    bool has_peak = false;           // that was cut off
};

WidePhase without_peak(const LayerPhase& phase);

// The medium in which light that goes into a peak goes on. Layers with a peak keep their true
// phase function as `first_phase`.
SkyMedium without_forward_peaks(SkyMedium medium);

// The same of a layer that is to scatter nothing: the extinction that is left of it.
config::Layer without_scattering(config::Layer layer);

}  // namespace skybake
