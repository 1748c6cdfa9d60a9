#include "bakers/air/particles/sphere_mixture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bakers/air/particles/particle_scattering.h"
#include "bakers/air/particles/remembered.h"
#include "bakers/math/transcendental.h"
#include "config/sections/spectral_air.h"

namespace skybake {
namespace {

using config::LayerParticles;
using config::Length;
using Shared = std::shared_ptr<const SphereScattering>;

// All that a result depends on.
struct Request {
    LayerParticles layer;  // without its wavelengths
    Length wavelength;
    double accuracy = 0;
    bool operator==(const Request&) const = default;
};

// The kinds at their own numbers.
Shared unscaled(const LayerParticles& layer, Length wavelength, double accuracy, int threads) {
    SphereScattering sum;
    std::vector<WeightedPhase> phases;
    for (const config::SphereKind& kind : layer.kinds) {
        const auto one =
            remembered_particle_scattering(kind.particles, wavelength, accuracy, threads);
        const double per_m3 = kind.number_density.per_cubic_meter;
        const double scattering = per_m3 * one->scattering_cross_section_m2;
        sum.extinction_per_m += per_m3 * one->extinction_cross_section_m2;
        sum.scattering_per_m += scattering;
        sum.error = std::max(sum.error, one->error);
        phases.push_back({scattering, {one, &one->phase}});
    }
    sum.phase = mixed_phase(phases);
    return std::make_shared<const SphereScattering>(std::move(sum));
}

Shared scaled(const Request& request, int threads) {
    if (!request.layer.extinction) {
        return unscaled(request.layer, request.wavelength, request.accuracy, threads);
    }
    LayerParticles unbound = request.layer;
    unbound.extinction.reset();
    const Shared own = sphere_scattering(unbound, request.wavelength, request.accuracy, threads);
    const Shared green =
        sphere_scattering(unbound, config::aerosol_wavelength, request.accuracy, threads);
    const double scale = request.layer.extinction->per_meter / green->extinction_per_m;
    SphereScattering result = *own;
    result.extinction_per_m *= scale;
    result.scattering_per_m *= scale;
    return std::make_shared<const SphereScattering>(std::move(result));
}

// The wavelengths at which series are summed about one in between, and how far
// this is from the first to the second.
struct Neighbours {
    Length low, high;
    double share = 0;
};

Neighbours neighbours_of(const LayerParticles& layer, Length wavelength) {
    config::WavelengthRange known{{0}, {std::numeric_limits<double>::infinity()}};
    for (const config::SphereKind& kind : layer.kinds) {
        const config::WavelengthRange range = config::range_of(kind.particles);
        known.shortest.meters = std::max(known.shortest.meters, range.shortest.meters);
        known.longest.meters = std::min(known.longest.meters, range.longest.meters);
    }
    const double at = std::clamp(wavelength.meters, known.shortest.meters, known.longest.meters);
    const double step = layer.step.meters;
    const double below = std::floor(at / step) * step;
    const Length low{std::max(below, known.shortest.meters)};
    const Length high{std::min(below + step, known.longest.meters)};
    if (!(high.meters > low.meters)) return {low, low, 0};
    return {low, high, (at - low.meters) / (high.meters - low.meters)};
}

// On the power law of wavelength through two values.
double on_power_law(double low, double high, const Neighbours& at) {
    const double ratio = at.high.meters / at.low.meters;
    const double share = logarithm(1 + at.share * (ratio - 1)) / logarithm(ratio);
    return low * exponential(share * logarithm(high / low));
}

Shared interpolated(const Request& request, int threads) {
    const Neighbours at = neighbours_of(request.layer, request.wavelength);
    LayerParticles summed = request.layer;
    summed.step = {0};
    const Shared low = sphere_scattering(summed, at.low, request.accuracy, threads);
    if (at.share == 0) return low;
    const Shared high = sphere_scattering(summed, at.high, request.accuracy, threads);
    SphereScattering result;
    result.extinction_per_m = on_power_law(low->extinction_per_m, high->extinction_per_m, at);
    result.scattering_per_m = std::min(
        on_power_law(low->scattering_per_m, high->scattering_per_m, at), result.extinction_per_m);
    const std::array phases = {WeightedPhase{1 - at.share, low->phase},
                               WeightedPhase{at.share, high->phase}};
    result.phase = mixed_phase(phases);
    result.error = std::max(low->error, high->error);
    return std::make_shared<const SphereScattering>(std::move(result));
}

}  // namespace

Shared sphere_scattering(const LayerParticles& layer, Length wavelength, double accuracy,
                         int threads) {
    assert(!layer.kinds.empty());
    Request request{layer, wavelength, accuracy};
    request.layer.wavelengths.clear();
    return remembered<SphereScattering>(request, [&] {
        return layer.step.meters > 0 ? interpolated(request, threads) : scaled(request, threads);
    });
}

double spheres_per_m3(const LayerParticles& layer) {
    double sum = 0;
    for (const config::SphereKind& kind : layer.kinds) sum += kind.number_density.per_cubic_meter;
    return sum;
}

}  // namespace skybake
