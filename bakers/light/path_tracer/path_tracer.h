// The reference for all other computations of sky radiance: it traces paths of light, with all
// orders of scattering and each layer's own phase function.
//
// The result is unbiased in all orders that are walked, except for the error of the depths of
// air_shells.h (2e-7); no radiance is clamped. An order counts every event of a path, in the air or
// on the ground. The bits are the same for any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/path_medium.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

struct PathTracerSettings {
    std::uint64_t seed = 0;
    std::uint32_t ray = 0;  // rays of one seed have random numbers of their own
    // At least 1; each serves all channels. Their number is rounded up to the next multiple of 16,
    // the number of replicates from which the standard error follows.
    std::int64_t paths = 0;
    // Takes the first order from the quadrature of sky_radiance.h (within 2e-4 of its value), whose
    // error is not counted. A sun with a disc has its first order traced in any case.
    bool deterministic_first_order = true;
    double sun_radius = 0;  // in radians
    // True if a ray that hits the ground sees it, that is, includes light that came from there
    // last.
    bool include_seen_ground = true;
    // Light that the air scatters beyond this distance along the ray is not counted, and neither is
    // the ground there.
    double length_km = std::numeric_limits<double>::infinity();
};

// Paths fall into so many parts, each evenly spread by itself, from which the standard error follows.
inline constexpr std::size_t kPathReplicates = 16;

// Radiance per channel, in 1/sr for a solar irradiance of 1 unless a function states another unit.
struct PathTracedRadiance {
    Spectrum radiance{};
    Spectrum standard_error{};  // of the radiance
    Spectrum walked{};          // its part that was found by paths
    std::array<Spectrum, kPathReplicates>
        replicates{};                            // means of `walked` over parts of the paths
    std::array<Spectrum, kPathOrders> orders{};  // 1 to 5, 6 and more
    double flights = 0;                          // of a path, in the mean: what it costs
};

// Returns the standard error of the mean of the replicates, which is `mean`.
Spectrum standard_error_of(const std::array<Spectrum, kPathReplicates>& replicates,
                           const Spectrum& mean);

// Returns the radiance along one ray. A ray from space that passes above the air sees nothing.
PathTracedRadiance trace_paths(const PathMedium& medium, double altitude_km, const SunZenith& sun,
                               const SkyDirection& direction, const PathTracerSettings& settings,
                               int threads);

// Returns the same in a sky of radiance 1 all around the planet, without a sun: 1 where nothing
// absorbs (the white furnace). Light that comes from that sky without any event belongs to no
// order.
PathTracedRadiance trace_ambient_paths(const PathMedium& medium, double altitude_km,
                                       double cos_zenith, const PathTracerSettings& settings,
                                       int threads);

// Returns the mean over all directions of the light at a point that has had at least one event:
// 1/4pi times the integral of L. Its order n is the light after n events. All orders are traced by
// paths.
PathTracedRadiance trace_mean_radiance(const PathMedium& medium, double altitude_km,
                                       const SunZenith& sun, const PathTracerSettings& settings,
                                       int threads);

// Returns the irradiance of a level surface that faces up, by the sky without the sun's disc. All
// orders are traced by paths.
PathTracedRadiance trace_irradiance(const PathMedium& medium, double altitude_km,
                                    const SunZenith& sun, const PathTracerSettings& settings,
                                    int threads);

}  // namespace skybake
