#include "bakers/assets/cloud_light/cloud_light_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bakers/assets/cloud_light/cloud_light_truth.h"
#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/cloud_light/texel_fit.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake {
namespace {

using cloud_light::CloudLayer;
using cloud_light::LightChannels;

// In the order of the enumerators.
constexpr std::string_view kMeanings[] = {
    "optical depth from a point to each sun",
    "transmittance from a point to each sun",
    "optical depth of the whole layer from a point of its base to each sun",
    "optical depth to suns above the horizon",
    "transmittance to suns above the horizon",
    "transmittance to the sky, 0 below the horizon",
    "radiance (1/sr) of sunlight scattered twice or more often, for a solar irradiance of 1, by "
    "direction of travel",
    "radiance (1/sr) of scattered light, for a sky of radiance 1, by direction of travel",
    "radiance (1/sr) of scattered light, for a clear sky of the mean radiance 1, by direction of "
    "travel",
    "radiance (1/sr) of scattered light, for ground of radiance 1, by direction of travel"};

std::string content_of(const CloudLightBake& bake) {
    const std::string_view meaning = kMeanings[static_cast<std::size_t>(bake.contents)];
    if (config::is_per_sun(bake.contents)) return fmt::format("{}, dimensionless", meaning);
    const auto first = 4 * (bake.part - 1);
    return fmt::format("{}: coefficients {} to {} of real spherical harmonics of degree {}",
                       meaning, first, first + static_cast<int>(config::channels_of(bake)) - 1,
                       bake.degree);
}

// Returns the axes of the cloud volume, which covers the same box.
std::vector<AxisMapping> axes_of(const Baked& of, const CloudLightBake& bake) {
    std::vector<AxisMapping> axes = of.axes;
    if (bake.contents == CloudLightContents::shadow) {
        axes[2].last = axes[2].first;
        axes[2].formula = "w = 1/2";
        axes[2].convention = "one slice, which holds the layer's base";
        axes[2].constants = {{"first_m", axes[2].first}, {"extent_m", 0.0}};
    }
    return axes;
}

void add_details(const CloudLayer& layer, const CloudLightBake& bake, Baked& volume) {
    const auto add = [&](std::string key, FactValue value) {
        volume.details.emplace_back(std::move(key), std::move(value));
    };
    add("of", bake.of);
    add("contents", word_of("cloud_light", "contents", bake.contents));
    add("cell", static_cast<double>(bake.cell));
    add("extinction_scale_per_m", layer.optics.extinction_per_m);
    const auto add_sun = [&](std::string key, const glm::dvec3& sun) {
        add(std::move(key),
            std::vector<double>{to_digits(sun.x, 12), to_digits(sun.y, 12), to_digits(sun.z, 12)});
    };
    if (!config::is_per_sun(bake.contents)) {
        add("degree", static_cast<double>(bake.degree));
        add("part", static_cast<double>(bake.part));
    }
    if (config::is_radiance(bake.contents)) {
        if (layer.optics.particles == config::CloudParticles::ice) {
            add("particles", "ice");
        } else {
            add("droplet_diameter_um", to_digits(bake.droplet_diameter.meters * 1e6, 12));
        }
        add("single_scattering_albedo", bake.single_scattering_albedo);
        add("extinction_share",
            to_digits(cloud_light::scaled_scattering_of(layer, bake).extinction_share, 12));
    }
    const std::vector<glm::dvec3> suns = cloud_light::sun_directions(bake);
    for (std::size_t i = 0; i < suns.size(); ++i) {
        add_sun(config::is_per_sun(bake.contents) ? "sun_" + volume.channel_names[i] : "sun",
                suns[i]);
    }
}

// The range of each channel's texels.
std::vector<std::array<double, 2>> texel_ranges(const VoxelArray& texels) {
    std::vector<std::array<double, 2>> ranges;
    for (std::size_t c = 0; c < texels.channels(); ++c) {
        const auto [least, most] = std::ranges::minmax_element(texels.channel(c));
        if (*most > *least) {
            ranges.push_back({*least, *most});
        } else {
            ranges.push_back({0, 1});
        }
    }
    return ranges;
}

VolumeFinish finish_of(const Baked& volume, const CloudLayer& layer, const CloudLightBake& bake,
                       const BakeOptions& options) {
    VolumeFinish finish;
    const bool is_map = bake.contents == CloudLightContents::shadow;
    finish.probe_place = [axes = volume.axes, is_map](std::array<double, 3> uvw, int) {
        if (is_map) uvw[2] = 0.5;
        return place_on(axes, uvw);
    };
    if (options.certification == Certification::off) return finish;
    CloudLightTruth truth = cloud_light_truth(layer, bake, options.threads);
    if (config::is_radiance(bake.contents) && options.certification == Certification::quick &&
        cloud_light::has_long_paths(layer, bake, truth.comparison, options.threads)) {
        return finish;
    }
    finish.reference = std::move(truth.reference);
    finish.reference_name = std::move(truth.name);
    finish.comparison = std::move(truth.comparison);
    finish.expensive = !config::is_per_sun(bake.contents);
    return finish;
}

// Returns the least and the greatest value of each channel. Coefficients of radiance have either sign.
std::vector<std::array<float, 2>> bounds_of(const CloudLightBake& bake, std::size_t count) {
    constexpr float kAny = std::numeric_limits<float>::max();
    std::vector<std::array<float, 2>> bounds(count, {-kAny, kAny});
    if (config::is_radiance(bake.contents)) return bounds;
    const LightChannels channels = cloud_light::light_channels(bake);
    for (std::size_t c = 0; c < count; ++c) bounds[c] = channels.bounds(c);
    return bounds;
}

}  // namespace

std::array<int, 3> cloud_light_size(const std::array<int, 3>& voxels, const CloudLightBake& bake) {
    std::array<int, 3> size{};
    for (std::size_t a = 0; a < 3; ++a) size[a] = (voxels[a] + bake.cell - 1) / bake.cell;
    if (bake.contents == CloudLightContents::shadow) size[2] = 1;
    return size;
}

int cloud_light_spacing(const CloudLightBake& bake) { return std::max(1, bake.cell / 2); }

std::vector<float> density_around(const CloudLayer& layer, const cloud_light::PlaceGrid& places,
                                  int threads) {
    std::vector<float> sums(occupancy::count_of(places.count));
    const auto place_of = [&](std::size_t axis, int voxel) {
        return static_cast<int>((voxel + 0.5) * places.count[axis] / places.voxels[axis]);
    };
    std::vector<int> columns;
    for (int x = 0; x < layer.size[0]; ++x) columns.push_back(place_of(0, x));
    parallel_for(places.count[2], threads, [&](int plane) {
        for (int z = 0; z < layer.size[2]; ++z) {
            if (place_of(2, z) != plane) continue;
            for (int y = 0; y < layer.size[1]; ++y) {
                float* row = &sums[occupancy::index_of(places.count, 0, place_of(1, y), plane)];
                for (int x = 0; x < layer.size[0]; ++x) {
                    row[columns[static_cast<std::size_t>(x)]] +=
                        static_cast<float>(density(layer.optics, double{layer.value(x, y, z)}));
                }
            }
        }
    });
    return sums;
}

SpacedValues cloud_light_values(const CloudLayer& layer, const CloudLightBake& bake, int spacing,
                                const BakeOptions& options, Facts& details) {
    SpacedValues values;
    values.places =
        cloud_light::place_grid(layer.size, spacing, bake.contents == CloudLightContents::shadow);
    values.channels =
        config::is_radiance(bake.contents)
            ? cloud_light::radiance_values(layer, values.places, bake, options, details)
            : cloud_light::light_values(layer, values.places, cloud_light::light_channels(bake),
                                        options);
    values.weights = values.places.at_base
                         ? std::vector<float>(occupancy::count_of(values.places.count), 1.0F)
                         : density_around(layer, values.places, options.threads);
    return values;
}

std::shared_ptr<const VoxelArray> fitted_texels(const SpacedValues& values,
                                                const std::array<int, 3>& size,
                                                const CloudLightBake& bake,
                                                const BakeOptions& options) {
    const auto bounds = bounds_of(bake, values.channels.size());
    const auto shown = config::is_depth(bake.contents) ? cloud_light::ShownAs::sunlight
                                                       : cloud_light::ShownAs::itself;
    const cloud_light::TexelFit fit(values.places.count, size, values.weights, options.threads);
    std::vector<std::vector<float>> texels;
    for (std::size_t c = 0; c < values.channels.size(); ++c) {
        const auto goes_on = [&](double share) {
            const double done = static_cast<double>(c) + share;
            const auto channels = static_cast<double>(values.channels.size());
            if (options.progress) options.progress->advance("texels", done / channels);
            return !options.cancelled();
        };
        texels.push_back(fit.fit(values.channels[c], shown, bounds[c], goes_on));
    }
    return std::make_shared<const VoxelArray>(size, std::move(texels));
}

Outcome<Baked> bake_cloud_light(const Baked& of, const CloudLayer& layer,
                                const CloudLightBake& bake, const BakeOptions& options,
                                Baked volume) {
    volume.kind = "cloud_light";
    volume.content = content_of(bake);
    volume.mapping = of.mapping;
    volume.axes = axes_of(of, bake);
    volume.channel_names = names_of_channels(config::channels_of(bake));
    volume.grid_names = volume.channel_names;
    set_files(bake, volume);
    const std::array<int, 3> size = cloud_light_size(layer.size, bake);
    for (std::size_t i = 0; i < 3; ++i) {
        volume.voxel_size_m[i] = of.voxel_size_m[i] * layer.size[i] / size[i];
    }
    volume.minimum_m = of.minimum_m;
    volume.up_axis = of.up_axis;
    volume.conventions = of.conventions;
    if (config::is_radiance(bake.contents)) volume.conventions.radiance_unit = "1/sr";
    add_details(layer, bake, volume);
    SpacedValues values =
        cloud_light_values(layer, bake, cloud_light_spacing(bake), options, volume.details);
    if (options.cancelled()) return {};
    const auto texels = fitted_texels(values, size, bake, options);
    if (options.cancelled()) return {};
    add_voxels(size, texels, volume);
    add_mip_levels(bake.mips, options, volume);
    VolumeFinish finish = finish_of(volume, layer, bake, options);
    if (!finish.reference && options.certification != Certification::off) {
        volume.details.emplace_back(
            "not_measured",
            fmt::format(
                "paths of light have more than {} collisions; --certify full waits for them",
                cloud_light::kMostCollisionsOfPath));
    }
    finish.histogram_ranges = texel_ranges(*texels);
    finish.sampled = volume.levels.front();
    finish.sampled->size = values.places.count;
    finish.sampled->voxels =
        std::make_shared<const VoxelArray>(values.places.count, std::move(values.channels));
    return finish_volume(std::move(volume), finish, options);
}

}  // namespace skybake
