#include "bakers/light/path_tracer/path_tracer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "bakers/light/path_tracer/path_batch.h"
#include "bakers/light/path_tracer/path_numbers.h"
#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

// Replicates of an estimate, each by points of its own scrambling: how far their means scatter is
// the standard error, known to 18 % of itself.
constexpr auto kReplicates = static_cast<std::int64_t>(kPathReplicates);
constexpr std::int64_t kPathsPerBlock = 1024;
// Random paths that find out what weight is usual: few find a mean well enough. They are no part of
// the estimate: their numbers come from an address that no estimate reaches.
constexpr std::int64_t kMostPilotPaths = 256;
constexpr std::int64_t kLeastPilotPaths = 32;
constexpr std::uint64_t kPilotAddress = std::uint64_t{1} << 63;

// Where paths begin: all in one direction, or each in a direction of its own, which is spread
// evenly over the sphere, or over the upper half of it in proportion to the cosine of the zenith
// angle.
enum class Aperture { ray, sphere, level_surface };

struct Sensor {
    const PathMedium& medium;
    PathSource source;
    PathStart start;
    Aperture aperture;
    PathRules rules;
    const PathTracerSettings& settings;
    PathMedium::Flight first{};  // of all paths, if they begin in one direction
};

ScatteringAngle zenith_angle(Aperture aperture, double share) {
    if (aperture == Aperture::sphere) return {2 * share, 2 * (1 - share)};
    return lambert_angle(share);
}

// Sets a batch's starts; where directions differ they take the next two numbers of each path.
void set_starts(const Sensor& sensor, PathBatch& batch) {
    batch.starts.fill(sensor.start);
    if (sensor.aperture == Aperture::ray) {
        batch.first = &sensor.first;
        return;
    }
    std::array<ScatteringAngle, PathBatch::kPaths> angles;
    batch.numbers.go_on();
    for (std::size_t i = 0; i < batch.numbers.count(); ++i) {
        angles[i] = zenith_angle(sensor.aperture, batch.numbers.of(i));
    }
    batch.numbers.go_on();
    for (std::size_t i = 0; i < batch.numbers.count(); ++i) {
        batch.starts[i].direction = scatter(sensor.start.up, angles[i], batch.numbers.of(i));
    }
}

void walk(const Sensor& sensor, PathBatch& batch) {
    set_starts(sensor, batch);
    walk_batch(sensor.medium, sensor.source, sensor.rules, batch);
}

std::size_t channels_of(const Sensor& sensor) {
    return static_cast<std::size_t>(sensor.medium.sky().air.channels);
}

RandomStream random_of(const Sensor& sensor, std::uint64_t path) {
    return {sensor.settings.seed, sensor.settings.ray, path};
}

// Calls walk(begin, end) for parts of [begin, end), each as many paths as a batch holds.
template <class Walk>
void for_each_batch(std::int64_t begin, std::int64_t end, const Walk& walk) {
    constexpr auto kPaths = static_cast<std::int64_t>(PathBatch::kPaths);
    for (; begin < end; begin += kPaths) walk(begin, std::min(begin + kPaths, end));
}

Spectrum usual_weight(const Sensor& sensor) {
    const std::int64_t count =
        std::clamp(sensor.settings.paths / 16, kLeastPilotPaths, kMostPilotPaths);
    Spectrum sum{};
    for_each_batch(0, count, [&](std::int64_t begin, std::int64_t end) {
        std::vector<RandomStream> random;
        for (std::int64_t i = begin; i < end; ++i) {
            random.push_back(random_of(sensor, kPilotAddress + static_cast<std::uint64_t>(i)));
        }
        PathBatch batch{BatchNumbers(std::move(random))};
        for (std::size_t i = 0; i < batch.numbers.count(); ++i) {
            batch.heroes[i] = (static_cast<std::size_t>(begin) + i) % channels_of(sensor);
        }
        walk(sensor, batch);
        for (std::size_t i = 0; i < batch.numbers.count(); ++i) sum += batch.second_flight[i];
    });
    return (1 / static_cast<double>(count)) * sum;
}

// A part of a replicate's paths.
struct Block {
    std::int64_t replicate = 0;
    std::int64_t begin = 0;
    std::int64_t end = 0;
};

void add_light(const PathLight& from, PathLight& to) {
    to.direct += from.direct;
    to.flights += from.flights;
    for (std::size_t n = 0; n < kPathOrders; ++n) to.orders[n] += from.orders[n];
}

// The first number of a path chooses its hero.
PathLight walk_block(const Sensor& sensor, const Block& block) {
    const ScrambledPoints points(sensor.settings.seed, sensor.settings.ray,
                                 static_cast<std::uint32_t>(block.replicate));
    const auto channels = static_cast<double>(channels_of(sensor));
    PathLight sum;
    for_each_batch(block.begin, block.end, [&](std::int64_t begin, std::int64_t end) {
        std::vector<RandomStream> random;
        for (std::int64_t path = begin; path < end; ++path) {
            const std::int64_t address = path * kReplicates + block.replicate;
            random.push_back(random_of(sensor, static_cast<std::uint64_t>(address)));
        }
        PathBatch batch{BatchNumbers(points, static_cast<std::uint32_t>(begin), std::move(random))};
        batch.numbers.go_on();
        for (std::size_t i = 0; i < batch.numbers.count(); ++i) {
            batch.heroes[i] = static_cast<std::size_t>(batch.numbers.of(i) * channels);
        }
        walk(sensor, batch);
        for (std::size_t i = 0; i < batch.numbers.count(); ++i) add_light(batch.light[i], sum);
    });
    return sum;
}

// Returns the blocks of all replicates, one replicate after the other.
std::vector<Block> blocks_of(std::int64_t paths_of_replicate) {
    std::vector<Block> blocks;
    for (std::int64_t replicate = 0; replicate < kReplicates; ++replicate) {
        for (std::int64_t begin = 0; begin < paths_of_replicate; begin += kPathsPerBlock) {
            blocks.push_back(
                {replicate, begin, std::min(begin + kPathsPerBlock, paths_of_replicate)});
        }
    }
    return blocks;
}

Spectrum all_light(const PathLight& light) {
    Spectrum sum = light.direct;
    for (const Spectrum& order : light.orders) sum += order;
    return sum;
}

PathTracedRadiance mean_of_replicates(const std::vector<PathLight>& replicates,
                                      std::int64_t paths_of_replicate) {
    PathLight all;
    for (const PathLight& replicate : replicates) add_light(replicate, all);
    const auto count = static_cast<double>(paths_of_replicate * kReplicates);
    PathTracedRadiance result;
    result.flights = static_cast<double>(all.flights) / count;
    result.walked = all_light(all) / count;
    result.radiance = result.walked;
    for (std::size_t n = 0; n < kPathOrders; ++n) {
        result.orders[n] = all.orders[n] / count;
    }
    for (std::size_t i = 0; i < replicates.size(); ++i) {
        result.replicates[i] = all_light(replicates[i]) / static_cast<double>(paths_of_replicate);
    }
    result.standard_error = standard_error_of(result.replicates, result.radiance);
    return result;
}

PathTracedRadiance trace(Sensor sensor, int threads) {
    if (sensor.aperture == Aperture::ray) {
        sensor.first = sensor.medium.first_flight(sensor.start, sensor.rules);
    }
    sensor.rules.usual_weight = usual_weight(sensor);
    const std::int64_t paths = (sensor.settings.paths + kReplicates - 1) / kReplicates;
    const std::vector<Block> blocks = blocks_of(paths);
    std::vector<PathLight> light(blocks.size());
    parallel_for(static_cast<int>(blocks.size()), threads, [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        light[k] = walk_block(sensor, blocks[k]);
    });
    std::vector<PathLight> replicates(kReplicates);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        add_light(light[i], replicates[static_cast<std::size_t>(blocks[i].replicate)]);
    }
    return mean_of_replicates(replicates, paths);
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

// Walks for all orders.
PathTracedRadiance walk_all(const PathMedium& medium, const PathSource& source,
                            const PathStart& start, Aperture aperture,
                            const PathTracerSettings& settings, int threads) {
    assert(settings.paths >= 1);
    return trace({medium, source, start, aperture, {true, settings.include_seen_ground}, settings},
                 threads);
}

}  // namespace

Spectrum standard_error_of(const std::array<Spectrum, kPathReplicates>& replicates,
                           const Spectrum& mean) {
    Spectrum squares{};
    for (const Spectrum& replicate : replicates) {
        const Spectrum apart = replicate - mean;
        squares += apart * apart;
    }
    Spectrum error{};
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        error[c] = std::sqrt(squares[c] / (kReplicates * (kReplicates - 1)));
    }
    return error;
}

PathTracedRadiance trace_paths(const PathMedium& medium, double altitude_km, const SunZenith& sun,
                               const SkyDirection& direction, const PathTracerSettings& settings,
                               int threads) {
    assert(settings.paths >= 1);
    const SkyMedium& sky = medium.sky();
    const CameraRay ray = camera_ray(shell_of(sky.air), altitude_km, sun, direction);
    const double length_km = settings.length_km - ray.distance_km;
    const bool meets_air = ray.in_air.length_km > 0 || ray.in_air.meets_ground;
    if (!(length_km > 0 && meets_air)) return {};
    const bool walks_first = !settings.deterministic_first_order || settings.sun_radius > 0;
    PathStart start = {{0, 0, 1}, view_vector(sun, direction), ray.in_air.altitude_km, length_km};
    start.up = up_at(shell_of(sky.air), altitude_km, ray.distance_km, start.direction);
    PathTracedRadiance result = trace({medium,
                                       {false, sun_vector(sun), settings.sun_radius},
                                       start,
                                       Aperture::ray,
                                       {walks_first, settings.include_seen_ground},
                                       settings},
                                      threads);
    if (walks_first) return result;
    const SkyIntegrator integrator(sky, nullptr);
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

PathTracedRadiance trace_ambient_paths(const PathMedium& medium, double altitude_km,
                                       double cos_zenith, const PathTracerSettings& settings,
                                       int threads) {
    assert(cos_zenith >= -1 && cos_zenith <= 1);
    const double sine = std::sqrt((1 - cos_zenith) * (1 + cos_zenith));
    const PathStart start = {{0, 0, 1}, {sine, 0, cos_zenith}, altitude_km};
    return walk_all(medium, {true, {}, 0}, start, Aperture::ray, settings, threads);
}

PathTracedRadiance trace_mean_radiance(const PathMedium& medium, double altitude_km,
                                       const SunZenith& sun, const PathTracerSettings& settings,
                                       int threads) {
    return walk_all(medium, {false, sun_vector(sun), settings.sun_radius},
                    {{0, 0, 1}, {0, 0, 1}, altitude_km}, Aperture::sphere, settings, threads);
}

PathTracedRadiance trace_irradiance(const PathMedium& medium, double altitude_km,
                                    const SunZenith& sun, const PathTracerSettings& settings,
                                    int threads) {
    PathTracedRadiance result =
        walk_all(medium, {false, sun_vector(sun), settings.sun_radius},
                 {{0, 0, 1}, {0, 0, 1}, altitude_km}, Aperture::level_surface, settings, threads);
    result.radiance = std::numbers::pi * result.radiance;
    result.walked = result.radiance;
    result.standard_error = std::numbers::pi * result.standard_error;
    for (Spectrum& order : result.orders) order = std::numbers::pi * order;
    for (Spectrum& mean : result.replicates) mean = std::numbers::pi * mean;
    return result;
}

}  // namespace skybake
