// The bundle of rays over which light at one altitude is gathered, and the transport of light along
// it: one more order of scattering.
#pragma once

#include <utility>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/order_blocks.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"

namespace skybake {

// A point on a ray. The light there is (1 - fraction) times that of `level` plus `fraction` times
// that of the next level.
struct FanPoint {
    double distance_km = 0;
    double altitude_km = 0;
    int level = 0;
    double fraction = 0;
};

// A ray, divided into cells between neighbouring points, with the integrals of T sigma_s over each
// cell, for each layer, times hat functions: near is for the hat function of the cell's beginning,
// far for that of its end. Scattering, absorption and the light that goes on add up to the light
// that enters, cell by cell, to rounding: a medium that absorbs nothing loses nothing, however
// often light is scattered in it.
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

// Makes the ray bundle from levels_km[level]. Directions are the nodes of Gauss's rule, about 2
// `zenith_nodes` in all, in three parts: ground rays, limb rays (between horizon and horizontal)
// and upward rays. `tolerance` is that of refine_view_ray.
RayFan make_ray_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                    int zenith_nodes, double tolerance);

// Makes the ray bundle for light that is scattered once while the sun is below the horizon: its
// cells are also refined for twilight (refine_for_twilight).
RayFan make_twilight_fan(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                         int zenith_nodes, double tolerance);

// --- Transport -----------------------------------------------------------------------------------

// Computes one more order of scattering: from the light at every level and for every sun, the part
// of it that is scattered, or reflected by the ground, once more.
//
// Along a ray of azimuth phi from the sun the point after x km is turned by gamma about the
// planet's centre. The sun there is at
//
//   mu_s' = cos gamma mu_s + sin gamma sin theta_s cos phi
//
// and the ray's azimuth phi' from it satisfies sin theta_s' cos phi' = cos gamma sin theta_s cos
// phi - sin gamma mu_s. Between suns the light is interpolated by Lagrange's cubic through four
// columns, and by steep_weights where it falls too fast for that; between levels it is linear.

// How light falls between suns where it falls too fast for cubics.
struct SteepSuns {
    SteepSuns(std::vector<double> of_stencils) : stencils(std::move(of_stencils)) {}  // NOLINT
    // Takes the falls of light at the levels at which transport reads it. Transport is linear in its
    // light, so that they are those of an estimate, and stay the same for all orders.
    void follow(const LightField& estimate);

    std::vector<double> stencils;  // [column]: 1 where the stencil that begins there is steep
    // From each column to the next (fall_between), never above 0. Empty: light is linear.
    std::vector<double> falls;         // [level * suns + column]
    std::vector<double> ground_falls;  // [column], of the sky's irradiance
};

// A point on a ray with the weights that multiply the moments there.
struct TransportNode {
    int level = 0;
    double fraction = 0;
    double turn_cosine = 1;
    double turn_sine = 0;
    int degree = 0;           // of the moments that it scatters (needed_degrees.h)
    int azimuths = 0;         // over half a turn: max(4, degree + 1), or twice as many
    std::size_t weights = 0;  // index of the first of its weights, in blocks like those of the
                              // light (order_blocks.h); a node on the ground has one, of order 0
    bool ground = false;
};

struct TransportRay {
    double mu = 0;
    double weight = 0;  // share of the sphere
    std::vector<TransportNode> nodes;
};

// The parts of the rays from one level that do not depend on the light. Number is float or double
// (order_blocks.h).
template <class Number>
struct LevelTransport {
    std::vector<TransportRay> rays;
    std::vector<MomentBlock<Number>> weights;
};

// How the layers of a medium scatter light.
struct LayerMoments {
    LayerMoments(const SkyMedium& medium, int to_degree);
    // With the degrees that are needed at the altitudes at which light is read.
    LayerMoments(const SkyMedium& medium, int to_degree, const std::vector<double>& altitudes_km);

    int degree;
    std::vector<std::vector<Spectrum>> moments;  // [layer][l], up to the degree
    std::vector<int> degrees;                    // by altitude, or empty if all are `degree`
};

template <class Number>
LevelTransport<Number> make_level_transport(const SkyMedium& medium, const RayFan& fan,
                                            const LayerMoments& layers);

// Writes the moments of K light at the transport's level to `out` (of one level's size). For the
// ground `sky_irradiance` is not null and receives the sky's irradiance. The bits are the same for
// any vector width.
void apply_transport(const LevelTransport<float>& transport, const SunAxis& suns,
                     const SteepSuns& steep, const BlockedLight<float>& light, double* out,
                     double* sky_irradiance);
void apply_transport(const LevelTransport<double>& transport, const SunAxis& suns,
                     const SteepSuns& steep, const BlockedLight<double>& light, double* out,
                     double* sky_irradiance);

// Computes K light by the transports of all levels of `image`. `light` is at the altitudes that the
// transports' rays were made for.
template <class Number>
void apply_transports(const std::vector<LevelTransport<Number>>& transports, const SunAxis& suns,
                      const SteepSuns& steep, const BlockedLight<Number>& light, int threads,
                      LightField& image);

}  // namespace skybake
