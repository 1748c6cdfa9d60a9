#include "bakers/air/particles/particle_scattering.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "bakers/air/particles/angle_nodes.h"
#include "bakers/air/particles/remembered.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/water_refractive_index.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Radii no longer double when their series have more terms than this, angles when terms times pairs
// of angles exceed the other bound: 2 to 4 s on one core.
constexpr double kMostTerms = 1.2e7;
constexpr double kMostWork = 8e9;
constexpr int kFewestRadii = 32;
constexpr int kMostNodes = 1 << 13;

// Size parameters of a group of large spheres, less that of the first (particle_scattering.h).
constexpr std::array<double, 4> kGroup = {0, 1.511, 3.061, 4.572};
constexpr double kLargeSpheres = 700;  // size parameter of what scatters most

struct SizeAverage {
    explicit SizeAverage(ComplexNumber index, int threads) : spheres(index, threads) {}

    WeightedSpheres spheres;
    AngleNodes angles;
    CrossSectionSums sums;
    double per_particle = 1;  // the factor that makes sums means over all particles
    double error = 0;         // of the radii
};

// Adds the spheres from number `first` on to all sums.
void add_spheres(std::size_t first, SizeAverage& average) {
    average.angles.add(average.spheres, first);
    average.sums = average.spheres.cross_sections();
}

// Halves the cells between angles until interpolation is within the accuracy or the work too much.
void refine_angles(SizeAverage& average, double accuracy) {
    AngleNodes& angles = average.angles;
    while (angles.error() > accuracy && angles.cells() < kMostNodes &&
           average.spheres.terms() * angles.summed() < kMostWork) {
        if (!angles.refine(average.spheres, 2, [=](double) { return accuracy; })) return;
    }
}

SizeAverage monodisperse_average(double x, ComplexNumber index, double accuracy, int threads) {
    SizeAverage result(index, threads);
    result.spheres.add(x, 1);
    add_spheres(0, result);
    refine_angles(result, accuracy);
    return result;
}

// Nodes over the logarithm of the radius, dense about the center of what scatters: u = center + s
// sinh t, uniform in t, with s half the width of the peak. The mapping is analytic, so that the
// trapezoidal rule converges as fast as without it; from one tail to the other it needs about half
// as many nodes as uniform ones of the same distance at the center.
class RadiusNodes {
  public:
    RadiusNodes(const RadiusDistribution::LogRange& range, double scale)
        : center_(range.center),
          scale_(scale * range.width),
          first_(-inverse_sinh((range.center - range.first) / scale_)),
          last_(inverse_sinh((range.last - range.center) / scale_)) {}

    struct Node {
        double log_radius;
        double slope;  // d log_radius / d position
    };
    // At a position in [0, 1].
    Node at(double position) const {
        const double grown = exponential(first_ + (last_ - first_) * position);
        return {center_ + 0.5 * scale_ * (grown - 1 / grown),
                0.5 * scale_ * (grown + 1 / grown) * (last_ - first_)};
    }

  private:
    static double inverse_sinh(double x) { return logarithm(x + std::sqrt(x * x + 1)); }

    double center_;
    double scale_;
    double first_;
    double last_;
};

// Half of what the phase function and the cross-sections changed by, relative; all of it where
// radii come in groups.
double error_of_radii(const CrossSectionSums& before, const PhaseHalves& phase_before,
                      const SizeAverage& after, bool groups) {
    // Twice as many nodes have about twice the sum.
    const double worst = std::max({relative_change(2 * before.extinction, after.sums.extinction),
                                   relative_change(2 * before.scattering, after.sums.scattering),
                                   largest_difference(phase_before, after.angles.phase())});
    return groups ? worst : worst / 2;
}

// The rule over radii: adds every step-th of the nodes between the ends, which have no weight to
// speak of unless the distribution has bounds, from the first on.
class RadiusRule {
  public:
    RadiusRule(const RadiusDistribution& distribution, config::Length wavelength)
        : RadiusRule(distribution, wavelength, distribution.scattering_range(wavelength)) {}

    double center() const { return center_; }  // size parameter of what scatters most
    bool has_large_spheres() const { return center_ > kLargeSpheres; }

    void add_nodes(int intervals, int step, WeightedSpheres& to) const {
        for (int i = 1; i < intervals; i += step)
            add_node(static_cast<double>(i) / intervals, 1, to);
    }
    // The ends of a distribution with bounds, which have weight: half that of
    // others.
    void add_ends(WeightedSpheres& to) const {
        if (!distribution_.has_bounds()) return;
        for (const double position : {0.0, 1.0}) add_node(position, 0.5, to);
    }
    void add_groups(int intervals, int step, WeightedSpheres& to) const {
        for (int i = 1; i < intervals; i += step) {
            const auto [u, per_step] = nodes_.at(static_cast<double>(i) / intervals);
            const double x = wave_number_ * exponential(u);
            // The same rule, moved: dx is the same, d ln x is not.
            for (const double distance : kGroup) {
                const double moved = x + distance;
                const double density =
                    distribution_.per_log_radius(logarithm(moved / wave_number_));
                to.add(moved, per_step * x / moved * density / kGroup.size());
            }
        }
    }

  private:
    void add_node(double position, double weight, WeightedSpheres& to) const {
        const auto [u, per_step] = nodes_.at(position);
        to.add(wave_number_ * exponential(u), weight * per_step * distribution_.per_log_radius(u));
    }

    RadiusRule(const RadiusDistribution& distribution, config::Length wavelength,
               const RadiusDistribution::LogRange& range)
        : distribution_(distribution),
          wave_number_(2 * std::numbers::pi / wavelength.meters),
          center_(wave_number_ * exponential(range.center)),
          nodes_(range, has_large_spheres() ? 0.25 : 0.5) {}

    const RadiusDistribution& distribution_;
    double wave_number_;
    double center_;
    RadiusNodes nodes_;
};

// The angles that large spheres need, found with so few of them that their series stay in memory.
// The noise of so few radii stays below the bound, but for the poles, where peaks are narrow.
AngleNodes angles_of_large_spheres(const RadiusRule& rule, ComplexNumber index, int threads) {
    constexpr int kRadii = 256;
    constexpr int kMostCells = 512;
    constexpr double kAccuracy = 0.02;
    constexpr double kPoleAccuracy = 0.002;
    constexpr double kPole = 15;  // x theta
    SizeAverage few(index, threads);
    rule.add_nodes(kRadii, 1, few.spheres);
    add_spheres(0, few);
    // 1 - cos theta = theta^2 / 2 is the fourth power of a node's place.
    const double pole = std::sqrt(kPole / rule.center() / std::numbers::sqrt2);
    const auto accuracy = [&](double place) { return place < pole ? kPoleAccuracy : kAccuracy; };
    while (few.angles.cells() < kMostCells && few.angles.refine(few.spheres, 1, accuracy)) {
    }
    return few.angles.empty();
}

SizeAverage distributed_average(const RadiusDistribution& distribution, config::Length wavelength,
                                ComplexNumber index, double accuracy, int threads) {
    const RadiusRule rule(distribution, wavelength);
    const bool groups = rule.has_large_spheres();
    SizeAverage result(index, threads);
    if (groups) result.angles = angles_of_large_spheres(rule, index, threads);
    const auto add_nodes = [&](int intervals, int step) {
        if (groups) {
            rule.add_groups(intervals, step, result.spheres);
        } else {
            rule.add_nodes(intervals, step, result.spheres);
        }
    };
    rule.add_ends(result.spheres);
    add_nodes(kFewestRadii, 1);
    add_spheres(0, result);
    for (int intervals = 2 * kFewestRadii;; intervals *= 2) {
        const CrossSectionSums before = result.sums;
        const PhaseHalves phase_before = result.angles.phase();
        const std::size_t summed = result.spheres.count();
        add_nodes(intervals, 2);
        add_spheres(summed, result);
        result.error = error_of_radii(before, phase_before, result, groups);
        result.per_particle = 1.0 / intervals;
        if (result.error <= accuracy || 2 * result.spheres.terms() > kMostTerms) break;
    }
    if (!groups) refine_angles(result, accuracy);
    return result;
}

// Linear between entries, constant beyond them.
ComplexNumber tabulated_index(const std::vector<config::IndexPoint>& indices,
                              config::Length wavelength) {
    const auto above = std::ranges::upper_bound(
        indices, wavelength.meters, {},
        [](const config::IndexPoint& point) { return point.wavelength.meters; });
    if (above == indices.begin()) return {above->real, above->imaginary};
    const config::IndexPoint& low = *(above - 1);
    if (above == indices.end()) return {low.real, low.imaginary};
    const double share = (wavelength.meters - low.wavelength.meters) /
                         (above->wavelength.meters - low.wavelength.meters);
    return {low.real + share * (above->real - low.real),
            low.imaginary + share * (above->imaginary - low.imaginary)};
}

}  // namespace

ComplexNumber refractive_index(const config::Particles& particles, config::Length wavelength) {
    if (particles.material == config::ParticleMaterial::water) {
        return water_refractive_index(wavelength);
    }
    if (particles.material == config::ParticleMaterial::tabulated) {
        return tabulated_index(particles.indices, wavelength);
    }
    return {particles.refractive_index, particles.absorption_index};
}

double largest_size_parameter(const config::Particles& particles, config::Length wavelength) {
    const double wave_number = 2 * std::numbers::pi / wavelength.meters;
    if (particles.sizes == config::SizeDistribution::monodisperse) {
        return wave_number * particles.radius.meters;
    }
    const RadiusDistribution distribution(particles);
    return wave_number * exponential(distribution.scattering_range(wavelength).last);
}

ParticleScattering particle_scattering(const config::Particles& particles,
                                       config::Length wavelength, double accuracy, int threads) {
    assert(accuracy >= 1e-6 && accuracy < 1);
    const double wave_number = 2 * std::numbers::pi / wavelength.meters;
    const ComplexNumber index = refractive_index(particles, wavelength);
    SizeAverage average =
        particles.sizes == config::SizeDistribution::monodisperse
            ? monodisperse_average(wave_number * particles.radius.meters, index, accuracy, threads)
            : distributed_average(RadiusDistribution(particles), wavelength, index, accuracy,
                                  threads);
    const PhaseInterpolation interpolation(average.angles.phase());
    MeasuredPhase table = make_tabulated_phase(
        [&](const std::vector<ScatteringAngle>& angles) { return interpolation.values(angles); },
        accuracy);
    const double area = std::numbers::pi / (wave_number * wave_number) * average.per_particle;
    ParticleScattering result;
    result.extinction_cross_section_m2 = area * average.sums.extinction;
    result.scattering_cross_section_m2 = area * average.sums.scattering;
    result.mean_cosine = average.sums.cosine / average.sums.scattering;
    result.phase = std::move(table.phase);
    result.error = std::max({average.error, average.angles.error(), table.error});
    result.radii = static_cast<int>(average.spheres.count());
    result.angles = 2 * average.angles.summed() - 1;
    return result;
}

std::shared_ptr<const ParticleScattering> remembered_particle_scattering(
    const config::Particles& particles, config::Length wavelength, double accuracy, int threads) {
    config::Particles nameless = particles;
    nameless.name.clear();
    return remembered<ParticleScattering>(std::tuple{nameless, wavelength, accuracy}, [&] {
        return std::make_shared<const ParticleScattering>(
            particle_scattering(particles, wavelength, accuracy, threads));
    });
}

}  // namespace skybake
