// The directions and rays over which light at one altitude is gathered.
#pragma once

#include <vector>

#include "bakers/air/medium.h"

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

}  // namespace skybake
