#include "bakers/air/particles/particle_scattering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/tabulated_phase.h"
#include "bakers/air/particles/water_refractive_index.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Radii no longer double when their series have more terms than this, angles when terms times pairs
// of angles exceed the other bound: 2 to 4 s on one core.
constexpr double kMostTerms = 6e6;
constexpr double kMostWork = 8e9;
constexpr int kFewestRadii = 32;
constexpr int kPilotNodes = 32;
constexpr int kMostNodes = 1 << 13;

// 1 - cos of the nodes from the first-th on of a half of tabulated_phase.h.
std::vector<double> node_offsets(int cells, int first, int step) {
    std::vector<double> offsets;
    for (int i = first; i <= cells; i += step) {
        const double w = static_cast<double>(i) / cells;
        offsets.push_back((w * w) * (w * w));
    }
    return offsets;
}

// |S_1|^2 + |S_2|^2 per cross-section, forward and backward: in proportion to the phase function.
PhaseHalves phase_of(const MieIntensities& sums, double scattering) {
    PhaseHalves halves;
    for (std::size_t i = 0; i < sums.parallel.size(); ++i) {
        halves.forward.push_back((sums.perpendicular[i] + sums.parallel[i]) / scattering);
        halves.backward.push_back((sums.back_perpendicular[i] + sums.back_parallel[i]) /
                                  scattering);
    }
    return halves;
}

double change(double before, double after) { return std::fabs(after - before) / after; }

// The largest relative change, of cross-sections per node and of the phase function.
double largest_change(const CrossSectionSums& before, const PhaseHalves& phase_before,
                      const CrossSectionSums& after, const PhaseHalves& phase_after) {
    // Twice as many nodes have about twice the sum.
    double worst = std::max(change(2 * before.extinction, after.extinction),
                            change(2 * before.scattering, after.scattering));
    return std::max(worst, largest_difference(phase_before, phase_after));
}

struct SizeAverage {
    WeightedSpheres spheres;
    CrossSectionSums sums;
    PhaseHalves phase;        // at the pilot nodes
    double per_particle = 1;  // the factor that makes sums means over all particles
    double error = 0;
};

SizeAverage monodisperse_average(double x, ComplexNumber index, int threads) {
    SizeAverage result{WeightedSpheres(index, threads), {}, {}, 1, 0};
    result.spheres.add(x, 1);
    const std::vector<double> pilots = node_offsets(kPilotNodes, 0, 1);
    MieIntensities intensities = no_intensities(pilots.size());
    result.spheres.add_intensities(0, pilots, intensities);
    result.sums = result.spheres.cross_sections();
    result.phase = phase_of(intensities, result.sums.scattering);
    return result;
}

// Nodes over the logarithm of the radius, dense about the center of what scatters: u = center + s
// sinh t, uniform in t, with s half the width of the peak. The mapping is analytic, so that the
// trapezoidal rule converges as fast as without it; from one tail to the other it needs about half
// as many nodes as uniform ones of the same distance at the center.
class RadiusNodes {
  public:
    explicit RadiusNodes(const RadiusDistribution::LogRange& range)
        : center_(range.center),
          scale_(0.5 * range.width),
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

SizeAverage distributed_average(const RadiusDistribution& distribution, config::Length wavelength,
                                ComplexNumber index, double accuracy, int threads) {
    const RadiusNodes radii(distribution.scattering_range(wavelength));
    const double wave_number = 2 * std::numbers::pi / wavelength.meters;
    SizeAverage result{WeightedSpheres(index, threads), {}, {}, 1, 0};
    // Every step-th of the nodes between the ends, which have no weight to speak of.
    const auto add_nodes = [&](int intervals, int step) {
        for (int i = 1; i < intervals; i += step) {
            const auto [u, per_step] = radii.at(static_cast<double>(i) / intervals);
            result.spheres.add(wave_number * exponential(u),
                               per_step * distribution.per_log_radius(u));
        }
    };
    const std::vector<double> pilots = node_offsets(kPilotNodes, 0, 1);
    MieIntensities intensities = no_intensities(pilots.size());
    add_nodes(kFewestRadii, 1);
    result.spheres.add_intensities(0, pilots, intensities);
    result.sums = result.spheres.cross_sections();
    result.phase = phase_of(intensities, result.sums.scattering);
    for (int intervals = 2 * kFewestRadii;; intervals *= 2) {
        const CrossSectionSums before = result.sums;
        const PhaseHalves phase_before = result.phase;
        const std::size_t summed = result.spheres.count();
        add_nodes(intervals, 2);
        result.spheres.add_intensities(summed, pilots, intensities);
        result.sums = result.spheres.cross_sections();
        result.phase = phase_of(intensities, result.sums.scattering);
        // Resonances narrower than the distance of the nodes make the error fall as its first
        // power: half of the change is left.
        result.error = largest_change(before, phase_before, result.sums, result.phase) / 2;
        result.per_particle = 1.0 / intervals;
        if (result.error <= accuracy || 2 * result.spheres.terms() > kMostTerms) return result;
    }
}

struct AngleAverage {
    PhaseHalves phase;
    double error = 0;
};

AngleAverage smooth_phase(SizeAverage& average, double accuracy) {
    AngleAverage result{average.phase, 0};
    for (int cells = 2 * kPilotNodes;; cells *= 2) {
        const std::vector<double> offsets = node_offsets(cells, 1, 2);
        MieIntensities intensities = no_intensities(offsets.size());
        average.spheres.add_intensities(0, offsets, intensities);
        const PhaseHalves middles = phase_of(intensities, average.sums.scattering);
        // Halving the distance of the nodes makes the error of interpolation by six of them 2^6
        // times less: the change by the last halving, over 16, bounds it with room.
        result.error = largest_difference(interpolated_middles(result.phase), middles) / 16;
        result.phase = interleaved(result.phase, middles);
        const double work = average.spheres.terms() * cells * 2;
        if (result.error <= accuracy || work > kMostWork || cells >= kMostNodes) return result;
    }
}

}  // namespace

ComplexNumber refractive_index(const config::Particles& particles, config::Length wavelength) {
    if (particles.material == config::ParticleMaterial::water) {
        return water_refractive_index(wavelength);
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
            ? monodisperse_average(wave_number * particles.radius.meters, index, threads)
            : distributed_average(RadiusDistribution(particles), wavelength, index, accuracy,
                                  threads);
    const AngleAverage by_angle = smooth_phase(average, accuracy);
    const PhaseInterpolation interpolation(by_angle.phase);
    MeasuredPhase table = make_tabulated_phase(
        [&](const std::vector<ScatteringAngle>& angles) { return interpolation.values(angles); },
        accuracy);
    const double area = std::numbers::pi / (wave_number * wave_number) * average.per_particle;
    ParticleScattering result;
    result.extinction_cross_section_m2 = area * average.sums.extinction;
    result.scattering_cross_section_m2 = area * average.sums.scattering;
    result.mean_cosine = average.sums.cosine / average.sums.scattering;
    result.phase = std::move(table.phase);
    result.error = std::max({average.error, by_angle.error, table.error});
    result.radii = static_cast<int>(average.spheres.count());
    result.angles = 2 * static_cast<int>(by_angle.phase.forward.size()) - 1;
    return result;
}

namespace {

// All that the result depends on.
auto key_of(const config::Particles& particles, config::Length wavelength, double accuracy) {
    return std::tuple{particles.material,
                      particles.refractive_index,
                      particles.absorption_index,
                      particles.sizes,
                      particles.radius.meters,
                      particles.geometric_deviation,
                      particles.effective_radius.meters,
                      particles.effective_variance,
                      particles.alpha,
                      particles.gamma,
                      wavelength.meters,
                      accuracy};
}

using Key = decltype(key_of({}, {}, 0));
using Results = std::map<Key, std::shared_ptr<const ParticleScattering>>;

}  // namespace

std::shared_ptr<const ParticleScattering> remembered_particle_scattering(
    const config::Particles& particles, config::Length wavelength, double accuracy, int threads) {
    static std::mutex mutex;
    static Results results;
    const Key key = key_of(particles, wavelength, accuracy);
    {
        const std::lock_guard lock(mutex);
        const auto known = results.find(key);
        if (known != results.end()) return known->second;
    }
    // Not under the lock: a thread that waits inside parallel_for may be given another task of the
    // pool, which may ask for particles too.
    auto made = std::make_shared<const ParticleScattering>(
        particle_scattering(particles, wavelength, accuracy, threads));
    const std::lock_guard lock(mutex);
    return results.try_emplace(key, std::move(made)).first->second;
}

}  // namespace skybake
