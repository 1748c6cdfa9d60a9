#include "bakers/assets/bruneton/takram_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

#include "config/assets/bruneton.h"
#include "config/assets/takram_layers.h"

namespace skybake {

using config::Layer;

namespace {

constexpr double kMetresPerKm = 1000;

// density = expTerm exp(expScale h) + linearTerm h + constantTerm, up to `width`.
struct ProfileLayer {
    double width = 0;
    double exp_term = 0;
    double exp_scale = 0;
    double linear_term = 0;
    double constant_term = 0;
};

std::string spell(const ProfileLayer& layer) {
    return fmt::format(
        R"({{"width": {}, "expTerm": {}, "expScale": {}, "linearTerm": {}, "constantTerm": {}}})",
        layer.width, layer.exp_term, layer.exp_scale, layer.linear_term, layer.constant_term);
}

// Always two layers, the lower one first.
std::string spell(const ProfileLayer& lower, const ProfileLayer& upper) {
    return fmt::format("[{}, {}]", spell(lower), spell(upper));
}

std::string exponential_profile(const Layer* layer) {
    if (layer == nullptr) return spell({}, {});
    return spell({}, {0, 1, -1 / layer->scale_height.kilometers(), 0, 0});
}

std::string tent_profile(const Layer* layer) {
    if (layer == nullptr) return spell({}, {});
    const double centre = layer->center_altitude.kilometers();
    const double slope = 1 / layer->half_width.kilometers();
    return spell({centre, 0, 0, slope, 1 - centre * slope}, {0, 0, 0, -slope, 1 + centre * slope});
}

std::string vector(const std::vector<double>& values) {
    // 15 digits: those of the recipe, whatever the change of units did to the last one.
    return fmt::format("[{:.15g}]", fmt::join(values, ", "));
}

std::string per_km(const Layer* layer, std::vector<config::InverseLength> Layer::*coefficients) {
    std::vector<double> values(3, 0.0);
    for (std::size_t c = 0; layer != nullptr && c < values.size(); ++c) {
        values[c] = (layer->*coefficients)[c].per_meter * kMetresPerKm;
    }
    return vector(values);
}

}  // namespace

std::string takram_parameters(const config::Atmosphere& atmosphere,
                              const config::BrunetonBake& bake) {
    const config::TakramLayers layers = config::takram_layers(atmosphere);
    const std::vector<std::pair<const char*, std::string>> members = {
        {"solarIrradiance", vector(bake.solar_irradiance)},
        {"bottomRadius", fmt::format("{}", atmosphere.ground_radius.meters)},
        {"topRadius", fmt::format("{}", atmosphere.top_radius.meters)},
        {"rayleighDensity", exponential_profile(layers.rayleigh)},
        {"rayleighScattering", per_km(layers.rayleigh, &Layer::scattering)},
        {"mieDensity", exponential_profile(layers.mie)},
        {"mieScattering", per_km(layers.mie, &Layer::scattering)},
        {"mieExtinction", per_km(layers.mie, &Layer::extinction)},
        {"miePhaseFunctionG", fmt::format("{}", layers.mie == nullptr ? 0.0 : layers.mie->g)},
        {"absorptionDensity", tent_profile(layers.absorption)},
        {"absorptionExtinction", per_km(layers.absorption, &Layer::extinction)},
        {"groundAlbedo", vector(atmosphere.ground_albedo)},
        {"muSMin", fmt::format("{}", bake.sun_cos_zenith_min)},
    };
    std::string text;
    for (const auto& [name, value] : members) {
        text += fmt::format("{}  \"{}\": {}", text.empty() ? "" : ",\n", name, value);
    }
    return "{\n" + text + "\n}\n";
}

}  // namespace skybake
