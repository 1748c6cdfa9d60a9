#include "bakers/light/path_tracer/path_tracer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"

namespace skybake {

namespace {

constexpr std::int64_t kPathsPerBlock = 1024;
// Paths that find out what weight is usual. They are no part of the estimate: their numbers come
// from an address that no estimate reaches.
// An eighth of the paths, within bounds: few find a mean well enough.
constexpr std::int64_t kMostPilotPaths = 512;
constexpr std::int64_t kLeastPilotPaths = 32;
constexpr std::uint64_t kPilotAddress = std::uint64_t{1} << 63;

struct BlockSums {
    PathLight light;
    Channels total{0.0};
    Channels squares{0.0};
};

// Where paths begin: all in one direction, or each in a direction of its own, which is spread
// evenly over the sphere, or over the upper half of it in proportion to the cosine of the zenith
// angle.
enum class Aperture { ray, sphere, level_surface };

struct Sensor {
    const PathWalker& walker;
    PathSource source;
    PathStart start;
    Aperture aperture;
    PathRules rules;
    const PathTracerSettings& settings;
};

// Walks path after path, each from its own random numbers.
class SensorPaths {
  public:
    explicit SensorPaths(const Sensor& sensor)
        : sensor_(sensor),
          start_(sensor.start),
          first_(sensor.walker.first_flight(start_, sensor.rules)) {}

    Channels walk(std::uint64_t path, PathLight& light) {
        RandomStream random(sensor_.settings.seed, sensor_.settings.ray, path);
        if (sensor_.aperture != Aperture::ray) {
            start_.direction = scatter(start_.up, zenith_angle(random.next()), random);
            first_ = sensor_.walker.first_flight(start_, sensor_.rules);
        }
        return sensor_.walker.walk(sensor_.source, start_, first_, sensor_.rules, random, light);
    }

  private:
    ScatteringAngle zenith_angle(double share) const {
        if (sensor_.aperture == Aperture::sphere) return {2 * share, 2 * (1 - share)};
        return lambert_angle(share);
    }

    const Sensor& sensor_;
    PathStart start_;
    PathWalker::Flight first_;
};

Channels usual_weight(const Sensor& sensor) {
    SensorPaths paths(sensor);
    const std::int64_t count =
        std::clamp(sensor.settings.paths / 8, kLeastPilotPaths, kMostPilotPaths);
    Channels sum(0.0);
    for (std::int64_t i = 0; i < count; ++i) {
        PathLight light;
        sum = sum + paths.walk(kPilotAddress + static_cast<std::uint64_t>(i), light);
    }
    return (1 / static_cast<double>(count)) * sum;
}

BlockSums walk_block(const Sensor& sensor, std::int64_t block) {
    SensorPaths paths(sensor);
    BlockSums sums;
    const std::int64_t begin = block * kPathsPerBlock;
    const std::int64_t end = std::min(begin + kPathsPerBlock, sensor.settings.paths);
    for (std::int64_t path = begin; path < end; ++path) {
        PathLight light;
        paths.walk(static_cast<std::uint64_t>(path), light);
        sums.light.flights += light.flights;
        Channels value = light.direct;
        for (std::size_t n = 0; n < kPathOrders; ++n) {
            value = value + light.orders[n];
            sums.light.orders[n] = sums.light.orders[n] + light.orders[n];
        }
        sums.total = sums.total + value;
        sums.squares = sums.squares + value * value;
    }
    return sums;
}

PathTracedRadiance trace(Sensor sensor, int threads) {
    sensor.rules.usual_weight = usual_weight(sensor);
    const std::int64_t paths = sensor.settings.paths;
    const std::int64_t blocks = (paths + kPathsPerBlock - 1) / kPathsPerBlock;
    std::vector<BlockSums> sums(static_cast<std::size_t>(blocks));
    parallel_for(static_cast<int>(blocks), threads, [&](int block) {
        sums[static_cast<std::size_t>(block)] = walk_block(sensor, block);
    });
    BlockSums all;
    for (const BlockSums& block : sums) {
        all.total = all.total + block.total;
        all.squares = all.squares + block.squares;
        all.light.flights += block.light.flights;
        for (std::size_t n = 0; n < kPathOrders; ++n) {
            all.light.orders[n] = all.light.orders[n] + block.light.orders[n];
        }
    }
    PathTracedRadiance result;
    const auto count = static_cast<double>(paths);
    result.flights = static_cast<double>(all.light.flights) / count;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const double mean = all.total[c] / count;
        const double variance = all.squares[c] / count - mean * mean;
        result.radiance[c] = mean;
        result.standard_error[c] = std::sqrt(std::max(variance, 0.0) / (count - 1));  // rounding
        for (std::size_t n = 0; n < kPathOrders; ++n) {
            result.orders[n][c] = all.light.orders[n][c] / count;
        }
    }
    return result;
}

// The sun in the plane of x and z, z up.
glm::dvec3 sun_vector(const SunZenith& sun) { return {sun.sine, 0, sun.cosine}; }

glm::dvec3 view_vector(const SunZenith& sun, const SkyDirection& direction) {
    const double sine_squared = std::max((1 - direction.mu) * (1 + direction.mu), 0.0);
    const double sine = std::sqrt(sine_squared);
    // A vertical sun is at any azimuth.
    const double along =
        sun.sine > 0 ? (direction.cosine_to_sun - direction.mu * sun.cosine) / sun.sine : sine;
    const double x = std::clamp(along, -sine, sine);  // rounding
    return {x, std::sqrt((sine - x) * (sine + x)), direction.mu};
}

// The vertical at a point of a ray that begins where the vertical is z.
glm::dvec3 up_at(const Shell& shell, double altitude_km, double distance_km,
                 const glm::dvec3& direction) {
    const glm::dvec3 place =
        (shell.ground_radius_km + altitude_km) * glm::dvec3{0, 0, 1} + distance_km * direction;
    return place / glm::length(place);
}

}  // namespace

PathTracedRadiance trace_paths(const PathTracer& tracer, double altitude_km, const SunZenith& sun,
                               const SkyDirection& direction, const PathTracerSettings& settings,
                               int threads) {
    assert(settings.paths >= 2);
    const SkyMedium& medium = tracer.walker().medium();
    const CameraRay ray = camera_ray(shell_of(medium.air), altitude_km, sun, direction);
    const double length_km = settings.length_km - ray.distance_km;
    const bool meets_air = ray.in_air.length_km > 0 || ray.in_air.meets_ground;
    if (!(length_km > 0 && meets_air)) return {};
    const bool walks_first = !settings.deterministic_first_order || settings.sun_radius > 0;
    PathStart start = {{0, 0, 1}, view_vector(sun, direction), ray.in_air.altitude_km, length_km};
    start.up = up_at(shell_of(medium.air), altitude_km, ray.distance_km, start.direction);
    PathTracedRadiance result = trace({tracer.walker(),
                                       {false, sun_vector(sun), settings.sun_radius},
                                       start,
                                       Aperture::ray,
                                       {walks_first, settings.include_seen_ground},
                                       settings},
                                      threads);
    if (walks_first) return result;
    const SkyIntegrator integrator(medium, nullptr);
    const SkyRadiance first = length_km < ray.in_air.length_km
                                  ? integrator.up_to(ray.in_air, {length_km}).front()
                                  : integrator.radiance(ray.in_air);
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        result.orders[0][c] =
            first.single[c] + (settings.include_seen_ground ? first.ground[c] : 0);
        result.radiance[c] += result.orders[0][c];
    }
    return result;
}

PathTracedRadiance trace_ambient_paths(const PathTracer& tracer, double altitude_km,
                                       double cos_zenith, const PathTracerSettings& settings,
                                       int threads) {
    assert(settings.paths >= 2 && cos_zenith >= -1 && cos_zenith <= 1);
    const double sine = std::sqrt((1 - cos_zenith) * (1 + cos_zenith));
    const PathStart start = {{0, 0, 1}, {sine, 0, cos_zenith}, altitude_km};
    return trace({tracer.walker(),
                  {true, {}, 0},
                  start,
                  Aperture::ray,
                  {true, settings.include_seen_ground},
                  settings},
                 threads);
}

PathTracedRadiance trace_mean_radiance(const PathTracer& tracer, double altitude_km,
                                       const SunZenith& sun, const PathTracerSettings& settings,
                                       int threads) {
    assert(settings.paths >= 2);
    return trace({tracer.walker(),
                  {false, sun_vector(sun), settings.sun_radius},
                  {{0, 0, 1}, {0, 0, 1}, altitude_km},
                  Aperture::sphere,
                  {true, settings.include_seen_ground},
                  settings},
                 threads);
}

PathTracedRadiance trace_irradiance(const PathTracer& tracer, double altitude_km,
                                    const SunZenith& sun, const PathTracerSettings& settings,
                                    int threads) {
    assert(settings.paths >= 2);
    PathTracedRadiance result = trace({tracer.walker(),
                                       {false, sun_vector(sun), settings.sun_radius},
                                       {{0, 0, 1}, {0, 0, 1}, altitude_km},
                                       Aperture::level_surface,
                                       {true, settings.include_seen_ground},
                                       settings},
                                      threads);
    result.radiance = std::numbers::pi * result.radiance;
    result.standard_error = std::numbers::pi * result.standard_error;
    for (Spectrum& order : result.orders) order = std::numbers::pi * order;
    return result;
}

}  // namespace skybake
