// The part of a view ray's contribution to multiple scattering that does not depend on the sun: it
// is shared by all sun angles.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/quadrature_rules.h"
#include "bakers/air/ray.h"

namespace skybake {

// A stretch of the ray with its integrals, by three Gauss nodes.
struct RayCell {
    RayBreak from;
    RayBreak to;
    double opacity = 0;    // the largest optical depth of a channel that still brings light
    double variation = 0;  // of extinction, transmittance and direction of the vertical over it
    Spectrum optical_depth{};
    Spectrum near_weight{};  // integral of sigma_s T times the hat function of the cell's begin
    Spectrum far_weight{};   // the same of its end
    Spectrum absorbed{};     // integral of sigma_a T
};

// A ray from an altitude with s = r mu to the ground or to the top, divided into cells.
struct ViewRay {
    double altitude_km = 0;
    double s_km = 0;
    bool hits_ground = false;
    double length_km = 0;
    std::vector<RayCell> cells;  // one after the other; none if the ray has no length
};

// Cuts the ray where it crosses the break altitudes and at its lowest point, and then further until
// no cell that light still reaches is opaque, so that the cell's three nodes sample what it
// scatters.
ViewRay trace_view_ray(const Medium& medium, const std::vector<double>& break_altitudes_km,
                       double altitude_km, double s_km, bool hits_ground);

// Returns the altitude of a point of the ray.
inline double altitude_on(const Shell& shell, const ViewRay& ray, double distance_km) {
    return altitude_in_shell_km(shell, ray.altitude_km, ray.s_km, distance_km);
}

// Rays from one altitude into all directions.
struct RaySphere {
    struct Direction {
        double mu = 0;
        double weight = 0;  // share of the sphere of directions; they sum to 1
        ViewRay ray;
    };
    std::vector<Direction> directions;
    Spectrum whole{};  // scattering over all directions

    // Returns the scattering of which the cells of a direction have shares.
    Spectrum whole_per_ray(const Direction& direction) const {
        return whole / (direction.weight * static_cast<double>(directions.size()));
    }
};

// Traces rays into the directions of each part of the zenith angle by Gauss's rule.
RaySphere trace_all_directions(const Medium& medium, const std::vector<double>& break_altitudes_km,
                               double altitude_km, const std::vector<ZenithPart>& parts);

// Halves cells until (share of the scattering) * variation^2 <= tolerance in each, which bounds the
// error of taking sunlight as linear over a cell. `whole` is the scattering of which shares are
// taken.
void refine_view_ray(const Medium& medium, const Spectrum& whole, double tolerance, ViewRay& ray);

// Halves cells along which the rays of low suns pass at heights that differ by more than `step_km`,
// unless a cell scatters a negligible share. From an altitude h a sun that grazes the ground is seen
// by the sine rho / r below the horizontal (ray.h). Hence over a cell of length x, which begins and
// ends at altitudes that differ by dh, the lowest points of the sun's rays differ by at most
// dh + x rho / r. Refining by shares alone leaves high cells coarse: they scatter little, but behind
// the terminator they are all that is lit.
void refine_for_twilight(const Medium& medium, const Spectrum& whole, double step_km, ViewRay& ray);

// A point on the ray and the weights that multiply the sunlight there. The integral of sigma_s
// T(start, x) f(x) dx is the sum of weight * f over the nodes; it is exact where f is linear over
// each cell. All weights are >= 0.
struct RayNode {
    double altitude_km = 0;
    double distance_km = 0;
    int level = -1;  // index of the break altitude where it lies, or -1
    Spectrum weight{};
};

std::vector<RayNode> nodes_of(const Medium& medium, const ViewRay& ray);

}  // namespace skybake
