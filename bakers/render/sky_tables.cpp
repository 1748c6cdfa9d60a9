#include "bakers/render/sky_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/io/files/file_io.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/transcendental.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/recipe/asset_parameters.h"

namespace skybake {
namespace {

// The position is texture coordinate * size - 1/2, which is linear in x for either convention.
std::array<float, 2> scale_and_offset(TexelConvention convention, int count) {
    const double first = texture_coordinate(convention, 0, count) * count - 0.5;
    const double last = texture_coordinate(convention, 1, count) * count - 0.5;
    return {static_cast<float>(last - first), static_cast<float>(first)};
}

// `parts` tables of equal size, which lie one below the other, become groups of channels.
LookupTable make_lookup_table(const Image2<float>& image, TexelConvention convention,
                              int parts = 1) {
    LookupTable table;
    table.width = image.width;
    table.height = image.height / parts;
    table.channels = image.channels * parts;
    table.texels_per_row = image.width + 1;
    for (int y = 0; y <= table.height; ++y) {
        for (int x = 0; x <= image.width; ++x) {
            for (int part = 0; part < parts; ++part) {
                const float* texel =
                    image.texel(std::min(x, image.width - 1),
                                part * table.height + std::min(y, table.height - 1));
                table.texels.insert(table.texels.end(), texel, texel + image.channels);
            }
        }
    }
    const auto across = scale_and_offset(convention, image.width);
    const auto up = scale_and_offset(convention, table.height);
    table.scale_x = across[0];
    table.offset_x = across[1];
    table.scale_y = up[0];
    table.offset_y = up[1];
    return table;
}

Diagnostic not_wanted(const PreviewAsset& asset, const std::string& reason) {
    return file_error("E0304", asset.entry.name,
                      fmt::format("cannot make a sky from `{}`: {}", asset.entry.name, reason));
}

bool is_table(const PreviewAsset& asset, const char* kind) {
    return asset.entry.kind == kind && asset.table.width > 0 && asset.table.height > 0;
}

// Returns the degree of the moments that an asset holds, or nothing if it is no table of multiple
// scattering.
std::optional<int> degree_of(const PreviewAsset& asset) {
    const auto bake = config::recorded_bake<config::MultipleScatteringBake>(asset.entry.parameters,
                                                                            asset.entry.name);
    if (!is_table(asset, "multiple_scattering") || !bake) return std::nullopt;
    const bool has_moments = bake->method == config::MultipleScatteringMethod::solved &&
                             bake->content == config::MultipleScatteringContent::moments;
    const int degree = has_moments ? bake->degree : 0;
    return asset.table.height % moment_count(degree) == 0 ? std::optional(degree) : std::nullopt;
}

void add_multiple_scattering(const PreviewAsset& asset, int degree, SkyTables& tables) {
    tables.degree = degree;
    tables.screen = ScreenColor(asset.entry.conventions, asset.table.channels);
    tables.multiple_scattering = make_lookup_table(
        asset.table, TexelConvention::end_points_on_texel_centres, moment_count(degree));
    tables.twilight = asset.entry.mapping == "twilight";
    // A scene may have cropped the sun's axis to the cosines that the manifest gives.
    const AxisMapping& axis = asset.entry.axes[0];
    const auto mapping = tables.twilight ? config::MultipleScatteringMapping::twilight
                                         : config::MultipleScatteringMapping::hillaire;
    const double first = sun_coordinate(mapping, axis.first);
    const double share = sun_coordinate(mapping, axis.last) - first;
    if (share > 0) {
        LookupTable& table = tables.multiple_scattering;
        table.scale_x = static_cast<float>(table.scale_x / share);
        table.offset_x = static_cast<float>(table.offset_x - first * table.scale_x);
    }
}

}  // namespace

Outcome<SkyTables> make_sky_tables(const PreviewAsset& transmittance,
                                   const PreviewAsset* multiple_scattering) {
    Outcome<SkyTables> outcome;
    const std::string& transmittance_mapping = transmittance.entry.mapping;
    const auto refuse = [&](const PreviewAsset& asset, const std::string& reason) {
        outcome.diagnostics.push_back(not_wanted(asset, reason));
    };
    const auto bake = config::recorded_bake<config::TransmittanceBake>(
        transmittance.entry.parameters, transmittance.entry.name);
    if (!is_table(transmittance, "transmittance")) {
        refuse(transmittance, "it is not a table of transmittance");
    } else if (transmittance_mapping != "bruneton" && transmittance_mapping != "ue") {
        refuse(transmittance, fmt::format("its mapping `{}` is unknown", transmittance_mapping));
    } else if (!bake) {
        refuse(transmittance, "its parameters cannot be read as a recipe");
    }
    // Without a table one black texel stands for it.
    SkyTables tables;
    std::optional<int> degree = 0;
    if (multiple_scattering == nullptr) {
        tables.multiple_scattering =
            make_lookup_table(Image2<float>(1, 1, transmittance.table.channels),
                              TexelConvention::end_points_on_texel_centres);
    } else if (degree = degree_of(*multiple_scattering); !degree) {
        refuse(*multiple_scattering, "it is not a table of multiple scattering");
    } else if (const std::string& mapping = multiple_scattering->entry.mapping;
               mapping != "hillaire" && mapping != "twilight") {
        refuse(*multiple_scattering, fmt::format("its mapping `{}` is unknown", mapping));
    } else if (multiple_scattering->table.channels != transmittance.table.channels) {
        refuse(*multiple_scattering, "its channels are not those of the transmittance");
    }
    if (!outcome.diagnostics.empty()) return outcome;

    tables.transmittance =
        make_lookup_table(transmittance.table, transmittance_mapping == "ue"
                                                   ? TexelConvention::end_points_on_edges
                                                   : TexelConvention::end_points_on_texel_centres);
    tables.holds_optical_depth = bake->content == config::TransmittanceContent::optical_depth;
    tables.wavelengths_nm = transmittance.entry.conventions.wavelengths_nm;
    if (multiple_scattering) add_multiple_scattering(*multiple_scattering, *degree, tables);
    outcome.value = std::move(tables);
    return outcome;
}

Spectrum look_up_sunlight(const SkyTables& tables, const Shell& shell, double altitude_km,
                          double sun_s_km) {
    Spectrum value{};
    if (sun_s_km < -horizon_distance_km(shell, altitude_km)) return value;
    const LookupTable& table = tables.transmittance;
    const UnitCoordinates x = transmittance_coordinates(
        shell, altitude_km, sun_s_km / (shell.ground_radius_km + altitude_km));
    const double across =
        std::clamp(x.x_mu * table.scale_x + table.offset_x, 0.0, table.width - 1.0);
    const double up = std::clamp(x.x_r * table.scale_y + table.offset_y, 0.0, table.height - 1.0);
    const auto column = static_cast<int>(across);
    const auto row = static_cast<int>(up);
    const double s = across - column;
    const double t = up - row;
    const auto texels_per_row = static_cast<std::ptrdiff_t>(table.texels_per_row);
    const float* low = table.texels.data() + (row * texels_per_row + column) * table.channels;
    const float* high = low + texels_per_row * table.channels;
    for (int c = 0; c < table.channels; ++c) {
        const double texel = (low[c] * (1 - s) + low[c + table.channels] * s) * (1 - t) +
                             (high[c] * (1 - s) + high[c + table.channels] * s) * t;
        value[static_cast<std::size_t>(c)] =
            tables.holds_optical_depth ? exponential(-texel) : texel;
    }
    return value;
}

}  // namespace skybake
