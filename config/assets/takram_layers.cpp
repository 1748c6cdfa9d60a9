#include "config/assets/takram_layers.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/sections/layer.h"

namespace skybake::config {
namespace {

bool is_scattering(const Layer& layer) {
    return std::ranges::any_of(layer.scattering,
                               [](InverseLength value) { return value.per_meter > 0; });
}

bool absorbs(const Layer& layer) {
    for (std::size_t c = 0; c < layer.extinction.size(); ++c) {
        const double scattering = c < layer.scattering.size() ? layer.scattering[c].per_meter : 0.0;
        if (layer.extinction[c].per_meter != scattering) return true;
    }
    return false;
}

// Returns the member that a layer belongs to, or null if it belongs to none.
const Layer* TakramLayers::*kind_of(const Layer& layer) {
    const bool exponential = layer.profile == Profile::exponential;
    if (layer.phase == Phase::mie) return nullptr;  // its phase function is a table
    if (layer.profile == Profile::tent && !is_scattering(layer)) return &TakramLayers::absorption;
    if (exponential && layer.phase == Phase::rayleigh && !absorbs(layer)) {
        return &TakramLayers::rayleigh;
    }
    if (exponential && layer.phase == Phase::cornette_shanks) return &TakramLayers::mie;
    return nullptr;
}

}  // namespace

std::optional<std::string> takram_problem(const Atmosphere& atmosphere, std::size_t channels) {
    if (channels != 3) return "takram's tables have three wavelengths, or colours";
    TakramLayers found;
    for (const Layer& layer : atmosphere.layers) {
        const auto kind = kind_of(layer);
        if (kind == nullptr) {
            return fmt::format("takram's parameters have no layer like `{}`", layer.name);
        }
        if (found.*kind != nullptr) {
            return fmt::format("takram's parameters have `{}` or `{}`, not both",
                               (found.*kind)->name, layer.name);
        }
        found.*kind = &layer;
    }
    return std::nullopt;
}

TakramLayers takram_layers(const Atmosphere& atmosphere) {
    TakramLayers found;
    for (const Layer& layer : atmosphere.layers) {
        if (const auto kind = kind_of(layer)) found.*kind = &layer;
    }
    return found;
}

}  // namespace skybake::config
