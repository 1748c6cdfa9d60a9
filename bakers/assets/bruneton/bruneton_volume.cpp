#include "bakers/assets/bruneton/bruneton_volume.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <utility>

#include "bakers/air/forward_peak.h"
#include "bakers/assets/bruneton/flat_tables.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/scattering_volume.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/baked.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/solver/energy_balance.h"
#include "config/assets/takram_layers.h"
#include "config/sections/layer.h"

namespace skybake {

using config::BrunetonConvention;
using config::Layer;

namespace {

bool has_higher_orders(const BrunetonBake& bake) {
    return bake.orders != 1 && bake.table != BrunetonTable::single_mie &&
           bake.table != BrunetonTable::transmittance;
}

// None: there are no higher orders.
std::optional<LightRequest> light_request(const config::Atmosphere& atmosphere,
                                          const BrunetonBake& bake) {
    if (!has_higher_orders(bake)) return std::nullopt;
    return LightRequest{.atmosphere = atmosphere, .orders = std::max(bake.orders - 1, 0)};
}

std::vector<std::string> channel_names(const PacketsOfAir& air, const BrunetonBake& bake) {
    const std::size_t wavelengths = air.packets.front().ground_albedo.size();
    std::vector<std::string> names =
        names_of_channels(air.weights.empty() ? wavelengths : std::size_t{kColors});
    const bool combined = bake.table == BrunetonTable::scattering && bake.combined;
    if (combined || bake.convention == BrunetonConvention::takram) names.emplace_back("A");
    return names;
}

// All tables but the transmittance are times the solar irradiance.
void describe_light(const BrunetonBake& bake, Conventions& conventions) {
    conventions.angle_unit = "cosine";
    if (bake.table == BrunetonTable::transmittance) return;
    conventions.solar_irradiance = bake.solar_irradiance;
    if (bake.table == BrunetonTable::irradiance) return;
    const bool of_one = std::ranges::all_of(bake.solar_irradiance,
                                            [](double irradiance) { return irradiance == 1; });
    conventions.radiance_unit = of_one ? "1/sr" : "solar_irradiance/sr";
}

// Returns the sum of the weights: the colour of light that is 1 at all wavelengths.
glm::dvec3 white_of(const std::vector<glm::dvec3>& weights) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& weight : weights) sum += weight;
    return sum;
}

// Returns the table of one packet or, with weights, of the colours of all.
TableModel flat_table(std::vector<TableModel> packets, const std::vector<glm::dvec3>& weights) {
    if (weights.empty()) return std::move(packets.front());
    return model_of_colors(std::move(packets), weights);
}

// Colours of transmittance are the shares of sunlight's colours.
Outcome<Baked> bake_transmittance(const std::vector<ScatteringPacket>& packets,
                                  const std::vector<glm::dvec3>& weights, const BrunetonBake& bake,
                                  const BakeOptions& options, Baked volume) {
    std::vector<TableModel> tables;
    for (const ScatteringPacket& packet : packets) {
        tables.push_back(transmittance_model(packet.air.air, {}));
    }
    std::vector<glm::dvec3> shares = weights;
    for (glm::dvec3& share : shares) share *= 1.0 / white_of(weights);
    const TableModel table = flat_table(std::move(tables), shares);
    return bake_bruneton_transmittance(table, shell_of(packets.front().air.air), bake, options,
                                       std::move(volume));
}

std::unique_ptr<const SkyLight> sky_light_of(const ScatteringPacket& packet,
                                             const BakeOptions& options) {
    std::unique_ptr<const HigherOrders> higher;
    if (packet.light) {
        higher =
            std::make_unique<SolvedOrders>(packet.medium, *packet.light, packet.light->degree());
    }
    const auto orders = packet.light ? config::SkyOrders::all : config::SkyOrders::single;
    return std::make_unique<SkyLight>(packet.medium, orders, std::move(higher), options.threads);
}

Outcome<Baked> bake_irradiance(const std::vector<ScatteringPacket>& packets,
                               const std::vector<glm::dvec3>& weights, const BrunetonBake& bake,
                               const BakeOptions& options, Baked volume) {
    const std::vector<double> sun =
        weights.empty() ? bake.solar_irradiance : std::vector<double>(kMaxChannels, 1);
    std::vector<std::unique_ptr<const SkyLight>> lights;
    std::vector<TableModel> tables;
    for (const ScatteringPacket& packet : packets) {
        lights.push_back(sky_light_of(packet, options));
        tables.push_back(flat_irradiance(*lights.back(), sun));
    }
    std::vector<glm::dvec3> of_sun = weights;
    for (glm::dvec3& weight : of_sun) weight *= glm::make_vec3(bake.solar_irradiance.data());
    const TableModel table = flat_table(std::move(tables), of_sun);
    return bake_bruneton_irradiance(table, lights.front()->shell(), bake, options,
                                    std::move(volume));
}

constexpr double kMetresPerKm = 1000;

// density = expTerm exp(expScale h) + linearTerm h + constantTerm, up to `width`.
struct ProfileLayer {
    double width = 0;
    double exp_term = 0;
    double exp_scale = 0;
    double linear_term = 0;
    double constant_term = 0;
};

std::string to_string(const ProfileLayer& layer) {
    return fmt::format(
        R"({{"width": {}, "expTerm": {}, "expScale": {}, "linearTerm": {}, "constantTerm": {}}})",
        layer.width, layer.exp_term, layer.exp_scale, layer.linear_term, layer.constant_term);
}

// Always two layers, the lower one first.
std::string to_string(const ProfileLayer& lower, const ProfileLayer& upper) {
    return fmt::format("[{}, {}]", to_string(lower), to_string(upper));
}

std::string exponential_profile(const Layer* layer) {
    if (layer == nullptr) return to_string({}, {});
    return to_string({}, {0, 1, -1 / layer->scale_height.kilometers(), 0, 0});
}

std::string tent_profile(const Layer* layer) {
    if (layer == nullptr) return to_string({}, {});
    const double centre = layer->center_altitude.kilometers();
    const double slope = 1 / layer->half_width.kilometers();
    return to_string({centre, 0, 0, slope, 1 - centre * slope},
                     {0, 0, 0, -slope, 1 + centre * slope});
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

// Returns the air of one set of three channels whose coefficients are those of the colours of
// sunlight: their means by weight over all wavelengths.
config::Atmosphere colored_air(const PacketsOfAir& air) {
    config::Atmosphere colored = air.packets.front();
    const glm::dvec3 white = white_of(air.weights);
    const auto mean = [&](const auto& value) {
        glm::dvec3 sum(0);
        const glm::dvec3* weight = air.weights.data();
        for (const config::Atmosphere& packet : air.packets) {
            for (std::size_t c = 0; c < packet.ground_albedo.size(); ++c) {
                sum += value(packet, c) * *weight++;
            }
        }
        return sum / white;
    };
    const glm::dvec3 albedo =
        mean([](const config::Atmosphere& of, std::size_t c) { return of.ground_albedo[c]; });
    colored.ground_albedo = {albedo.x, albedo.y, albedo.z};
    for (std::size_t k = 0; k < colored.layers.size(); ++k) {
        for (const auto coefficients : {&Layer::scattering, &Layer::extinction}) {
            const glm::dvec3 one = mean([&](const config::Atmosphere& of, std::size_t c) {
                return (of.layers[k].*coefficients)[c].per_meter;
            });
            (colored.layers[k].*coefficients) = {{one.x}, {one.y}, {one.z}};
        }
    }
    return colored;
}

}  // namespace

std::vector<Need> needs_of_bruneton(const std::vector<config::Atmosphere>& packets,
                                    const BrunetonBake& bake) {
    std::vector<Need> needs;
    if (bake.table == BrunetonTable::transmittance) return needs;
    const bool is_flat = bake.table == BrunetonTable::irradiance;
    for (const config::Atmosphere& atmosphere : packets) {
        const std::optional<LightRequest> request = light_request(atmosphere, bake);
        if (request) needs.push_back(need_of(*request));
        if (bake.table != BrunetonTable::higher_orders) {
            needs.push_back(need_of(SunlightRequest{atmosphere}));
            if (!is_flat) needs.push_back(need_of(parts_request(atmosphere, bake, 1)));
        }
        if (request && !is_flat) {
            needs.push_back(need_of(parts_request(atmosphere, bake, bake.orders)));
        }
    }
    return needs;
}

Outcome<Baked> bake_bruneton(const PacketsOfAir& air, const BrunetonBake& bake,
                             const BakeOptions& options, Baked volume) {
    std::vector<ScatteringPacket> packets;
    for (const config::Atmosphere& atmosphere : air.packets) {
        SkyMedium medium = make_sky_medium(atmosphere);
        SkyMedium smooth = without_forward_peaks(medium);
        packets.push_back({atmosphere, std::move(smooth), nullptr, std::move(medium)});
    }
    volume.kind = "bruneton";
    volume.channel_names = channel_names(air, bake);
    volume.voxel_size_m.fill(1.0 / bake.size[0]);  // texture space, a metre wide
    volume.up_axis = "+z";
    describe_light(bake, volume.conventions);
    set_files(bake, volume);
    if (config::has_companion(bake)) {
        volume.companion = CompanionFile{"json", takram_parameters(air, bake)};
    }
    if (bake.table == BrunetonTable::transmittance) {
        return bake_transmittance(packets, air.weights, bake, options, std::move(volume));
    }
    for (ScatteringPacket& packet : packets) {
        const std::optional<LightRequest> request = light_request(packet.atmosphere, bake);
        packet.light = request ? light_of(*request, packet.medium, options) : nullptr;
        if (options.cancelled()) return {};
        if (!packet.light || bake.orders != 0) continue;
        if (const auto problem = check_light(energy_balance(packet.medium, *packet.light),
                                             *packet.light, volume.name)) {
            return *problem;
        }
    }
    if (bake.table == BrunetonTable::irradiance) {
        return bake_irradiance(packets, air.weights, bake, options, std::move(volume));
    }
    return bake_scattering(packets, air.weights, bake, options, std::move(volume));
}

std::string takram_parameters(const PacketsOfAir& air, const BrunetonBake& bake) {
    const bool is_colored = !air.weights.empty();
    const config::Atmosphere atmosphere = is_colored ? colored_air(air) : air.packets.front();
    std::vector<double> sun = bake.solar_irradiance;
    for (std::size_t c = 0; is_colored && c < kColors; ++c) {
        sun[c] *= white_of(air.weights)[static_cast<glm::length_t>(c)];
    }
    const config::TakramLayers layers = config::takram_layers(atmosphere);
    const std::vector<std::pair<const char*, std::string>> members = {
        {"solarIrradiance", vector(sun)},
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
