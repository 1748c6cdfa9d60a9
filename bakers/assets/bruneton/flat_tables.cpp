#include "bakers/assets/bruneton/flat_tables.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/baked.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/voxel_array.h"
#include "bakers/light/sky_irradiance.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

constexpr auto kFlatConvention = TexelConvention::end_points_on_texel_centres;
constexpr const char* kConventionText = "end points on texel centres; clamps";

// Directions that sky irradiance is integrated over: those of `asset = "irradiance"` with an error
// of texels below 1e-3 on Earth, and of its reference.
constexpr IrradianceNodes kFlatNodes = {8};
constexpr IrradianceNodes kReferenceNodes = {28, 12, 6};
// Columns of a sun axis of which only the ends are used.
constexpr int kFewestColumns = 8;

// x of a texture coordinate: lookups beyond the outer texels' centres are clamped.
double coordinate_of(double u, int count) {
    return std::clamp((u * count - 0.5) / (count - 1), 0.0, 1.0);
}

void describe_flat_axes(const Shell& shell, Baked& volume) {
    for (AxisMapping& axis : volume.axes) {
        if (axis.quantity != "none") axis.constants = shell_constants(shell);
    }
}

// The place of coordinates in [0, 1], which are moved off the horizon where there is one.
using FlatPlace = std::function<Place(double& x, double& y)>;

ProbePlace probe_place_of(const FlatPlace& place, const std::array<int, 3>& size,
                          const std::array<double, 3>& uvw) {
    double x = coordinate_of(uvw[0], size[0]);
    double y = coordinate_of(uvw[1], size[1]);
    ProbePlace result;
    result.at = place(x, y);
    result.lookups = {{{texture_coordinate(kFlatConvention, x, size[0]),
                        texture_coordinate(kFlatConvention, y, size[1]), 0.5}}};
    return result;
}

using FlatRow = decltype(TableModel::reference);

// Returns the values of a row's function at texture coordinates, 1 in channels after the colours.
VolumeReference flat_values(FlatRow row, int colours, const std::array<int, 3>& size,
                            std::size_t channels) {
    return [row = std::move(row), colours, size, channels](const std::array<double, 3>& uvw) {
        std::vector<double> values(channels, 1);
        std::vector<double> found(static_cast<std::size_t>(colours));
        row(coordinate_of(uvw[1], size[1]), {coordinate_of(uvw[0], size[0])}, found.data());
        std::ranges::copy(found, values.begin());
        return values;
    };
}

// Makes the texels. Channels after the colours hold 1.
VoxelArray flat_texels(const TableModel& table, const std::array<int, 3>& size,
                       std::size_t channels, const BakeOptions& options) {
    VoxelArray texels(size, channels);
    const auto colours = static_cast<std::size_t>(table.channels);
    std::vector<double> x;
    for (int u = 0; u < size[0]; ++u) x.push_back(texel_coordinate(kFlatConvention, u, size[0]));
    for_each_tile(size[1], options, "texels", [&](int v) {
        std::vector<double> values(x.size() * colours);
        table.row(0, texel_coordinate(kFlatConvention, v, size[1]), x, values.data());
        for (std::size_t c = 0; c < channels; ++c) {
            float* to = texels.channel(c).data() + texels.offset(0, v, 0);
            for (std::size_t u = 0; u < x.size(); ++u) {
                to[u] = c < colours ? static_cast<float>(values[u * colours + c]) : 1.0f;
            }
        }
    });
    return texels;
}

Outcome<Baked> bake_flat(const TableModel& table, const FlatPlace& place, const BrunetonBake& bake,
                         const BakeOptions& options, Baked volume) {
    const std::size_t channels = volume.channel_names.size();
    const auto texels =
        std::make_shared<VoxelArray>(flat_texels(table, bake.size, channels, options));
    VolumeFinish finish;
    finish.reference_name = volume.certificate.reference;
    finish.expensive = bake.table == BrunetonTable::irradiance;
    finish.reference = flat_values(table.reference, table.channels, bake.size, channels);
    if (finish.expensive) {
        const auto row = [&table](double y, const std::vector<double>& x, double* values) {
            table.row(0, y, x, values);
        };
        finish.estimate = flat_values(row, table.channels, bake.size, channels);
    }
    finish.probe_place = [&place, &bake](const std::array<double, 3>& uvw, int) {
        return probe_place_of(place, bake.size, uvw);
    };
    finish.histogram_ranges = texels->ranges();
    add_voxels(bake.size, texels, volume);
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(std::move(volume), finish, options);
}

}  // namespace

TableModel flat_irradiance(const SkyLight& light, const std::vector<double>& solar_irradiance) {
    const double thickness_km = light.shell().thickness_km;
    const auto colours = static_cast<std::size_t>(light.medium().air.channels);
    // Darker suns are the darkest to higher orders too (sun_axis.h), and nothing of the air is lit.
    const double darkest = make_sun_axis(light.shell(), kFewestColumns).darkest;
    const auto row_of = [&light, &solar_irradiance, colours, thickness_km,
                         darkest](const IrradianceNodes& nodes) -> FlatRow {
        return [&light, &solar_irradiance, nodes, colours, thickness_km, darkest](
                   double y, const std::vector<double>& x, double* values) {
            std::vector<double> suns;  // each once
            std::vector<std::size_t> sun_of;
            for (const double at : x) {
                const double sun = std::max(2 * at - 1, darkest);
                if (suns.empty() || sun != suns.back()) suns.push_back(sun);
                sun_of.push_back(suns.size() - 1);
            }
            const std::vector<Spectrum> irradiances =
                sky_irradiances(light, y * thickness_km, suns, nodes);
            for (const std::size_t i : sun_of) {
                for (std::size_t c = 0; c < colours; ++c) {
                    *values++ = irradiances[i][c] * solar_irradiance[c];
                }
            }
        };
    };
    TableModel table;
    table.channels = light.medium().air.channels;
    table.row = [row = row_of(kFlatNodes)](int, double y, const std::vector<double>& x,
                                           double* values) { row(y, x, values); };
    table.reference = row_of(kReferenceNodes);
    return table;
}

Outcome<Baked> bake_bruneton_transmittance(const TableModel& table, const Shell& shell,
                                           const BrunetonBake& bake, const BakeOptions& options,
                                           Baked volume) {
    volume.content = "transmittance from a point to the top of the atmosphere (dimensionless)";
    volume.mapping = "bruneton_transmittance";
    volume.axes = {
        {{"distance_to_top_km",
          "x = (d - d_min) / (d_max - d_min), d_min = R_top - r, d_max = rho + H; 0 straight up, 1 "
          "the horizon",
          kConventionText, 0, 1},
         {"altitude_km",
          "x = rho / H, rho = sqrt(h (2 R_ground + h)), h the altitude, H = rho at the top",
          kConventionText, 0, shell.thickness_km},
         {"none", "one texel", kConventionText, 0, 0}}};
    describe_flat_axes(shell, volume);
    volume.certificate.reference =
        "adaptive Gauss-Kronrod quadrature of extinction along the ray, 1e-10";
    const auto place = [shell](double& x, double& y) {
        const UnitCoordinates off = off_the_horizon(shell, {x, y});
        x = off.x_mu;
        y = off.x_r;
        const TransmittanceRay ray = transmittance_ray(shell, off);
        return Place{{"altitude_km", ray.altitude_km}, {"cos_zenith", cos_zenith_of(shell, ray)}};
    };
    return bake_flat(table, place, bake, options, std::move(volume));
}

Outcome<Baked> bake_bruneton_irradiance(const TableModel& table, const Shell& shell,
                                        const BrunetonBake& bake, const BakeOptions& options,
                                        Baked volume) {
    const double thickness_km = shell.thickness_km;
    volume.content =
        "irradiance of a level surface that faces up, by the sky without the sun, times the solar "
        "irradiance";
    volume.mapping = "bruneton_irradiance";
    volume.axes = {
        {{"sun_cos_zenith", "x = (mu_s + 1) / 2", kConventionText, -1, 1},
         {"altitude_km", "x = altitude / (R_top - R_ground)", kConventionText, 0, thickness_km},
         {"none", "one texel", kConventionText, 0, 0}}};
    describe_flat_axes(shell, volume);
    volume.certificate.reference = "the same integral over more directions";
    const auto place = [thickness_km](double& x, double& y) {
        return Place{{"altitude_km", y * thickness_km}, {"sun_cos_zenith", 2 * x - 1}};
    };
    return bake_flat(table, place, bake, options, std::move(volume));
}

}  // namespace skybake
