#include "bakers/air/forward_peak.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>

#include "bakers/air/optical_depth.h"

namespace skybake {
namespace {

// 1 - cos of 10 degrees: ray bundles have a ray in every 5 to 10 degrees.
constexpr double kPeakAngle = 0.0151922469877920;

// The table with no value above that at the peak's edge, and the share of light that it keeps.
std::pair<PhaseFunction, double> cut_down(const PhaseFunction& phase) {
    const TabulatedPhase& table = *phase.table;
    const double edge = tabulated_phase_value(table, kPeakAngle, 2 - kPeakAngle);
    std::vector<double> forward = table.forward;
    for (std::size_t i = 0; i < forward.size(); ++i) {
        const double w = static_cast<double>(i) / table.cells;
        if (w * w * w * w < kPeakAngle) forward[i] = std::min(forward[i], edge);
    }
    auto wide = std::make_shared<TabulatedPhase>(normalised_phase(forward, table.backward));
    // Straight back nothing was cut: there the table only was scaled.
    const double share = table.backward.front() / wide->backward.front();
    return {PhaseFunction{.table = std::move(wide)}, share};
}

// Takes what goes into the peak out of both coefficients.
template <class Layer>
void take_peak_out(const Spectrum& share, Layer& layer) {
    layer.extinction_per_km -= (1.0 - share) * layer.scattering_per_km;
    layer.scattering_per_km *= share;
}

void take_peak_out(const Spectrum& share, Medium& medium) {
    for (ExponentialLayer& layer : medium.exponential_layers) take_peak_out(share, layer);
    for (PiecewiseLayer& layer : medium.piecewise_layers) take_peak_out(share, layer);
}

// All layers together, in the order of make_medium: each layer is of one kind, in the order given.
Medium together(Medium air, const std::vector<SkyLayer>& layers) {
    air.exponential_layers.clear();
    air.piecewise_layers.clear();
    for (const SkyLayer& layer : layers) {
        const Medium& alone = layer.alone;
        air.exponential_layers.insert(air.exponential_layers.end(),
                                      alone.exponential_layers.begin(),
                                      alone.exponential_layers.end());
        air.piecewise_layers.insert(air.piecewise_layers.end(), alone.piecewise_layers.begin(),
                                    alone.piecewise_layers.end());
    }
    return air;
}

// Takes what moments up to a degree cannot represent out of the layer. A negative moment is no
// peak: such phase functions scatter backwards.
void scale(int degree, SkyLayer& layer) {
    const Spectrum more = maximum(scattered_moments(layer, degree + 1).back(), Spectrum(0.0));
    if (!(largest(more) > 0)) return;
    if (layer.first_phase.functions.empty()) layer.first_phase = layer.phase;
    layer.forward_share = 1.0 - (1.0 - layer.forward_share) * (1.0 - more);
    layer.first_factor /= 1.0 - more;
    take_peak_out(1.0 - more, layer.alone);
}

}  // namespace

WidePhase without_peak(const LayerPhase& phase) {
    WidePhase wide;
    wide.phase = phase;
    for (std::size_t c = 0; c < phase.functions.size(); ++c) {
        if (!phase.functions[c].table) return wide;
        std::tie(wide.phase.functions[c], wide.share[c]) = cut_down(phase.functions[c]);
    }
    if (phase.is_alike()) wide.share = Spectrum(wide.share[0]);
    wide.has_peak = true;
    return wide;
}

bool has_peaks_of_spheres(const SkyMedium& medium) {
    return std::ranges::any_of(medium.layers, [](const SkyLayer& layer) {
        return layer.scatters && layer.first_phase.functions.empty() &&
               layer.phase.functions.front().table != nullptr;
    });
}

double light_beyond_degree(const SkyMedium& medium, int degree) {
    Spectrum beyond{};
    Spectrum whole{};
    for (const SkyLayer& layer : medium.layers) {
        if (!layer.scatters) continue;
        const Spectrum next = scattered_moments(layer, degree + 1).back();
        const Spectrum depth = scattering_depth(layer, 0, layer.alone.ground_radius_km);
        beyond += maximum(next, -next) * depth;
        whole += depth;
    }
    return largest(beyond / maximum(whole, Spectrum(1.0)));
}

SkyMedium without_forward_peaks(SkyMedium medium) {
    for (SkyLayer& layer : medium.layers) {
        if (!layer.scatters) continue;
        WidePhase wide = without_peak(layer.phase);
        if (!wide.has_peak) continue;
        layer.first_phase = std::move(layer.phase);
        layer.first_factor = 1.0 / wide.share;
        layer.phase = std::move(wide.phase);
        take_peak_out(wide.share, layer.alone);
    }
    if (light_beyond_degree(medium, kLargestDegree) > kNegligibleLight) {
        for (SkyLayer& layer : medium.layers) {
            if (layer.scatters && layer.first_phase.functions.empty()) scale(kLargestDegree, layer);
        }
    }
    const bool any = std::ranges::any_of(
        medium.layers, [](const SkyLayer& layer) { return !layer.first_phase.functions.empty(); });
    if (any) medium.air = together(std::move(medium.air), medium.layers);
    return medium;
}

SkyMedium delta_scaled(SkyMedium medium, int degree) {
    for (SkyLayer& layer : medium.layers) {
        if (layer.scatters) scale(degree, layer);
    }
    medium.air = together(std::move(medium.air), medium.layers);
    return medium;
}

SkyMedium scattering_only(SkyMedium medium, const std::vector<std::string>& layers) {
    if (layers.empty()) return medium;
    for (SkyLayer& layer : medium.layers) {
        if (std::ranges::find(layers, layer.name) != layers.end()) continue;
        for (ExponentialLayer& part : layer.alone.exponential_layers) part.scattering_per_km = {};
        for (PiecewiseLayer& part : layer.alone.piecewise_layers) part.scattering_per_km = {};
        layer.scatters = false;
    }
    medium.air = together(std::move(medium.air), medium.layers);
    return medium;
}

Spectrum scattering_depth(const SkyLayer& layer, double altitude_km, double s_km) {
    const Coefficients full = full_coefficients(layer);
    // The same share of extinction at all altitudes.
    return share_of(full.scattering_per_km, full.extinction_per_km) *
           optical_depth_to_top(layer.alone, altitude_km, s_km);
}

}  // namespace skybake
