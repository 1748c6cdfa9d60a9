// The light of all wavelengths of a recipe: of each packet that is computed together, and the colours
// that a table makes of them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/description/asset_label.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/intermediates.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Returns the air at the wavelengths that are computed together: all of them, unless tables of light
// hold colours.
std::vector<config::Atmosphere> light_packets(const Parameters& parameters);

// Returns the number of channels of tables of light.
int light_channels(const Parameters& parameters);

// Returns the colours of a recipe that has [color] and an atmosphere; null if it lacks one of them, or
// after an interruption.
std::shared_ptr<const SkyColors> colors_of(const Parameters& parameters,
                                           const BakeOptions& options);

// Returns what files say of the colours that have a weight for each of their wavelengths; `is_applied`
// says whether their channels are colours.
ColorConvention color_convention(const config::Color& color, std::span<const glm::dvec3> weights,
                                 bool is_applied);

// Returns what fitting the colours needs, if the recipe has any.
std::vector<Need> color_needs(const Parameters& parameters);

// Returns the model of the colours that the weights of all packets' wavelengths make of their tables.
TableModel model_of_colors(std::vector<TableModel> packets, const std::vector<glm::dvec3>& weights);

class SkyLights {
  public:
    // The light of a recipe without colours. It must outlive this object.
    SkyLights(const SkyLight& light) : packets_{&light} {}  // NOLINT: any light is one of lights

    // Makes the light of each packet of the recipe's wavelengths.
    using Make =
        std::function<std::unique_ptr<const SkyLight>(const config::Atmosphere& atmosphere)>;
    SkyLights(const Parameters& parameters, const BakeOptions& options, const Make& make);

    // Multiplies all channels that files hold by these factors, one for each; by 1 if there are none.
    void multiply(std::vector<double> factors) { factors_ = std::move(factors); }

    // The light of the first wavelengths; what does not depend on them is the same for all.
    const SkyLight& first() const { return *packets_.front(); }

    // Returns what is wrong with the light of any packet (SkyLight::problem).
    [[nodiscard]] std::optional<Diagnostic> problem(const std::string& name) const;

    // Whether channels are colours; else they are wavelengths.
    bool makes_colors() const { return colors_ != nullptr; }

    // Calls `use` with the light of each packet.
    void for_each_packet(const std::function<void(const SkyLight& light)>& use) const;

    // Returns the number of channels that files hold, unless something else is added to them.
    int channels() const;

    // Writes the channels that files hold of light at some places, place after place: wavelengths,
    // or the colours made of them. `write_packet` writes the light of one packet's wavelengths.
    void write_channels(
        std::size_t places,
        const std::function<void(const SkyLight& light, double* values)>& write_packet,
        double* values) const;

    // Returns the model of a table of all wavelengths: that of one packet, or the colours made of
    // the models of all.
    TableModel model(const std::function<TableModel(const SkyLight& light)>& of_packet) const;

  private:
    std::vector<std::unique_ptr<const SkyLight>> owned_;
    std::vector<const SkyLight*> packets_;
    std::shared_ptr<const SkyColors> colors_;  // null: channels are wavelengths
    std::vector<double> factors_;
};

// Returns a labelled table of light: its channels are colours, if the recipe has them.
Baked labelled_light_table(const Parameters& parameters, AssetLabel label);

}  // namespace skybake
