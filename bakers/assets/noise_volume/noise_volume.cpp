// The baker of asset = "noise_volume".
#include "bakers/assets/noise_volume/noise_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>

#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/noise/noise_bounds.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/noise_reference.h"
#include "config/sections/parameters.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using config::NoiseSampling;
using config::NoiseVolumeBake;
using noise::NoiseField;
using noise::NoisePlan;

// Returns what is added to a place of the tile to find it in the texture: nothing along axes whose voxel
// i is at (i + 1/2) / size, and half a voxel along those where it is at i / size.
std::array<double, 3> shift_of(NoiseSampling sampling, const std::array<int, 3>& size) {
    std::array<double, 3> shift{};
    if (sampling != NoiseSampling::centers) shift[2] = 0.5 / size[2];
    for (std::size_t i = 0; i < 2 && sampling == NoiseSampling::corners; ++i) {
        shift[i] = 0.5 / size[i];
    }
    return shift;
}

std::vector<AxisMapping> axes_of(const std::array<int, 3>& size, NoiseSampling sampling) {
    static constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    static constexpr std::array<const char*, 3> kCoordinates = {"u", "v", "w"};
    const std::array<double, 3> shift = shift_of(sampling, size);
    std::vector<AxisMapping> axes(3);
    for (std::size_t i = 0; i < 3; ++i) {
        axes[i].quantity = fmt::format("{}_tile", kNames[i]);
        axes[i].last = 1;
        axes[i].end_points = TexelConvention::end_points_on_edges;
        axes[i].wrap = AxisWrap::repeat;
        axes[i].constants = {{"offset", shift[i]}};
        if (shift[i] == 0) {
            axes[i].formula = fmt::format("{} = {}", kCoordinates[i], kNames[i]);
            axes[i].convention = "repeats; voxel i samples (i + 1/2) / size";
        } else {
            axes[i].formula =
                fmt::format("{} = {} + 1 / (2 * {})", kCoordinates[i], kNames[i], size[i]);
            axes[i].convention = "repeats; voxel i samples i / size";
        }
    }
    return axes;
}

VolumeReference reference_of(const Noise& noise, const std::array<int, 3>& size) {
    return [&noise, shift = shift_of(noise.sampling, size)](std::array<double, 3> uvw) {
        for (std::size_t i = 0; i < 3; ++i) uvw[i] -= shift[i];
        return noise::noise_reference(noise, uvw);
    };
}

// A place of the tile, in [0, 1).
ProbePlace place_of(const std::array<int, 3>& size, NoiseSampling sampling,
                    const std::array<double, 3>& uvw) {
    static constexpr std::array<const char*, 3> kNames = {"x_tile", "y_tile", "z_tile"};
    const std::array<double, 3> shift = shift_of(sampling, size);
    ProbePlace place{{}, {{uvw}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const double at = uvw[i] - shift[i];
        place.at.emplace_back(kNames[i], at - std::floor(at));
    }
    return place;
}

double seam_error_of(const NoiseField& field, const std::array<int, 3>& size) {
    const auto channels = static_cast<std::size_t>(field.plan().output_channels());
    std::vector<NoiseField> beyond;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        beyond.emplace_back(noise::tile_beyond(field.plan(), axis));
    }
    return seam_error(field, size, channels, 3,
                      [&](std::size_t axis, const VoxelBox& voxel,
                          const std::vector<float*>& values) { beyond[axis].fill(voxel, values); });
}

// Lattices that are hashed, each once however many channels use it or derivatives it has.
std::size_t distinct_octaves(const NoisePlan& plan) {
    std::set<std::uint64_t> keys;
    for (const noise::CellField& field : plan.fields) keys.insert(field.key);
    for (const noise::ChannelPlan& channel : plan.channels) {
        for (const noise::GradientOctave& octave : channel.gradient.octaves)
            keys.insert(octave.key);
    }
    return keys.size();
}

Outcome<Baked> bake(const Parameters& parameters, const NoiseVolumeBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_noise_volume(noise_named(parameters, asset.noise), asset, options,
                             labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters& parameters, const NoiseVolumeBake& asset) {
    const Noise& noise = noise_named(parameters, asset.noise);
    const std::size_t channels = noise.pack == NoisePacking::none ? noise.channels.size() : 1;
    return estimate_volume(asset, asset.size, channels, octaves_of(noise) * kSecondsPerOctave);
}

AssetPlaces places(const Parameters& parameters, const NoiseVolumeBake& asset,
                   const StoredTexels&) {
    const Uvw shift = shift_of(noise_named(parameters, asset.noise).sampling, asset.size);
    return single_lookup({"x_tile", "y_tile", "z_tile"}, [shift](const Place& at) {
        return Uvw{at[0].second + shift[0], at[1].second + shift[1], at[2].second + shift[2]};
    });
}

// Along z a noise may have its voxels elsewhere than along x and y.
AssetLookup lookup(const Parameters& parameters, const NoiseVolumeBake& asset,
                   const StoredTexels& stored) {
    const Uvw shift = shift_of(noise_named(parameters, asset.noise).sampling, asset.size);
    GlslFunction function;
    function.comment =
        "Returns the noise. p is a point and `tile` the edges of a tile, in one unit.";
    function.arguments = "sampler3D table, vec3 p, vec3 tile";
    function.value = shift == Uvw{} ? "noise_volume(table, p, tile)"
                                    : fmt::format("noise_volume(table, p + tile * {}, tile)",
                                                  glsl_vector(shift));
    return {"noise", {with_channels(stored.channels, 4, std::move(function))}};
}

void draft(NoiseVolumeBake& asset, int most_voxels) {
    asset.size = reduced(asset.size, most_voxels);
    asset.mips = 1;
}

}  // namespace

std::vector<std::array<double, 2>> usual_ranges(const Noise& noise) {
    if (noise.pack != NoisePacking::none) return {{0, 1}};
    return mapped<std::array<double, 2>>(
        noise.channels, [&](const NoiseChannel& channel) { return noise::nominal_range(channel); });
}

Baked make_noise_volume(const Noise& noise, const NoiseVolumeBake& bake, Baked volume) {
    volume.kind = "noise_volume";
    volume.content = "noise, dimensionless; the volume repeats along x, y and z";
    volume.mapping = "tile";
    volume.axes = axes_of(bake.size, noise.sampling);
    volume.channel_names = config::channel_names(noise);
    set_files(bake, volume);
    volume.voxel_size_m.fill(1.0 / bake.size[0]);  // the tile is a metre wide
    volume.up_axis = "+z";
    volume.conventions.up_axis = volume.up_axis;

    const auto field = std::make_shared<const NoiseField>(noise::make_noise_plan(noise, bake.size));
    volume.details.emplace_back("distinct_octaves",
                                static_cast<double>(distinct_octaves(field->plan())));
    add_voxels(bake.size, field, volume);
    volume.seam_error = seam_error_of(*field, bake.size);
    return volume;
}

Outcome<Baked> bake_noise_volume(const Noise& noise, const NoiseVolumeBake& bake,
                                 const BakeOptions& options, Baked volume) {
    volume = make_noise_volume(noise, bake, std::move(volume));
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(
        std::move(volume),
        {.histogram_ranges = usual_ranges(noise),
         .reference = reference_of(noise, bake.size),
         .reference_name = "the noise's definition in double precision, point by point",
         .probe_place = [&noise, &bake](const std::array<double, 3>& uvw,
                                        int) { return place_of(bake.size, noise.sampling, uvw); }},
        options);
}

Baker<config::NoiseVolumeBake> baker(BakerTag<config::NoiseVolumeBake>) {
    return {.version = 5,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"formats"}}};
}

}  // namespace skybake
