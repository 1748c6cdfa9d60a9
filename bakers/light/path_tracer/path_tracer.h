// The reference of all references: radiance of the sky by tracing paths of light, all orders, each
// layer with its own phase function.
//
// Unbiased in all orders that are walked, but for the depths of air_shells.h (2e-7); no radiance is
// clamped. Orders count every event of a path, in the air or on the ground. The same bits for any
// number of threads.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/path_walk.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

struct PathTracerSettings {
    std::uint64_t seed = 0;
    std::uint32_t ray = 0;   // rays of one seed have random numbers of their own
    std::int64_t paths = 0;  // at least 2; each serves all channels
    // The first order from the quadrature of sky_radiance.h (within 2e-4 of its value), of which no
    // error is counted; not for a sun with a disc.
    bool deterministic_first_order = true;
    double sun_radius = 0;  // in radians
    // Whether a ray that hits the ground sees it, that is to say light that came from there last.
    bool include_seen_ground = true;
};

// Per channel; in 1/sr for a solar irradiance of 1, or the unit that the function says.
struct PathTracedRadiance {
    Spectrum radiance{};
    Spectrum standard_error{};                   // of the radiance
    std::array<Spectrum, kPathOrders> orders{};  // 1 to 5, 6 and more
};

class PathTracer {
  public:
    // `medium` must outlive it.
    explicit PathTracer(const SkyMedium& medium) : walker_(medium) {}
    const PathWalker& walker() const { return walker_; }

  private:
    PathWalker walker_;
};

// Radiance along one ray, from an altitude in [0, thickness].
PathTracedRadiance trace_paths(const PathTracer& tracer, double altitude_km, const SunZenith& sun,
                               const SkyDirection& direction, const PathTracerSettings& settings,
                               int threads);

// The same in a sky of radiance 1 all around the planet, without a sun: 1 where nothing absorbs
// (the white furnace). What is seen of that sky itself is in no order.
PathTracedRadiance trace_ambient_paths(const PathTracer& tracer, double altitude_km,
                                       double cos_zenith, const PathTracerSettings& settings,
                                       int threads);

// Mean over all directions of the light at a point that has had at least one event:
// 1/4pi integral of L. Its order n is the light after n events, all of them by paths.
PathTracedRadiance trace_mean_radiance(const PathTracer& tracer, double altitude_km,
                                       const SunZenith& sun, const PathTracerSettings& settings,
                                       int threads);

}  // namespace skybake
