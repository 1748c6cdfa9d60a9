// The phase function of cloud droplets: a blend of Henyey-Greenstein's and Draine's functions,
// which fits Mie's theory for water droplets of 5 to 50 um and any visible wavelength.
//
//   p(u) = (1 - w) HG(g_hg; u) + w D(g_d, alpha; u)                                        1/sr
//   HG(g; u) = 1/4pi (1 - g^2) / (1 + g^2 - 2 g u)^(3/2)
//   D(g, alpha; u) = HG(g; u) (1 + alpha u^2) / (1 + alpha (1 + 2 g^2) / 3)
//
// with u the cosine of the scattering angle and w, g_hg, g_d, alpha functions of the droplets'
// diameter. Jendersie & d'Eon, "An Approximate Mie Scattering Function for Fog and Cloud
// Rendering", SIGGRAPH Talks 2023; Draine 2003.
#pragma once

namespace skybake {

struct DropletPhase {
    double hg_g = 0;
    double draine_g = 0;
    double draine_alpha = 0;
    double draine_share = 0;  // w
};

// The fit of the paper for 5 <= diameter <= 50 um.
DropletPhase droplet_phase(double diameter_um);

// With g_hg, g_d and alpha times `eccentricity` in [0, 1]: isotropic at 0.
DropletPhase widened(const DropletPhase& phase, double eccentricity);

// In 1/sr, at a cosine of 1 - `offset`, which stays exact near the forward peak.
double phase_value(const DropletPhase& phase, double offset);

// The mean cosine g of scattering angles.
double mean_cosine(const DropletPhase& phase);

}  // namespace skybake
