#include "bakers/assets/sky/sky_lights.h"

#include <limits>

#include "bakers/field/baked.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

constexpr int kColorChannels = 3;

ColorRequest request_of(const Parameters& parameters) {
    return {parameters.wavelengths, *parameters.color, parameters.atmosphere};
}

// Writes the colours of light at some places, place after place. `write_packet(i, light)` writes the
// light of packet i, which has channels[i] wavelengths.
template <class WritePacket>
void write_colors(const std::vector<glm::dvec3>& weights, const std::vector<std::size_t>& channels,
                  std::size_t places, const WritePacket& write_packet, double* values) {
    std::fill_n(values, places * kColorChannels, 0.0);
    std::vector<double> light;
    const glm::dvec3* weight = weights.data();
    for (std::size_t packet = 0; packet < channels.size(); ++packet) {
        light.resize(places * channels[packet]);
        write_packet(packet, light.data());
        for (std::size_t i = 0; i < places; ++i) {
            for (std::size_t c = 0; c < channels[packet]; ++c) {
                const glm::dvec3 color = light[i * channels[packet] + c] * weight[c];
                double* to = values + i * kColorChannels;
                to[0] += color.x;
                to[1] += color.y;
                to[2] += color.z;
            }
        }
        weight += channels[packet];
    }
}

// Phase functions have no sky without an atmosphere, and so no colours.
bool has_colors(const Parameters& parameters) {
    return parameters.color && parameters.wavelengths.size() > 1 &&
           parameters.atmosphere.top_radius.meters > 0;
}

void scale(const std::vector<double>& factors, std::size_t places, double* values) {
    for (std::size_t i = 0; i < places * factors.size(); ++i)
        values[i] *= factors[i % factors.size()];
}

TableModel scaled(TableModel model, const std::vector<double>& factors) {
    if (factors.empty()) return model;
    model.row = [row = model.row, factors](int level, double y, const std::vector<double>& x,
                                           double* values) {
        row(level, y, x, values);
        scale(factors, x.size(), values);
    };
    model.reference = [reference = model.reference, factors](double y, const std::vector<double>& x,
                                                             double* values) {
        reference(y, x, values);
        scale(factors, x.size(), values);
    };
    return model;
}

}  // namespace

TableModel model_of_colors(std::vector<TableModel> packets,
                           const std::vector<glm::dvec3>& weights) {
    TableModel model = packets.front();
    model.channels = kColorChannels;
    // Colours outside the triangle of the space's primaries have negative channels.
    model.lowest = std::numeric_limits<double>::lowest();
    for (double& cost : model.cost_per_texel) cost *= static_cast<double>(packets.size());
    const auto channels = mapped<std::size_t>(
        packets, [](const TableModel& packet) { return std::size_t(packet.channels); });
    const auto all = std::make_shared<const std::vector<TableModel>>(std::move(packets));
    model.row = [=](int level, double y, const std::vector<double>& x, double* values) {
        const auto write_packet = [&](std::size_t packet, double* light) {
            (*all)[packet].row(level, y, x, light);
        };
        write_colors(weights, channels, x.size(), write_packet, values);
    };
    model.reference = [=](double y, const std::vector<double>& x, double* values) {
        const auto write_packet = [&](std::size_t packet, double* light) {
            (*all)[packet].reference(y, x, light);
        };
        write_colors(weights, channels, x.size(), write_packet, values);
    };
    return model;
}

std::vector<config::Atmosphere> light_packets(const Parameters& parameters) {
    if (holds_colors(parameters)) return packets_of(parameters.atmosphere);
    return {parameters.atmosphere};
}

int light_channels(const Parameters& parameters) {
    return static_cast<int>(config::channels_of_light(parameters));
}

std::shared_ptr<const SkyColors> colors_of(const Parameters& parameters,
                                           const BakeOptions& options) {
    if (!has_colors(parameters)) return nullptr;
    return colors_of(request_of(parameters), options);
}

ColorConvention color_convention(const config::Color& color, std::span<const glm::dvec3> weights,
                                 bool is_applied) {
    ColorWords words = words_of(color);
    ColorConvention convention = {std::move(words.space), std::move(words.white),
                                  std::move(words.sun), std::move(words.observer), is_applied};
    for (const glm::dvec3& weight : weights) {
        convention.weights.insert(convention.weights.end(), {weight.x, weight.y, weight.z});
    }
    return convention;
}

std::vector<Need> color_needs(const Parameters& parameters) {
    if (!has_colors(parameters)) return {};
    return {need_of(request_of(parameters))};
}

SkyLights::SkyLights(const Parameters& parameters, const BakeOptions& options, const Make& make) {
    if (holds_colors(parameters)) colors_ = colors_of(parameters, options);
    for (const config::Atmosphere& packet : light_packets(parameters)) {
        if (!owned_.empty() && options.cancelled()) break;
        owned_.push_back(make(packet));
    }
    for (const auto& light : owned_) packets_.push_back(light.get());
}

std::optional<Diagnostic> SkyLights::problem(const std::string& name) const {
    for (const SkyLight* light : packets_) {
        if (auto found = light->problem(name)) return found;
    }
    return std::nullopt;
}

void SkyLights::for_each_packet(const std::function<void(const SkyLight& light)>& use) const {
    for (const SkyLight* light : packets_) use(*light);
}

int SkyLights::channels() const { return colors_ ? kColorChannels : first().medium().air.channels; }

void SkyLights::write_channels(
    std::size_t places,
    const std::function<void(const SkyLight& light, double* values)>& write_packet,
    double* values) const {
    if (!colors_) {
        write_packet(first(), values);
        return scale(factors_, places, values);
    }
    const auto channels = mapped<std::size_t>(
        packets_, [](const SkyLight* light) { return std::size_t(light->medium().air.channels); });
    write_colors(
        colors_->weights, channels, places,
        [&](std::size_t packet, double* light) { write_packet(*packets_[packet], light); }, values);
    scale(factors_, places, values);
}

TableModel SkyLights::model(
    const std::function<TableModel(const SkyLight& light)>& of_packet) const {
    if (!colors_) return scaled(of_packet(first()), factors_);
    std::vector<TableModel> packets;
    for (const SkyLight* light : packets_) packets.push_back(of_packet(*light));
    return scaled(model_of_colors(std::move(packets), colors_->weights), factors_);
}

Baked labelled_light_table(const Parameters& parameters, AssetLabel label) {
    Baked table = labelled_table(parameters, std::move(label));
    table.channel_names = names_of_channels(static_cast<std::size_t>(light_channels(parameters)));
    return table;
}

}  // namespace skybake
