#include "bakers/assets/transmittance/transmittance_table.h"

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_table.h"
#include "bakers/math/transcendental.h"

namespace skybake {

using config::TransmittanceBake;
using config::TransmittanceContent;
using config::TransmittanceMapping;

namespace {

// The certificate's reference is right to this, far below any pixel type.
constexpr double kReferenceAccuracy = 1e-10;

Outcome<Baked> bake(const Parameters& parameters, const config::TransmittanceBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_transmittance(make_medium(parameters.atmosphere), asset, options,
                              labelled_table(parameters, std::move(label)));
}

Estimate estimate(const Parameters& parameters, const config::TransmittanceBake& asset) {
    return estimate_table(asset, parameters.atmosphere.ground_albedo.size(), 2e-7, 0.05);
}

AssetPlaces places(const Parameters& parameters, const config::TransmittanceBake& asset,
                   const StoredTexels& stored) {
    const auto convention = asset.mapping == config::TransmittanceMapping::ue
                                ? TexelConvention::end_points_on_edges
                                : TexelConvention::end_points_on_texel_centres;
    const Shell shell = shell_of(parameters.atmosphere);
    return single_lookup({"altitude_km", "cos_zenith"}, [=](const Place& at) {
        const UnitCoordinates x = transmittance_coordinates(shell, at[0].second, at[1].second);
        return Uvw{texture_coordinate(convention, x.x_mu, stored.size[0]),
                   texture_coordinate(convention, x.x_r, stored.size[1]), 0.5};
    });
}

AssetLookup lookup(const Parameters& parameters, const config::TransmittanceBake& asset,
                   const StoredTexels& stored) {
    const bool is_depth = asset.content == config::TransmittanceContent::optical_depth;
    const Shell shell = shell_of(parameters.atmosphere);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the {} from an altitude of 0 to {} km to the top of the air, along a ray of this "
        "zenith angle that does not meet the ground.",
        is_depth ? "optical depth" : "transmittance", glsl_number(shell.thickness_km));
    function.arguments = "sampler2D table, float altitude_km, float cos_zenith";
    const bool is_ue = asset.mapping == config::TransmittanceMapping::ue;
    function.value = fmt::format("transmittance_to_top{}{}(table, {}{}, altitude_km, cos_zenith)",
                                 is_ue ? "_ue" : "", of_4(stored.channels),
                                 is_ue ? "" : glsl_size(stored.size) + ", ", glsl_shell(shell));
    return {"transmittance", {with_wavelengths(stored.channels, std::move(function))}};
}

void draft(config::TransmittanceBake& asset, int) { reduce_table(asset, {256, 64}); }

}  // namespace

TableModel transmittance_model(const Medium& medium, const TransmittanceBake& bake) {
    const Shell shell = shell_of(medium);
    const bool as_depth = bake.content == TransmittanceContent::optical_depth;
    TableModel model;
    model.channels = medium.channels;
    model.convention = bake.mapping == TransmittanceMapping::ue
                           ? TexelConvention::end_points_on_edges
                           : TexelConvention::end_points_on_texel_centres;
    model.probe_place = [shell](double x, double y) {
        const UnitCoordinates off = off_the_horizon(shell, {x, y});
        return std::array<double, 2>{off.x_mu, off.x_r};
    };
    model.cost_per_texel = {1};
    model.lowest = 0;
    model.highest = as_depth ? std::numeric_limits<double>::max() : 1;
    model.row = [&medium, shell, as_depth](int, double y, const std::vector<double>& x,
                                           double* values) {
        const auto count = static_cast<int>(x.size());
        const auto channels = static_cast<std::size_t>(medium.channels);
        std::vector<double> s;
        double altitude = 0;
        for (const double x_mu : x) {
            const TransmittanceRay ray = transmittance_ray(shell, {x_mu, y});
            altitude = ray.altitude_km;
            s.push_back(ray.s_km);
        }
        std::vector<double> depth(x.size() * channels);
        optical_depth_to_top(medium, altitude, s.data(), count, depth.data());
        if (!as_depth) {
            for (double& value : depth) value = -value;
            exponentials(depth.data(), static_cast<int>(depth.size()));
        }
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                values[i * channels + c] = depth[c * x.size() + i];
            }
        }
    };
    model.reference = [&medium, shell, as_depth](double y, const std::vector<double>& x,
                                                 double* values) {
        for (const double x_mu : x) {
            const TransmittanceRay ray = transmittance_ray(shell, {x_mu, y});
            const Spectrum depth = reference_optical_depth_to_top(medium, ray.altitude_km, ray.s_km,
                                                                  kReferenceAccuracy);
            for (int c = 0; c < medium.channels; ++c) {
                const double tau = depth[static_cast<std::size_t>(c)];
                *values++ = as_depth ? tau : exponential(-tau);
            }
        }
    };
    model.error = [as_depth](double value, double reference, double) {
        return as_depth ? exponential(-value) - exponential(-reference) : value - reference;
    };
    return model;
}

Outcome<Baked> bake_transmittance(const Medium& medium, const TransmittanceBake& bake,
                                  const BakeOptions& options, Baked table) {
    const Shell shell = shell_of(medium);
    const bool ue = bake.mapping == TransmittanceMapping::ue;
    table.kind = "transmittance";
    table.content = bake.content == TransmittanceContent::optical_depth
                        ? "optical depth from a point to the top of the atmosphere "
                          "(dimensionless); transmittance is exp(-x)"
                        : "transmittance from a point to the top of the atmosphere (dimensionless)";
    table.mapping = ue ? "ue" : "bruneton";
    const std::string convention =
        ue ? "end points on texture edges" : "end points on texel centres";
    table.axes.resize(2);
    table.axes[0] = {"distance_to_top_km",
                     "x_mu = (d - d_min) / (d_max - d_min), d = sqrt(s^2 + q) - s, for s > 0 as q "
                     "/ (sqrt(s^2 + q) + s), s = r mu, q = d_min (R_top + r), d_min = R_top - r, "
                     "d_max = rho + H; x_mu = 0 straight up, 1 the horizon",
                     convention, 0, 1};
    table.axes[1] = {"altitude_km",
                     "x_r = rho / H, rho = sqrt(h (2 R_ground + h)), h the altitude, H = rho at "
                     "the top; x_r = 0 the ground, 1 the top",
                     convention, 0, shell.thickness_km};
    for (AxisMapping& axis : table.axes) {
        axis.end_points = ue ? TexelConvention::end_points_on_edges
                             : TexelConvention::end_points_on_texel_centres;
        axis.constants = shell_constants(shell);
    }
    table.conventions.angle_unit = "cosine";
    set_files(bake, table);
    table.certificate.reference =
        "adaptive Gauss-Kronrod quadrature of extinction along the ray, 1e-10";
    table.certificate.scale = "transmittance, absolute";

    AccuracyRequest request;
    request.size = bake.size;
    request.max_error = bake.max_error;
    request.choice = {4096, 1};
    request.quick = {1024, 1};
    request.full = {16384, 1};
    // Rows, points in each, peak rows, climbs, and points of the reference.
    request.quick_search = {512, 48, 16, 32, 384};
    request.full_search = {1024, 256, 64, 128, 16384};
    const auto place_of = [shell](double x, double y) {
        const TransmittanceRay ray = transmittance_ray(shell, {x, y});
        return Place{{"altitude_km", ray.altitude_km}, {"cos_zenith", cos_zenith_of(shell, ray)}};
    };
    return finish_table(transmittance_model(medium, bake), request, options, place_of,
                        std::move(table));
}

Baker<config::TransmittanceBake> baker(BakerTag<config::TransmittanceBake>) {
    return {.version = 8,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"content"}, {"mapping"}}};
}

}  // namespace skybake
