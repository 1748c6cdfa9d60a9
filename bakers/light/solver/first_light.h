// The light that was scattered or reflected once, with every layer's true phase function. All
// further orders start from it.
//
// Along a ray of fixed azimuth sunlight is taken as linear between the bundle's points. Where the
// planet's shadow crosses a cell, it is taken as linear only up to the shadow's edge, where the
// sunlight is that of the ray that grazes the ground: sunlight is discontinuous there, and in thin
// air the jump is large.
#pragma once

#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/light/solver/transport.h"

namespace skybake {

// The phase function of a layer, split for light that was scattered once: the wide part, and the
// moments of the forward peaks of spheres (forward_peak.h).
//
// Light in the peak comes from next to the sun. On the ray to the sun itself each point contributes
// T_sun sigma_s, whatever its distance, since the rest of the path is the one that sunlight would
// have taken. The moments are T_sun tau_s chi_l Y_lm(sun), where tau_s is the layer's scattering
// depth towards the sun and chi_l are the peak's moments. This neglects that the light differs
// within 10 degrees of the sun.
struct SplitPhase {
    WidePhase wide;
    std::vector<Spectrum> peak;  // chi_0 to chi_degree of the peak, chi_0 its share; or empty
    // For a layer with a forward_share: the coefficients of P_0 to P_degree of what is left of its
    // phase function, in 1/sr. It takes the place of `wide`.
    std::vector<Spectrum> series;
    // True if directions of a bundle are too few for the phase function times moments of the degree.
    // Then `peak` has the moments of the whole phase function, and directions contribute by how much
    // more light comes from them than from the sun's direction: T sigma_s along the ray, less T_sun
    // tau_s. What quadrature leaves out of the peak is small where that difference is.
    bool is_taken_from_sun = false;
};

// The largest degree of moments for which the directions of a bundle resolve phase functions.
inline constexpr int kLargestDegreeOfBundles = 10;

// Returns one entry per layer of the medium.
std::vector<SplitPhase> split_phases(const SkyMedium& medium, int degree);
// Returns the same with all phase functions taken from the sun, whatever the degree.
std::vector<SplitPhase> phases_from_sun(const SkyMedium& medium, int degree);

// Returns T_sun tau_s of a layer, for a sun above the horizon; else 0.
Spectrum forward_light(const SkyMedium& medium, const SkyLayer& layer, double altitude_km,
                       double sun_cos_zenith);

// Adds the light in the peaks at an altitude to the moments of one level of a LightField of this
// degree. For the ground `sky_irradiance` is not null, and the light is added to the sky's
// irradiance too.
void add_forward_peaks(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                       double altitude_km, const SunAxis& suns, int degree, double* out,
                       double* sky_irradiance);

// The bundles of rays from one level. Suns below the horizon light high, thin air alone, and look
// like a bright, low arch from below: their bundle has more directions and shorter cells.
struct FirstFans {
    RayFan day;
    RayFan twilight;
    int azimuths = 0;  // over half a turn; 0: as phase functions need them
};

FirstFans make_first_fans(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                          int zenith_nodes, double tolerance);

// Writes the moments at the bundles' level to `out` (one level of a LightField of this degree). For
// the ground `sky_irradiance` is not null and receives the sky's irradiance. The bits are the same
// for any vector width.
void gather_first_light(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                        const FirstFans& fans, const TransmittanceField& sunlight,
                        const SunAxis& suns, int degree, double* out, double* sky_irradiance);

}  // namespace skybake
