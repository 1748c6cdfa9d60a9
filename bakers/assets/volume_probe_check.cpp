#include "bakers/assets/volume_probe_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <variant>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/bruneton/scattering_probe.h"
#include "bakers/assets/named_parameters.h"
#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_probe.h"
#include "bakers/field/finish_table.h"
#include "bakers/field/texel_axis.h"

namespace skybake {

namespace {

using config::BrunetonBake;
using config::BrunetonTable;
using config::Parameters;
using VolumeUvw = std::array<double, 3>;

constexpr auto kAtTexelCentres = TexelConvention::end_points_on_texel_centres;

// How the probes of an asset are looked up: the names of their coordinates, and what a runtime
// makes of the values, in this order.
struct PlaceLookup {
    std::vector<std::string> names;
    std::function<std::vector<ProbeLookup>(const Place& at, int level)> lookups;
};

// Of a function with a single lookup, the same for all levels.
PlaceLookup single(std::vector<std::string> names, std::function<VolumeUvw(const Place& at)> uvw) {
    return {std::move(names), [uvw = std::move(uvw)](const Place& at, int) {
                return std::vector<ProbeLookup>{{uvw(at)}};
            }};
}

Shell shell_of(const config::Atmosphere& atmosphere) {
    return {atmosphere.ground_radius.kilometers(),
            (atmosphere.top_radius.meters - atmosphere.ground_radius.meters) / 1000};
}

PlaceLookup lookup_of(const Parameters& parameters, const BrunetonBake& bake) {
    const Shell shell = shell_of(parameters.atmosphere);
    const std::array<int, 3> size = bake.size;
    const auto flat = [size](double x, double y) {
        return VolumeUvw{texture_coordinate(kAtTexelCentres, x, size[0]),
                         texture_coordinate(kAtTexelCentres, y, size[1]), 0.5};
    };
    if (bake.table == BrunetonTable::transmittance) {
        return single({"altitude_km", "cos_zenith"}, [shell, flat](const Place& at) {
            const UnitCoordinates x = transmittance_coordinates(shell, at[0].second, at[1].second);
            return flat(x.x_mu, x.x_r);
        });
    }
    if (bake.table == BrunetonTable::irradiance) {
        return single({"altitude_km", "sun_cos_zenith"}, [shell, flat](const Place& at) {
            return flat(0.5 * (at[1].second + 1), at[0].second / shell.thickness_km);
        });
    }
    const ScatteringMapping mapping(shell, size, bake.nu_size, bake.sun_cos_zenith_min);
    return {{"altitude_km", "cos_zenith", "sun_cos_zenith", "nu", "ground"},
            [mapping](const Place& at, int) {
                return scattering_lookups(
                    mapping, scattering_place(mapping, at[0].second, at[1].second, at[2].second,
                                              at[3].second, at[4].second != 0));
            }};
}

PlaceLookup lookup_of(const Parameters& parameters, const config::OpticalDepthBake& bake) {
    const ColumnTable table(bake,
                            column_geometry(make_column_kinds(parameters.atmosphere, bake.kinds)));
    const int size = bake.size[0];
    const auto along_u = [size](double x) {
        return VolumeUvw{texture_coordinate(kAtTexelCentres, x, size), 0.5, 0.5};
    };
    if (bake.table == config::OpticalDepthTable::density) {
        return single({"altitude_km"}, [table, along_u](const Place& at) {
            return along_u(scaled_altitude(table.geometry().scale, at[0].second));
        });
    }
    if (bake.table == config::OpticalDepthTable::phase) {
        return single({"scattering_angle_deg"}, [along_u](const Place& at) {
            return along_u(std::sqrt(at[0].second / 180));
        });
    }
    std::vector<std::string> names = {"altitude_km", "cos_zenith"};
    if (table.kind() == ColumnTableKind::between_altitudes) {
        names = {"low_altitude_km", "high_altitude_km", "angle_at_centre_deg"};
    } else if (table.kind() == ColumnTableKind::along_distance) {
        names.emplace_back("length_km");
    }
    return single(std::move(names),
                  [table](const Place& at) { return column_texture_coordinates(table, at); });
}

PlaceLookup lookup_of(const Parameters&, const config::AerialPerspectiveBake& bake) {
    const double whole_km = bake.view_distance.kilometers();
    const bool squared = bake.slices == config::SliceSpacing::squared;
    return single({"picture_x", "picture_y", "distance_km"}, [whole_km, squared](const Place& at) {
        const double share = at[2].second / whole_km;
        return VolumeUvw{at[0].second, at[1].second, squared ? std::sqrt(share) : share};
    });
}

PlaceLookup lookup_of(const Parameters& parameters, const config::NoiseVolumeBake& bake) {
    const config::NoiseSampling sampling = noise_named(parameters, bake.noise).sampling;
    const bool across = sampling != config::NoiseSampling::corners;
    const std::array<bool, 3> centered = {across, across,
                                          sampling == config::NoiseSampling::centers};
    return single({"x_tile", "y_tile", "z_tile"}, [centered, size = bake.size](const Place& at) {
        VolumeUvw uvw;
        for (std::size_t i = 0; i < 3; ++i) {
            uvw[i] = at[i].second + (centered[i] ? 0.0 : 0.5 / size[i]);
        }
        return uvw;
    });
}

PlaceLookup lookup_of(const config::Cloud& cloud, const VolumeUvw& extent_m) {
    const double base_m = cloud.base_altitude.meters;
    return single({"x_m", "y_m", "altitude_m"}, [extent_m, base_m](const Place& at) {
        return VolumeUvw{at[0].second / extent_m[0], at[1].second / extent_m[1],
                         (at[2].second - base_m) / extent_m[2]};
    });
}

VolumeUvw extent_m_of(const config::Cloud& cloud) {
    return {cloud.extent[0].meters, cloud.extent[1].meters, cloud.extent[2].meters};
}

PlaceLookup lookup_of(const Parameters& parameters, const config::CloudVolumeBake& bake) {
    const config::Cloud& cloud = cloud_named(parameters, bake.cloud);
    return lookup_of(cloud, extent_m_of(cloud));
}

// The cells of a level may go on beyond the volume that they are of.
PlaceLookup lookup_of(const Parameters& parameters, const config::OccupancyBake& bake) {
    const auto& of = std::get<config::CloudVolumeBake>(bake_named(parameters, bake.of).asset);
    const config::Cloud cloud = cloud_named(parameters, of.cloud);
    PlaceLookup lookup = lookup_of(cloud, extent_m_of(cloud));
    lookup.lookups = [cloud, of, cell = bake.cell](const Place& at, int level) {
        VolumeUvw extent_m = extent_m_of(cloud);
        for (std::size_t i = 0; i < 3; ++i) {
            const int edge = cell << level;
            const int cells = (of.size[i] + edge - 1) / edge;
            extent_m[i] *= static_cast<double>(edge) * cells / of.size[i];
        }
        return lookup_of(cloud, extent_m).lookups(at, level);
    };
    return lookup;
}

// A table, which has probes of another kind.
template <class Table>
requires(!std::is_base_of_v<config::VolumeFiles, Table>) PlaceLookup
    lookup_of(const Parameters&, const Table&) {
    return {};
}

bool are_alike(const VolumeUvw& found, const VolumeUvw& wanted,
               const std::array<bool, 3>& repeats) {
    for (std::size_t i = 0; i < 3; ++i) {
        double apart = found[i] - wanted[i];
        if (repeats[i]) apart -= std::round(apart);
        if (!(std::fabs(apart) <= 1e-9)) return false;
    }
    return true;
}

// An empty text where the probe's place and its texture coordinates are one.
std::string problem_of(const VolumeProbe& probe, int level, const PlaceLookup& lookup,
                       const std::array<bool, 3>& repeats) {
    const bool named = std::equal(
        probe.at.begin(), probe.at.end(), lookup.names.begin(), lookup.names.end(),
        [](const auto& coordinate, const std::string& name) { return coordinate.first == name; });
    if (!named) {
        return fmt::format("the coordinates of a probe are not {}", fmt::join(lookup.names, ", "));
    }
    const std::vector<ProbeLookup> wanted = lookup.lookups(probe.at, level);
    bool alike = are_alike(probe.uvw, wanted.front().uvw, repeats) &&
                 probe.blend.has_value() == (wanted.size() > 1);
    if (alike && probe.blend) {
        alike = are_alike(probe.blend->uvw, wanted[1].uvw, repeats) &&
                std::fabs(probe.blend->share - wanted[1].share) <= 1e-9;
    }
    if (alike) return {};
    return fmt::format("{} is at uvw {:.9g}, not at {:.9g}", place_text(probe.at),
                       fmt::join(wanted.front().uvw, ", "), fmt::join(probe.uvw, ", "));
}

}  // namespace

std::vector<std::string> check_volume_places(const ManifestAsset& asset,
                                             const Parameters& parameters, const config::Bake& bake,
                                             int& checks) {
    const PlaceLookup lookup =
        std::visit([&](const auto& volume) { return lookup_of(parameters, volume); }, bake.asset);
    std::vector<std::string> failures;
    if (!lookup.lookups) {
        ++checks;
        failures.push_back("its parameters are not those of a volume");
        return failures;
    }
    const std::array<bool, 3> repeats = repeating_axes(asset.mapping);
    for (std::size_t level = 0; level < asset.levels.size(); ++level) {
        for (const VolumeProbe& probe : asset.levels[level].probes) {
            ++checks;
            std::string problem = problem_of(probe, static_cast<int>(level), lookup, repeats);
            if (!problem.empty()) failures.push_back(std::move(problem));
        }
    }
    return failures;
}

}  // namespace skybake
