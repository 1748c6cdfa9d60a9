// The phase functions of clouds, and how the value that a lookup of a cloud volume returns becomes
// density and extinction.
//
// They are blends of Henyey-Greenstein's and Draine's functions:
//
//   p(u) = (1 - w) HG(g_hg; u) + w D(g_d, alpha; u)                                        1/sr
//   HG(g; u) = 1/4pi (1 - g^2) / (1 + g^2 - 2 g u)^(3/2)
//   D(g, alpha; u) = HG(g; u) (1 + alpha u^2) / (1 + alpha (1 + 2 g^2) / 3)
//
// with u the cosine of the scattering angle. Droplets' w, g_hg, g_d and alpha are functions of their diameter
// that fit Mie's theory for water from 5 to 50 um and any visible wavelength (Jendersie & d'Eon, "An Approximate
// Mie Scattering Function for Fog and Cloud Rendering", SIGGRAPH Talks 2023; Draine 2003).
//
// Ice has g_hg and g_d of two functions of Henyey and Greenstein's, forwards and backwards, that fit rough
// aggregates of columns, whose light has neither bow nor halo (Key, Yang, Baum & Nasiri 2002, "Parameterization of
// shortwave ice cloud optical properties for various particle habits", JGR 107, 4181, 500 to 600 nm).
#pragma once

#include "config/sections/forward.h"

namespace skybake {

struct CloudPhase {
    double hg_g = 0;
    double draine_g = 0;
    double draine_alpha = 0;
    double draine_share = 0;  // w
};

// The fit for 5 <= diameter <= 50 um.
CloudPhase droplet_phase(double diameter_um);

// Crystals of an effective diameter of 50 um; from 20 to 100 um the mean cosine differs by 0.003.
CloudPhase ice_phase();

// A typical value for cumulus (Miles, Verlinde & Clothiaux 2000: effective diameters of 8 to 16
// um).
inline constexpr double kDropletDiameter_um = 12;

CloudPhase cloud_phase(config::CloudParticles particles,
                       double droplet_diameter_um = kDropletDiameter_um);

// Multiplies g_hg, g_d and alpha by `eccentricity` in [0, 1]; 0 gives isotropic scattering.
CloudPhase widened(const CloudPhase& phase, double eccentricity);

// Returns the phase function in 1/sr at the cosine 1 - `offset`. This form stays exact near the
// forward peak.
double phase_value(const CloudPhase& phase, double offset);

// The mean cosine g of the scattering angle.
double mean_cosine(const CloudPhase& phase);

// The share 1 - g of light that is sent back, as two-stream theory counts it.
double backward_share(const CloudPhase& phase);

// How a lookup's value v becomes extinction. If the threshold is applied after filtering,
// extinction is extinction_per_m * v * smoothstep(threshold, threshold + edge_softness, v); else it
// is extinction_per_m * v. Particles scatter all of it.
struct CloudOptics {
    double extinction_per_m = 0;
    bool has_edge = false;
    double threshold = 0;
    double edge_softness = 0;
    config::CloudParticles particles{};
};

CloudOptics cloud_optics(const Cloud& cloud);

// Returns extinction / extinction_per_m for a value in double.
double density(const CloudOptics& optics, double value);

}  // namespace skybake
