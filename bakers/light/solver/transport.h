// The directions and rays over which light at one altitude is gathered.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// A point on a ray. Light there is (1 - fraction) of that of `level` and `fraction` of the next.
struct FanPoint {
    double distance_km = 0;
    double altitude_km = 0;
    int level = 0;
    double fraction = 0;
};

// A ray in cells between neighbouring points, with the integrals of T sigma_s over each, of each
// layer, times hat functions: near of the cell's begin, far of its end. Scattering, absorption and
// what goes on add up to what enters, cell by cell, to rounding: a medium that absorbs nothing
// loses nothing, however often light is scattered in it.
struct FanRay {
    double mu = 0;
    double sine = 0;
    double weight = 0;  // share of the sphere of directions; they sum to 1
    bool hits_ground = false;
    double length_km = 0;
    std::vector<FanPoint> points;
    std::vector<Spectrum> near;  // cell * layers + layer
    std::vector<Spectrum> far;
    Spectrum end_transmittance{};  // of the whole ray
};

struct RayFan {
    double altitude_km = 0;
    std::vector<FanRay> rays;
};

// From levels_km[level]. Gauss' rule with about 2 `zenith_nodes` directions in three parts: to the
// ground, the limb between horizon and horizontal, and above; `tolerance` as of refine_view_ray.
RayFan make_ray_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                    int zenith_nodes, double tolerance);

// --- Transport -----------------------------------------------------------------------------------

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
