#include "bakers/assets/cloud_light/cloud_paths.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_range.h"
#include "config/assets/occupancy_filter.h"
#include "config/sections/layer.h"

namespace skybake::cloud_light {
namespace {

constexpr int kMajorantCell = 4;  // voxels along each edge of a majorant's cell
constexpr int kSunDensities = 6;  // of n = 1, 2, 4 ... scatterings in the peak
constexpr double kSphere = 4 * std::numbers::pi;
// Paths that are worth less end with a probability.
constexpr double kSureWeight = 0.5;

// 1 - cosine and 1 + cosine of the angle between unit vectors, without cancellation.
ScatteringAngle angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 apart = a - b;
    const glm::dvec3 together = a + b;
    return {0.5 * glm::dot(apart, apart), 0.5 * glm::dot(together, together)};
}

double value_of(const PhaseFunction& phase, const ScatteringAngle& angle) {
    return skybake::phase_value(phase, angle.one_minus, angle.one_plus);
}

glm::dvec3 scattered(const PhaseFunction& phase, const glm::dvec3& direction,
                     RandomStream& random) {
    const ScatteringAngle angle = sample_phase(phase, random.next(), random);
    return scatter(direction, angle, random.next());
}

const PhaseFunction& chosen_lobe(const CloudScattering& scattering, double share) {
    for (const ScatteringLobe& lobe : scattering.lobes) {
        if (share < lobe.share) return lobe.phase;
        share -= lobe.share;
    }
    return scattering.lobes.back().phase;  // rounding
}

// n scatterings by Henyey and Greenstein's function with g have that of g^n.
std::vector<PhaseFunction> densities_about_sun(const CloudScattering& scattering) {
    double g = 0;
    for (const ScatteringLobe& lobe : scattering.lobes) g = std::max(g, lobe.phase.g);
    std::vector<PhaseFunction> densities;
    for (int i = 0; i < kSunDensities; ++i) {
        densities.push_back(make_phase_function(config::Phase::henyey_greenstein, g));
        g *= g;
    }
    return densities;
}

// A flight from cell to cell. Places stay within the tile.
struct Flight {
    glm::dvec3 place;
    glm::dvec3 along;  // voxels per metre
    std::array<int, 3> cell{};

    Flight(const CloudLayer& layer, const glm::dvec3& from, const glm::dvec3& direction)
        : place(from), along(in_voxels(layer, direction)) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (a < 2) place[a] -= layer.size[a] * std::floor(place[a] / layer.size[a]);
            const int last = (layer.size[a] - 1) / kMajorantCell;
            cell[a] = std::clamp(static_cast<int>(place[a] / kMajorantCell), 0, last);
        }
    }
    // Returns the metres to the cell's face, and the axis of it.
    double to_face(const CloudLayer& layer, std::size_t& axis) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < 3; ++a) {
            if (along[a] == 0) continue;
            const int face = along[a] > 0 ? std::min((cell[a] + 1) * kMajorantCell, layer.size[a])
                                          : cell[a] * kMajorantCell;
            const double distance = std::max((face - place[a]) / along[a], 0.0);
            if (distance < nearest) {
                nearest = distance;
                axis = a;
            }
        }
        return nearest;
    }
    // Enters the cell beyond a face. Returns false if it has left the layer.
    bool cross(const CloudLayer& layer, const std::array<int, 3>& cells, double distance,
               std::size_t axis) {
        place += along * distance;
        const bool rises = along[axis] > 0;
        int& k = cell[axis];
        k += rises ? 1 : -1;
        if (axis == 2) {
            place.z = rises ? std::min(k * kMajorantCell, layer.size[2]) : (k + 1) * kMajorantCell;
            return k >= 0 && k < cells[2];
        }
        if (k == cells[axis]) k = 0;
        if (k < 0) k = cells[axis] - 1;
        place[axis] =
            rises ? k * kMajorantCell : std::min((k + 1) * kMajorantCell, layer.size[axis]);
        return true;
    }
};

}  // namespace

CloudPaths::CloudPaths(const CloudLayer& layer, const CloudScattering& scattering,
                       const LayerSources& sources, int threads)
    : layer_(layer),
      scattering_(scattering),
      sources_(sources),
      about_sun_(densities_about_sun(scattering)) {
    const auto ranges = occupancy::cell_ranges(layer.values.data(), {layer.size, kMajorantCell},
                                               config::OccupancyFilter::trilinear, threads);
    cells_ = ranges.size;
    for (const float most : ranges.maximum) {
        // A density grows with the value. Filters in double may exceed a float by rounding.
        constexpr double kRounding = 1 + 1e-6;
        majorants_.push_back(kRounding * layer.optics.extinction_per_m *
                             density(layer.optics, double{most}));
    }
}

// Goes to the next collision. Returns false if the flight leaves the layer.
bool CloudPaths::fly(glm::dvec3& place, const glm::dvec3& direction, RandomStream& random) const {
    Flight flight(layer_, place, direction);
    double depth = -logarithm(random.next());  // left to the next collision with m
    for (;;) {
        const double majorant =
            majorants_[occupancy::index_of(cells_, flight.cell[0], flight.cell[1], flight.cell[2])];
        std::size_t axis = 0;
        double to_face = flight.to_face(layer_, axis);
        while (depth < majorant * to_face) {
            const double way = depth / majorant;
            flight.place += flight.along * way;
            to_face -= way;
            if (random.next() * majorant < extinction_at(layer_, flight.place)) {
                place = flight.place;
                return true;
            }
            depth = -logarithm(random.next());
        }
        depth -= majorant * to_face;
        if (!flight.cross(layer_, cells_, to_face, axis)) return false;
    }
}

double CloudPaths::density_about_sun(const glm::dvec3& direction) const {
    const ScatteringAngle angle = angle_between(direction, sources_.sun_direction);
    double sum = 0;
    for (const PhaseFunction& phase : about_sun_) sum += value_of(phase, angle);
    return sum / kSunDensities;
}

double CloudPaths::draw_direction(double share, RandomStream& random, glm::dvec3& direction) const {
    const bool has_sun = sources_.sun > 0;
    const bool about_sun = has_sun && share < 0.5;
    if (has_sun) share = 2 * share - (about_sun ? 0 : 1);
    if (about_sun) {
        const auto density = static_cast<std::size_t>(share * kSunDensities);
        direction = scattered(about_sun_[density], sources_.sun_direction, random);
    } else {
        direction = scatter({0, 0, 1}, {2 * (1 - share), 2 * share}, random.next());
    }
    if (!has_sun) return 1 / kSphere;
    return 0.5 * (1 / kSphere + density_about_sun(direction));
}

// Ends some of the paths that are worth little; those that go on are worth more.
bool CloudPaths::survives(Particle& particle, RandomStream& random) const {
    const double sun = sources_.sun > 0 ? kSphere * density_about_sun(particle.direction) : 0;
    const double worth = particle.weight * (1 + sun);
    if (worth >= kSureWeight) return true;
    if (random.next() >= worth) return false;
    particle.weight /= worth;
    return true;
}

void CloudPaths::add_sunlight(const Particle& particle, RandomStream& random,
                              TracedRadiance& sum) const {
    glm::dvec3 place = particle.place;
    if (fly(place, sources_.sun_direction, random)) return;
    const ScatteringAngle angle = angle_between(particle.direction, sources_.sun_direction);
    const double light =
        particle.weight * sources_.sun * phase_value(scattering_, angle.one_minus, angle.one_plus);
    (particle.order == 1 ? sum.first : sum.higher) += light;
}

bool CloudPaths::choose_directions(Particle& particle, std::vector<Particle>& waiting,
                                   RandomStream& random) const {
    const glm::dvec3 before = particle.direction;
    particle.direction = scattered(chosen_lobe(scattering_, random.next()), before, random);
    if (sources_.sun > 0) {
        const auto share = [&](const glm::dvec3& direction) {  // p / (p + q)
            const ScatteringAngle angle = angle_between(before, direction);
            const double p = phase_value(scattering_, angle.one_minus, angle.one_plus);
            return p / (p + density_about_sun(direction));
        };
        Particle other = particle;
        const auto density = static_cast<std::size_t>(random.next() * kSunDensities);
        other.direction = scattered(about_sun_[density], sources_.sun_direction, random);
        other.weight *= share(other.direction);
        if (survives(other, random)) waiting.push_back(other);
        particle.weight *= share(particle.direction);
    }
    return survives(particle, random);
}

double CloudPaths::light_from(const glm::dvec3& direction) const {
    if (direction.z <= 0) return sources_.ground;
    return sources_.sky_shape ? sources_.sky * sources_.sky_shape(direction) : sources_.sky;
}

void CloudPaths::walk_on(Particle particle, std::vector<Particle>& waiting, RandomStream& random,
                         TracedRadiance& sum, std::int64_t most_collisions) const {
    do {
        if (!fly(particle.place, particle.direction, random)) {
            const double light = light_from(particle.direction);
            (particle.order == 0 ? sum.seen : sum.higher) += particle.weight * light;
            return;
        }
        ++particle.order;
        ++sum.collisions;
        particle.weight *= scattering_.albedo;
        if (sources_.sun > 0) add_sunlight(particle, random, sum);
    } while (sum.collisions < most_collisions && choose_directions(particle, waiting, random));
}

void CloudPaths::walk(const glm::dvec3& place, const glm::dvec3& direction, RandomStream& random,
                      TracedRadiance& sum, std::int64_t most_collisions) const {
    std::vector<Particle> waiting = {{place, direction, 1, 0}};
    while (!waiting.empty() && sum.collisions < most_collisions) {
        const Particle next = waiting.back();
        waiting.pop_back();
        walk_on(next, waiting, random, sum, most_collisions);
    }
}

TracedRadiance CloudPaths::trace(const glm::dvec3& place, const glm::dvec3& direction, int paths,
                                 std::uint64_t seed, std::uint32_t ray) const {
    assert(paths >= 2);
    TracedRadiance sum;
    double squares = 0;
    for (int i = 0; i < paths; ++i) {
        RandomStream random(seed, ray, static_cast<std::uint64_t>(i));
        TracedRadiance one;
        walk(place, direction, random, one);
        sum.seen += one.seen;
        sum.first += one.first;
        sum.higher += one.higher;
        sum.collisions += one.collisions;
        squares += one.sum() * one.sum();
    }
    const double mean = sum.sum() / paths;
    const double variance = std::max(squares / paths - mean * mean, 0.0);
    return {sum.seen / paths, sum.first / paths, sum.higher / paths,
            std::sqrt(variance / (paths - 1)), sum.collisions};
}

}  // namespace skybake::cloud_light
