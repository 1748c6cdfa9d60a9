#include "bakers/assets/irradiance/irradiance_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/sky_irradiance.h"
#include "bakers/math/relative_error.h"
#include "config/assets/irradiance.h"

namespace skybake {

using config::IrradianceBake;
using config::IrradianceContent;

namespace {

// Of each level, and of the reference.
constexpr std::array<IrradianceNodes, 5> kNodes = {
    {{6, 6, 3}, {8, 8, 4}, {12, 12, 5}, {16, 16, 6}, {22, 22, 8}}};
constexpr IrradianceNodes kReferenceZenithNodes = {28, 32, 12};

// Of sunlight, from which the levels make the light scattered once; the reference's is exact.
constexpr TransmittanceField::Size kField = {384, 128};

// The light of a table, with the sunlight that all its rows share.
class IrradianceRows {
  public:
    IrradianceRows(const SkyLight& light, const IrradianceBake& bake, int threads)
        : light_(light), content_(bake.content), mapping_(bake.mapping), threads_(threads) {}

    // Channels interleaved in values.
    void row(const IrradianceNodes& nodes, bool exact, double y, const std::vector<double>& x,
             double* values) const {
        const double altitude_km = irradiance_altitude_km(light_.shell(), y);
        SkyIrradiance sky(light_, altitude_km, exact ? nullptr : sunlight());
        for (const double coordinate : x) {
            const double sun = sun_cos_zenith_at(mapping_, coordinate);
            Spectrum value{};
            if (content_ != IrradianceContent::direct) value += sky.under(sun, nodes);
            if (content_ != IrradianceContent::sky) {
                value += sun_irradiance(light_, altitude_km, sun);
            }
            values = std::copy_n(data(value), light_.medium().air.channels, values);
        }
    }

  private:
    // Made when first asked for; null where no light is scattered once.
    const TransmittanceField* sunlight() const {
        if (content_ == IrradianceContent::direct) return nullptr;
        if (light_.orders() == config::SkyOrders::multiple) return nullptr;
        std::call_once(made_, [this] {
            const Medium& air = light_.medium().air;
            sunlight_.emplace(air, quadrature_altitudes_km(air), kField, threads_);
        });
        return &*sunlight_;
    }

    const SkyLight& light_;
    IrradianceContent content_;
    config::MultipleScatteringMapping mapping_;
    int threads_;
    mutable std::once_flag made_;
    mutable std::optional<TransmittanceField> sunlight_;
};

std::string content_text(const IrradianceBake& bake) {
    const std::string surface =
        "irradiance of a level surface that faces up, for a solar irradiance of 1 (dimensionless)";
    if (bake.content == IrradianceContent::direct) return surface + ": by the sun";
    const std::string sky = fmt::format("by the sky, {}", light_text(orders_of(bake), bake.layers));
    if (bake.content == IrradianceContent::sky) return fmt::format("{}: {}", surface, sky);
    return fmt::format("{}: by the sun and {}", surface, sky);
}

void describe(const IrradianceBake& bake, const Shell& shell, Baked& table) {
    const bool twilight = bake.mapping == config::MultipleScatteringMapping::twilight;
    table.kind = "irradiance";
    table.content = content_text(bake);
    table.mapping = twilight ? "twilight" : "hillaire";
    table.axes.resize(2);
    table.axes[0] = {"sun_cos_zenith",
                     twilight ? "x = (1 + sign(mu_s) sqrt(|mu_s|)) / 2" : "x = (mu_s + 1) / 2",
                     "end points on texel centres", -1, 1};
    table.axes[1] = {"altitude_km", "x = sqrt(altitude / (R_top - R_ground))",
                     "end points on texel centres", 0, shell.thickness_km};
    table.axes[0].constants = {{"first", 0.0}, {"share", 1.0}};
    table.axes[1].constants = shell_constants(shell);
    table.conventions.angle_unit = "cosine";
    table.conventions.solar_irradiance.assign(table.channel_names.size(), 1);
    set_files(bake, table);
    table.certificate.reference =
        fmt::format("the same integral with {} directions above and below the sun, and around",
                    kReferenceZenithNodes.single);
    table.certificate.scale = kRelativeErrorScale;
}

}  // namespace

double irradiance_altitude_km(const Shell& shell, double y) { return y * y * shell.thickness_km; }

double irradiance_coordinate(const Shell& shell, double altitude_km) {
    return std::sqrt(altitude_km / shell.thickness_km);
}

config::SkyOrders orders_of(const IrradianceBake& bake) {
    if (bake.content == IrradianceContent::direct) return config::SkyOrders::single;
    return bake.content == IrradianceContent::sky ? bake.orders : config::SkyOrders::all;
}

TableModel irradiance_model(const SkyLight& light, const IrradianceBake& bake, int threads) {
    const auto rows = std::make_shared<const IrradianceRows>(light, bake, threads);
    TableModel model;
    model.channels = light.medium().air.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    for (const IrradianceNodes& nodes : kNodes) {
        model.cost_per_texel.push_back(2.0 * nodes.single * nodes.single);
    }
    model.row = [rows](int level, double y, const std::vector<double>& x, double* values) {
        rows->row(kNodes[static_cast<std::size_t>(level)], false, y, x, values);
    };
    model.reference = [rows](double y, const std::vector<double>& x, double* values) {
        rows->row(kReferenceZenithNodes, true, y, x, values);
    };
    model.error = relative_error;
    return model;
}

config::Outcome<Baked> bake_irradiance(const SkyLight& light, const IrradianceBake& bake,
                                       const BakeOptions& options, Baked table) {
    const auto mapping = bake.mapping;
    describe(bake, light.shell(), table);
    AccuracyRequest request;
    request.size = bake.size;
    request.max_texel_error = bake.max_texel_error;
    request.quick = {8, 8};
    request.full = {64, 16};
    request.quick_search = {64, 32, 8, 8, 128};
    request.full_search = {128, 64, 16, 16, 512};
    const auto place_of = [&light, mapping](double x, double y) {
        return Place{{"altitude_km", irradiance_altitude_km(light.shell(), y)},
                     {"sun_cos_zenith", sun_cos_zenith_at(mapping, x)}};
    };
    return finish_table(irradiance_model(light, bake, options.threads), request, options, place_of,
                        std::move(table));
}

}  // namespace skybake
