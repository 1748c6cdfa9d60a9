#include "bakers/assets/optical_depth/column_volume.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/air/ray.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/optical_depth/column_kinds.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/voxel_array.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake {

using config::DepthSampling;
using config::OpticalDepthBake;
using config::OpticalDepthTable;

namespace {

constexpr auto kColumnTexels = TexelConvention::end_points_on_texel_centres;
constexpr const char* kCentres = "end points on texel centres; lookups are clamped";

// The values of some texels along x, from `first` on, in the channel of a kind.
using ChannelValues = std::function<std::vector<double>(
    std::size_t kind, const std::array<int, 3>& first, int count)>;

class TexelSource : public VoxelSource {
  public:
    TexelSource(std::size_t kinds, ChannelValues values)
        : kinds_(kinds), values_(std::move(values)) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        fill_rows(box, channels, [&](std::size_t c, int y, int z, float* out) {
            std::vector<double> row(static_cast<std::size_t>(box.size[0]));
            // The third channel of two kinds is 0.
            if (c < kinds_) row = values_(c, {box.origin[0], y, z}, box.size[0]);
            for (const double value : row) *out++ = static_cast<float>(value);
        });
    }

  private:
    std::size_t kinds_;
    ChannelValues values_;
};

std::vector<std::string> channel_names(std::size_t kinds) {
    return names_of_channels(kinds == 2 ? 3 : kinds);
}

// Values of kinds, and 0 in channels beyond.
std::vector<double> as_channels(std::vector<double> values) {
    values.resize(channel_names(values.size()).size());
    return values;
}

// One table: its texels, and how they are measured.
struct Contents {
    ChannelValues values;
    VolumeFinish finish;
    double largest = 1;  // value, about: where histograms end
};

bool has_paths(const OpticalDepthBake& bake) {
    return bake.table == OpticalDepthTable::to_top || bake.table == OpticalDepthTable::between;
}

// Mean densities as the bake finds them.
using MeanDensities = std::function<std::vector<double>(const ColumnKind& kind,
                                                        const std::vector<ColumnPath>& paths)>;

MeanDensities mean_densities_of(const OpticalDepthBake& bake,
                                const std::vector<ColumnKind>& kinds) {
    if (bake.sampling == DepthSampling::exact) return mean_densities;
    const double top_km = bake.max_altitude.kilometers();
    const std::vector<double> shells =
        bake.sampling == DepthSampling::uniform
            ? uniform_shells_km(top_km, bake.shells)
            : equal_attenuation_shells_km(mean_scale_height_km(kinds), top_km, bake.shells);
    return [shells](const ColumnKind& kind, const std::vector<ColumnPath>& paths) {
        return mapped<double>(paths, [&](const ColumnPath& path) {
            return sampled_mean_density(kind, shells, path);
        });
    };
}

using Kinds = std::shared_ptr<const std::vector<ColumnKind>>;

Contents columns(const Kinds& kinds, int channels, const OpticalDepthBake& bake,
                 const ColumnTable& table) {
    Contents result;
    result.values = [kinds, table, means = mean_densities_of(bake, *kinds)](
                        std::size_t k, const std::array<int, 3>& first, int count) {
        std::vector<ColumnPath> paths;
        for (int i = 0; i < count; ++i) {
            paths.push_back(table.path_of_texel({first[0] + i, first[1], first[2]}));
        }
        std::vector<double> stored = means((*kinds)[k], paths);
        for (double& value : stored) value = stored_of_mean_density(value);
        return stored;
    };
    result.finish.reference = [kinds, table](const std::array<double, 3>& uvw) {
        const ColumnPath path = table.path_at(uvw);
        auto values = mapped<double>(*kinds, [&](const ColumnKind& kind) {
            return stored_of_mean_density(reference_mean_density(kind, path));
        });
        return as_channels(std::move(values));
    };
    result.finish.reference_name = "adaptive quadrature of the densities along each path";
    const auto passing = [kinds, channels](double length_km, const std::vector<double>& stored) {
        std::vector<double> means;
        for (std::size_t k = 0; k < kinds->size(); ++k) {
            means.push_back(mean_density_of_stored(stored[k]));
        }
        return transmittances(*kinds, channels, length_km, means);
    };
    result.finish.comparison.errors = [table, passing](const std::array<double, 3>& uvw,
                                                       const std::vector<double>& found,
                                                       const std::vector<double>& wanted) {
        const double length_km = table.path_at(uvw).length_km;
        std::vector<double> errors = passing(length_km, found);
        const std::vector<double> exact = passing(length_km, wanted);
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= exact[i];
        return errors;
    };
    result.finish.comparison.lookup_place = [table](const std::array<double, 3>& uvw) {
        return table.lookup_place(uvw);
    };
    result.finish.probe_place = [table](const std::array<double, 3>& uvw, int) {
        return column_probe_place(table, uvw);
    };
    result.finish.comparison.scale =
        "a transmittance of 1: of all kinds together and of each alone, with the layers' "
        "extinction";
    return result;
}

double unit_coordinate(double u, int size) { return size == 1 ? 0 : (u * size - 0.5) / (size - 1); }

// One axis, along u.
using AlongAxis = std::function<double(std::size_t kind, double x)>;

// Returns the name of an axis's quantity, and its value at a coordinate.
using AxisPlace = std::function<std::pair<std::string, double>(double x)>;

Contents along_axis(std::size_t kinds, int size, AlongAxis value, AxisPlace place) {
    Contents result;
    result.values = [value, size](std::size_t k, const std::array<int, 3>& first, int count) {
        std::vector<double> values;
        for (int x = first[0]; x < first[0] + count; ++x) {
            values.push_back(value(k, texel_coordinate(kColumnTexels, x, size)));
        }
        return values;
    };
    result.finish.reference = [kinds, value, size](const std::array<double, 3>& uvw) {
        std::vector<double> values;
        for (std::size_t k = 0; k < kinds; ++k) {
            values.push_back(value(k, unit_coordinate(uvw[0], size)));
        }
        return as_channels(std::move(values));
    };
    result.finish.comparison.lookup_place = [size](const std::array<double, 3>& uvw) {
        const double edge = 0.5 / size;
        return std::array<double, 3>{edge + uvw[0] * (1 - 2 * edge), uvw[1], uvw[2]};
    };
    result.finish.probe_place = [place = std::move(place), size](const std::array<double, 3>& uvw,
                                                                 int) {
        const double x = std::clamp(unit_coordinate(uvw[0], size), 0.0, 1.0);
        return ProbePlace{{place(x)}, {{{texture_coordinate(kColumnTexels, x, size), 0.5, 0.5}}}};
    };
    return result;
}

Contents densities(const Kinds& kinds, const OpticalDepthBake& bake,
                   const ColumnGeometry& geometry) {
    Contents result = along_axis(
        kinds->size(), bake.size[0],
        [kinds, geometry](std::size_t k, double x) {
            return density_of((*kinds)[k], altitude_at(geometry.scale, x));
        },
        [geometry](double x) {
            return std::pair<std::string, double>("altitude_km", altitude_at(geometry.scale, x));
        });
    result.finish.reference_name = "the layers' profiles";
    return result;
}

// p at the scattering angle pi x^2.
double phase_at(const PhaseFunction& phase, double x) {
    const SineCosine half = sine_and_cosine(0.5 * std::numbers::pi * x * x);
    return phase_value(phase, 2 * half.sine * half.sine, 2 * half.cosine * half.cosine);
}

Contents phase_functions(const Kinds& kinds, const OpticalDepthBake& bake) {
    std::vector<PhaseFunction> phases;
    for (const ColumnKind& kind : *kinds) {
        const LayerPhase phase = layer_phase(kind.layer);
        phases.push_back(phase.functions[phase.functions.size() / 2]);  // the middle wavelength's
    }
    Contents result = along_axis(
        kinds->size(), bake.size[0],
        [phases](std::size_t k, double x) { return phase_at(phases[k], x); },
        [](double x) {
            return std::pair<std::string, double>("scattering_angle_deg", 180 * x * x);
        });
    for (const PhaseFunction& phase : phases) {
        result.largest = std::max({result.largest, phase_at(phase, 0), phase_at(phase, 1)});
    }
    result.finish.reference_name = "the layers' phase functions";
    result.finish.comparison.errors = [count = kinds->size()](const std::array<double, 3>&,
                                                              const std::vector<double>& found,
                                                              const std::vector<double>& wanted) {
        std::vector<double> errors;
        for (std::size_t k = 0; k < count; ++k) errors.push_back(found[k] / wanted[k] - 1);
        return errors;
    };
    result.finish.comparison.scale = "the phase function's own value";
    return result;
}

std::string angle_formula(const OpticalDepthBake& bake, const ColumnTable& table) {
    const bool to_top = bake.table == OpticalDepthTable::to_top;
    const bool by_distance = !to_top && bake.coordinates == config::BetweenCoordinates::distance;
    const char* start = to_top || by_distance ? "h" : "low";
    std::string text = fmt::format(
        "path rises all along: x = 1 - sqrt(1 - (d - d0) / (dh - d0)), d the distance to the {}, "
        "d0 of a vertical path, dh of one that is level at {}; passes its lowest point at hp: x = "
        "sqrt(1 - g(hp) / g({}))",
        to_top || by_distance ? "top" : "other point", start, start);
    if (by_distance) {
        text +=
            "; falls to the ground: x = (rho - d) / (rho - h), d the distance to the ground, rho "
            "to the horizon";
    }
    text += "; u = (first + 1/2 + x (count - 1)) / size with (first, count)";
    for (const RayTexels& texels : table.kinds()) {
        text += fmt::format(" ({}, {})", texels.first, texels.count);
    }
    return text;
}

std::string scale_text(const ColumnGeometry& geometry) {
    return fmt::format("g(h) = sqrt(ln(1 + h / {0:.9g}) / ln(1 + {1:.9g} / {0:.9g})), h in km",
                       geometry.scale.fine_km, geometry.scale.thickness_km);
}

void describe_columns(const OpticalDepthBake& bake, const ColumnTable& table, Baked& volume) {
    const ColumnGeometry& geometry = table.geometry();
    const double top = geometry.scale.thickness_km;
    const std::string g = scale_text(geometry);
    const bool to_top = bake.table == OpticalDepthTable::to_top;
    volume.content = fmt::format(
        "t = (column / length)^(1/8) of a path of `length` km {}: column = t^8 length in km, "
        "optical depth = extinction at density 1 (1/km) times column; a path without length has "
        "the density itself",
        to_top ? "to the top of the atmosphere" : "between two points");
    volume.axes[0] = {"path_angle", angle_formula(bake, table), kCentres, 0, 1};
    if (to_top) {
        volume.mapping = "columns_to_top";
        volume.axes[1] = {"altitude_km", "v from g(h); " + g, kCentres, 0, top};
        volume.axes[2] = {"none", "one texel", kCentres, 0, 0};
    } else if (bake.coordinates == config::BetweenCoordinates::altitudes) {
        volume.mapping = "columns_between_altitudes";
        volume.axes[1] = {"high_altitude_km", "v from g(high); " + g, kCentres, 0, top};
        volume.axes[2] = {"low_altitude_km", "w from g(low) / g(high)", kCentres, 0, top};
    } else {
        volume.mapping = "columns_along_distance";
        volume.axes[1] = {"altitude_km", "v from g(h); " + g, kCentres, 0, top};
        volume.axes[2] = {"end_altitude_km",
                          "path rises: w from sqrt((g(h') - g(h)) / (1 - g(h))), h' where it ends; "
                          "passes: from (b(h') - b(h)) / (b(top) - b(h)), b = sqrt(g - g(hp)), "
                          "negative before hp; falls: from 1 - sqrt(g(h') / g(h))",
                          kCentres, 0, top};
    }
}

void describe_axis(const OpticalDepthBake& bake, const ColumnGeometry& geometry, Baked& volume) {
    if (bake.table == OpticalDepthTable::density) {
        volume.content = "density, in shares of the density that the layer's coefficients are for";
        volume.mapping = "densities";
        volume.axes[0] = {"altitude_km", "u from g(h); " + scale_text(geometry), kCentres, 0,
                          geometry.scale.thickness_km};
    } else {
        volume.content =
            "phase function (1/sr), its integral over directions 1; of spheres that of the middle "
            "wavelength";
        volume.mapping = "phase_functions";
        volume.axes[0] = {"scattering_angle_deg", "u from sqrt(angle / 180)", kCentres, 0, 180};
    }
    for (const std::size_t axis : {1u, 2u})
        volume.axes[axis] = {"none", "one texel", kCentres, 0, 0};
}

// F of g(h) is fine_km. `first` and `count` are those of the texels of each kind along u: of
// paths that rise, that pass their lowest point and, by distance, that fall to the ground.
void describe_constants(const OpticalDepthBake& bake, const ColumnTable& table, Baked& volume) {
    if (bake.table == OpticalDepthTable::phase) {
        volume.conventions.angle_unit = "deg";
        volume.axes[0].constants = {{"range_deg", 180.0}};
        return;
    }
    const ColumnGeometry& geometry = table.geometry();
    Facts scale = shell_constants(geometry.shell);
    scale.emplace_back("fine_km", geometry.scale.fine_km);
    for (AxisMapping& axis : volume.axes) {
        if (axis.quantity != "none") axis.constants = scale;
    }
    if (!has_paths(bake)) return;
    volume.details.emplace_back("mean_density_exponent", 8.0);
    std::vector<double> first;
    std::vector<double> count;
    for (const RayTexels& texels : table.kinds()) {
        first.push_back(texels.first);
        count.push_back(texels.count);
    }
    volume.axes[0].constants.emplace_back("first", std::move(first));
    volume.axes[0].constants.emplace_back("count", std::move(count));
}

void describe(const OpticalDepthBake& bake, const std::vector<ColumnKind>& kinds, int channels,
              const ColumnTable& table, Baked& volume) {
    volume.kind = "optical_depth";
    volume.channel_names = channel_names(kinds.size());
    volume.axes.resize(3);
    if (has_paths(bake)) {
        describe_columns(bake, table, volume);
    } else {
        describe_axis(bake, table.geometry(), volume);
    }
    set_files(bake, volume);
    volume.voxel_size_m.fill(1.0 / bake.size[0]);  // texture space, a metre wide
    volume.up_axis = "+y";
    describe_constants(bake, table, volume);
    const auto add = [&](std::string name, FactValue value) {
        volume.details.emplace_back(std::move(name), std::move(value));
    };
    add("ground_radius_km", to_digits(table.geometry().shell.ground_radius_km, 9));
    add("thickness_km", to_digits(table.geometry().shell.thickness_km, 9));
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const Spectrum& extinction = kinds[k].extinction_per_km;
        add(fmt::format("channel_{}", volume.channel_names[k]), kinds[k].name);
        add(fmt::format("extinction_per_km_{}", kinds[k].name),
            to_digits(std::vector<double>(data(extinction), data(extinction) + channels), 9));
    }
    if (has_paths(bake) && bake.sampling == DepthSampling::equal_attenuation) {
        add("mean_scale_height_km", to_digits(mean_scale_height_km(kinds), 9));
    }
}

// Errors by kind, and how well columns add up: against the exact integral, which is fast.
void add_measured_details(const std::vector<ColumnKind>& kinds, int channels,
                          const ColumnTable& table, bool to_top, const BakeOptions& options,
                          Baked& volume) {
    constexpr int kQuickPoints = 1024;
    constexpr int kFullPoints = 16384;
    const int points = options.certification == Certification::full ? kFullPoints : kQuickPoints;
    const ColumnErrors errors = measure_columns(kinds, channels, table, to_top,
                                                volume.levels.front(), volume.pixel_type, points);
    const auto add = [&](const std::string& name, const ErrorFigures& figures) {
        volume.details.emplace_back(name + "_max", to_digits(figures.max, 3));
        volume.details.emplace_back(name + "_rms", to_digits(figures.rms, 3));
    };
    add("transmittance_error_together", errors.together);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        add(fmt::format("transmittance_error_{}", kinds[k].name), errors.alone[k]);
    }
    add("additivity_error", errors.additivity);
    if (!to_top) add("symmetry_error", errors.symmetry);
}

Contents contents_of(const Kinds& kinds, int channels, const OpticalDepthBake& bake,
                     const ColumnTable& table) {
    if (has_paths(bake)) return columns(kinds, channels, bake, table);
    if (bake.table == OpticalDepthTable::density) return densities(kinds, bake, table.geometry());
    return phase_functions(kinds, bake);
}

Kinds kinds_of(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake) {
    return std::make_shared<const std::vector<ColumnKind>>(
        make_column_kinds(atmosphere, bake.kinds));
}

int channels_of(const config::Atmosphere& atmosphere) {
    return static_cast<int>(atmosphere.ground_albedo.size());
}

// Texels of more floats than this are made each time they are asked for.
constexpr std::int64_t kKeptFloats = 1 << 24;

std::shared_ptr<const VoxelSource> kept_if_small(std::shared_ptr<const VoxelSource> texels,
                                                 const std::array<int, 3>& size, int channels,
                                                 const BakeOptions& options) {
    if (VoxelBox{{}, size}.count() * channels > kKeptFloats) return texels;
    return std::make_shared<VoxelArray>(read_voxels(*texels, size, channels, options, "mips"));
}

}  // namespace

ColumnVoxels column_voxels(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake) {
    const Kinds kinds = kinds_of(atmosphere, bake);
    const ColumnTable table(bake, column_geometry(*kinds));
    Contents contents = contents_of(kinds, channels_of(atmosphere), bake, table);
    return {std::make_shared<TexelSource>(kinds->size(), std::move(contents.values)),
            std::move(contents.finish.reference), std::move(contents.finish.comparison)};
}

Outcome<Baked> bake_columns(const config::Atmosphere& atmosphere, const OpticalDepthBake& bake,
                            const BakeOptions& options, Baked volume) {
    const Kinds kinds = kinds_of(atmosphere, bake);
    const int channels = channels_of(atmosphere);
    const ColumnTable table(bake, column_geometry(*kinds));
    describe(bake, *kinds, channels, table, volume);
    Contents contents = contents_of(kinds, channels, bake, table);
    contents.finish.histogram_ranges.assign(volume.channel_names.size(), {0, contents.largest});
    add_voxels(
        bake.size,
        kept_if_small(std::make_shared<TexelSource>(kinds->size(), std::move(contents.values)),
                      bake.size, static_cast<int>(volume.channel_names.size()), options),
        volume);
    add_mip_levels(bake.mips, options, volume);
    Outcome<Baked> outcome = finish_volume(std::move(volume), contents.finish, options);
    if (outcome.value && has_paths(bake) && options.certification != Certification::off) {
        const BakeTime time(BakePart::certificate);
        add_measured_details(*kinds, channels, table, bake.table == OpticalDepthTable::to_top,
                             options, *outcome.value);
    }
    return outcome;
}

}  // namespace skybake
