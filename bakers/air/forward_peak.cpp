#include "bakers/air/forward_peak.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

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
    PhaseFunction function;
    function.g = phase.g;
    function.table = std::move(wide);
    return {std::move(function), share};
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

SkyMedium without_forward_peaks(SkyMedium medium) {
    bool any = false;
    for (SkyLayer& layer : medium.layers) {
        WidePhase wide = without_peak(layer.phase);
        if (!wide.has_peak || !layer.scatters) continue;
        any = true;
        layer.first_phase = std::move(layer.phase);
        layer.first_factor = 1.0 / wide.share;
        layer.phase = std::move(wide.phase);
        take_peak_out(wide.share, layer.alone);
    }
    if (any) medium.air = together(std::move(medium.air), medium.layers);
    return medium;
}

config::Layer without_scattering(config::Layer layer) {
    layer = with_coefficients(std::move(layer));
    if (layer.phase == config::Phase::mie) {
        const WidePhase wide = without_peak(layer_phase(layer));
        for (std::size_t c = 0; c < layer.extinction.size(); ++c) {
            layer.extinction[c].per_meter -= (1 - wide.share[c]) * layer.scattering[c].per_meter;
        }
        layer.phase = config::Phase::isotropic;
    }
    for (config::InverseLength& scattering : layer.scattering) scattering = {};
    return layer;
}

}  // namespace skybake
