#include "bakers/assets/probe_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <variant>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/phase/phase_axis.h"
#include "bakers/assets/volume_probe_check.h"
#include "bakers/field/finish_table.h"
#include "bakers/field/texel_axis.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/light/solver/light_moments.h"
#include "bakers/light/sun_columns.h"
#include "bakers/math/transcendental.h"
#include "config/recipe/recipe.h"

namespace skybake {

namespace {

using Coordinates = std::array<double, 2>;

Coordinates texture_coordinates(const config::TransmittanceBake& bake, const Shell& shell,
                                const std::vector<int>& size, const Probe& probe) {
    const auto convention = bake.mapping == config::TransmittanceMapping::ue
                                ? TexelConvention::end_points_on_edges
                                : TexelConvention::end_points_on_texel_centres;
    const UnitCoordinates x =
        transmittance_coordinates(shell, probe.at[0].second, probe.at[1].second);
    return {texture_coordinate(convention, x.x_mu, size[0]),
            texture_coordinate(convention, x.x_r, size[1])};
}

// Of a stack of moments in the table of the probe's l and m.
Coordinates texture_coordinates(const SunColumns& columns, const Shell& shell, int tables,
                                const std::vector<int>& size, const Probe& probe) {
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const int part = tables == 1 ? 0
                                 : moment_index(static_cast<int>(probe.at[2].second),
                                                static_cast<int>(probe.at[3].second));
    const double v =
        texture_coordinate(kConvention, probe.at[0].second / shell.thickness_km, size[1] / tables);
    return {texture_coordinate(kConvention, columns.coordinate(probe.at[1].second), size[0]),
            (part + v) / tables};
}

// Of the table of the sun that the probe names: the nearest, since its angle went through degrees.
Coordinates texture_coordinates(const config::SkyViewBake& bake, const Shell& shell,
                                const std::vector<int>& size, const Probe& probe) {
    const SkyViewCamera camera(shell, bake.altitude.kilometers());
    const double radians = std::numbers::pi / 180;
    const int rows = bake.size[1];
    const auto suns = static_cast<int>(bake.sun_elevations.size());
    Coordinates nearest{};
    for (int k = 0; k < suns; ++k) {
        const double elevation = bake.sun_elevations[static_cast<std::size_t>(k)].radians;
        if (std::fabs(elevation - probe.at[2].second * radians) > 1e-9) continue;
        const double y = camera.coordinate(probe.at[1].second * radians);
        const double v = (k + sky_view_v(y, rows)) / suns;
        // The same sun may stand in the list twice.
        if (k > 0 && std::fabs(v - probe.uv[1]) > std::fabs(nearest[1] - probe.uv[1])) continue;
        nearest = {texture_coordinate(TexelConvention::end_points_on_texel_centres,
                                      probe.at[0].second / 180, size[0]),
                   v};
    }
    return nearest;
}

Coordinates texture_coordinates(const config::IrradianceBake& bake, const Shell& shell,
                                const std::vector<int>& size, const Probe& probe) {
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    return {
        texture_coordinate(kConvention, sun_coordinate(bake.mapping, probe.at[1].second), size[0]),
        texture_coordinate(kConvention, irradiance_coordinate(shell, probe.at[0].second), size[1])};
}

// By the spacing that suited the table best, which its file names.
Coordinates texture_coordinates(std::string_view spacing, const std::vector<int>& size,
                                const Probe& probe) {
    const double at = probe.at[0].second;
    double x = at;  // a share
    if (spacing == "angle") x = at / 180;
    const double half_sine = cosine_of_pi(0.5 - at / 360);
    const double half_cosine = cosine_of_pi(at / 360);
    const ScatteringAngle angle = {2 * half_sine * half_sine, 2 * half_cosine * half_cosine};
    if (spacing == "cosine") x = phase_coordinate(config::PhaseSpacing::cosine, angle);
    if (spacing == "peaks") x = phase_coordinate(config::PhaseSpacing::peaks, angle);
    return {texture_coordinate(TexelConvention::end_points_on_texel_centres, x, size[0]), 0.5};
}

// Looked up by the overload above.
Coordinates texture_coordinates(const config::PhaseBake&, const Shell&, const std::vector<int>&,
                                const Probe& probe) {
    return probe.uv;
}

// Looked up by the overload above.
Coordinates texture_coordinates(const config::MultipleScatteringBake&, const Shell&,
                                const std::vector<int>&, const Probe& probe) {
    return probe.uv;
}

// Volumes have probes of another kind (volume_probe_check.h).
Coordinates texture_coordinates(const config::VolumeFiles&, const Shell&, const std::vector<int>&,
                                const Probe& probe) {
    return probe.uv;
}

// Null where there is none of this name.
const config::Bake* bake_of(const config::Parameters& parameters, std::string_view name) {
    const std::vector<config::Bake>& bakes = parameters.bakes;
    const auto own = std::find_if(bakes.begin(), bakes.end(),
                                  [name](const config::Bake& bake) { return bake.name == name; });
    return own != bakes.end() ? &*own : nullptr;
}

std::vector<std::string> check(const ManifestAsset& asset, int& checks) {
    std::vector<std::string> failures;
    // The parameters that an asset carries are themselves a recipe; a grid of occupancy has its
    // volume's too.
    const auto recipe = config::parse_recipe(asset.parameters, asset.name);
    const config::Bake* own =
        recipe.value ? bake_of(recipe.value->parameters, asset.name) : nullptr;
    if (own == nullptr) {
        ++checks;
        failures.push_back("its parameters cannot be read as a recipe");
        return failures;
    }
    if (asset.is_volume()) {
        return check_volume_places(asset, recipe.value->parameters, *own, checks);
    }
    const config::Atmosphere& atmosphere = recipe.value->parameters.atmosphere;
    const Shell shell = {atmosphere.ground_radius.kilometers(),
                         (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000};
    const config::Bake& bake = *own;
    const auto* scattering = std::get_if<config::MultipleScatteringBake>(&bake.asset);
    const bool solved =
        scattering && scattering->method == config::MultipleScatteringMethod::solved;
    const int tables = solved && scattering->content == config::MultipleScatteringContent::moments
                           ? moment_count(scattering->degree)
                           : 1;
    std::size_t coordinates = std::holds_alternative<config::SkyViewBake>(bake.asset) ? 3 : 2;
    if (tables > 1) coordinates = 4;
    const bool is_phase = std::holds_alternative<config::PhaseBake>(bake.asset);
    if (is_phase) coordinates = 1;
    for (const Probe& probe : asset.probes) {
        ++checks;
        if (probe.at.size() != coordinates) {
            failures.push_back(fmt::format("a probe does not have {} coordinates", coordinates));
            continue;
        }
        const Coordinates uv =
            is_phase ? texture_coordinates(asset.mapping, asset.size, probe)
            : scattering
                ? texture_coordinates(
                      sun_columns(scattering->mapping,
                                  solved ? recipe.value->parameters.scene : std::nullopt, shell),
                      shell, tables, asset.size, probe)
                : std::visit(
                      [&](const auto& of) {
                          return texture_coordinates(of, shell, asset.size, probe);
                      },
                      bake.asset);
        if (std::fabs(uv[0] - probe.uv[0]) > 1e-9 || std::fabs(uv[1] - probe.uv[1]) > 1e-9) {
            failures.push_back(fmt::format("{} is at uv {:.9g}, {:.9g}, not at {:.9g}, {:.9g}",
                                           place_text(probe.at), uv[0], uv[1], probe.uv[0],
                                           probe.uv[1]));
        }
    }
    return failures;
}

}  // namespace

AssetCheck probe_check() { return {"probe place", check}; }

}  // namespace skybake
