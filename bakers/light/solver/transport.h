// One more order of scattering: from the light at every level and for every sun to what of it is
// scattered, or reflected by the ground, once more.
//
// Along a ray of azimuth phi from the sun the point after x km is turned by gamma about the
// planet's centre; the sun stands there at
//
//   mu_s' = cos gamma mu_s + sin gamma sin theta_s cos phi
//
// and the ray's azimuth phi' from it has sin theta_s' cos phi' = cos gamma sin theta_s cos phi -
// sin gamma mu_s. The light between suns is Lagrange's cubic through four columns, linear where it
// falls too fast for that; between levels it is linear.
#pragma once

#include <vector>

#include "bakers/light/solver/light_moments.h"
#include "bakers/light/solver/ray_fan.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// A point on a ray with what multiplies the moments there.
struct TransportNode {
    int level = 0;
    double fraction = 0;
    double turn_cosine = 1;
    double turn_sine = 0;
    int azimuths = 0;         // over half a turn: max(4, degree + 1), or twice as many
    std::size_t weights = 0;  // where its moment_count * kChannelSlots weights begin; of the ground
                              // kChannelSlots
    bool ground = false;
};

struct TransportRay {
    double mu = 0;
    double weight = 0;  // share of the sphere
    std::vector<TransportNode> nodes;
};

// All that light does not change of the rays from one level.
struct LevelTransport {
    std::vector<TransportRay> rays;
    std::vector<double> weights;
};

LevelTransport make_level_transport(const SkyMedium& medium, const RayFan& fan, int degree);

// For the level whose transport it is, the moments of K light into `out` (of one level's size), and
// for the ground, where `sky_irradiance` is not null, the sky's irradiance. `steep[column]` is 1
// where light between that column and the next must be taken as linear. The same bits for any
// vector width.
void apply_transport(const LevelTransport& transport, const SunAxis& suns,
                     const std::vector<double>& steep, const LightField& light, double* out,
                     double* sky_irradiance);

}  // namespace skybake
