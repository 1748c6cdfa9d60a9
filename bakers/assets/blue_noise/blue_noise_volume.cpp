// The baker of asset = "blue_noise".
#include "bakers/assets/blue_noise/blue_noise_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "bakers/assets/blue_noise/mask_figures.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_array.h"
#include "bakers/noise/torus_energy.h"
#include "bakers/noise/void_and_cluster.h"

namespace skybake {
namespace {

using config::BlueNoiseBake;

std::vector<AxisMapping> axes_of(const std::array<int, 3>& size) {
    static constexpr std::array<const char*, 3> kQuantities = {"x_px", "y_px", "frame"};
    std::vector<AxisMapping> axes(3);
    for (std::size_t i = 0; i < 3; ++i) {
        axes[i].quantity = kQuantities[i];
        axes[i].formula = fmt::format("{} = {} / {}", "uvw"[i], kQuantities[i], size[i]);
        axes[i].convention =
            fmt::format("repeats; voxel k has {} from k to k + 1, look up nearest", kQuantities[i]);
        axes[i].last = size[i];
        axes[i].end_points = TexelConvention::end_points_on_edges;
        axes[i].wrap = AxisWrap::repeat;
        axes[i].filter = AxisFilter::nearest;
        axes[i].constants = {{"period", static_cast<double>(size[i])}};
    }
    return axes;
}

// The nearest place that is a quarter of a voxel from a voxel's middle along each axis: rounding
// does not reach the next voxel, and linear lookups differ.
ProbePlace place_of(const std::array<int, 3>& size, const std::array<double, 3>& uvw) {
    static constexpr std::array<const char*, 3> kQuantities = {"x_px", "y_px", "frame"};
    ProbePlace place{{}, {{}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const double position = (uvw[i] - std::floor(uvw[i])) * size[i];
        const double voxel = std::min(std::floor(position), size[i] - 1.0);
        const double at = voxel + (position - voxel < 0.5 ? 0.25 : 0.75);
        place.at.emplace_back(kQuantities[i], at);
        place.lookups.front().uvw[i] = at / size[i];
    }
    return place;
}

Certificate certificate_of(const MaskView& mask) {
    Certificate certificate;
    certificate.texel = unevenness(mask);
    certificate.lookup = window_error(mask);
    certificate.texel_points = static_cast<int>(mask.values->size());
    certificate.lookup_points = static_cast<int>(mask.values->size());
    const int columns = std::min(kMaskWindow, mask.size[0]);
    const int rows = std::min(kMaskWindow, mask.size[1]);
    certificate.reference = fmt::format(
        "texels: sorted values of a frame against evenly spread ones; lookups: means of {} x {} "
        "pixels against 1/2, of which independent values would have an RMS of {:.2g}",
        columns, rows, std::sqrt(1.0 / (12.0 * columns * rows)));
    certificate.scale = "all values, 0 to 1";
    return certificate;
}

std::shared_ptr<const VoxelArray> mask_voxels(const BlueNoiseBake& bake,
                                              const std::vector<std::uint32_t>& ranks) {
    const auto pixels =
        static_cast<std::size_t>(bake.size[0]) * static_cast<std::size_t>(bake.size[1]);
    std::vector<float> values;
    values.reserve(ranks.size());
    for (const std::uint32_t rank : ranks) {
        values.push_back(round_to_pixel_type(double{mask_value(rank, pixels, bake.pixel_type)},
                                             bake.pixel_type));
    }
    return std::make_shared<VoxelArray>(bake.voxels(), std::vector<std::vector<float>>{values});
}

Outcome<Baked> bake(const Parameters&, const BlueNoiseBake& asset, const BakeOptions& options,
                    AssetLabel label) {
    return bake_blue_noise(asset, options, labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters&, const BlueNoiseBake& asset) {
    constexpr double kSecondsPerVoxel = 2.5e-6;
    constexpr double kBytesPerVoxel = 21;  // energies in tiles of 8 x 8 pixels, twice, and ranks
    std::array<int, 3> tiled = asset.voxels();
    constexpr int kEdge = noise::kTileEdge;
    for (std::size_t i = 0; i < 2; ++i) tiled[i] = (tiled[i] + kEdge - 1) / kEdge * kEdge;
    Estimate result = estimate_volume(asset, asset.voxels(), 1, kSecondsPerVoxel);
    result.memory_mib += voxels_of(tiled, 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters&, const BlueNoiseBake& asset, const StoredTexels&) {
    return single_lookup({"x_px", "y_px", "frame"}, [size = asset.voxels()](const Place& at) {
        Uvw uvw;
        for (std::size_t i = 0; i < 3; ++i) uvw[i] = at[i].second / size[i];
        return uvw;
    });
}

AssetLookup lookup(const Parameters&, const BlueNoiseBake&, const StoredTexels& stored) {
    GlslFunction function;
    function.comment =
        "Returns the value of a pixel, such as gl_FragCoord.xy, in a frame: the number of the "
        "frame or any number between that and the next. Both may be beyond the mask, which "
        "repeats.";
    function.arguments = "sampler3D table, vec2 pixel, float frame";
    function.value = fmt::format("blue_noise(table, {}, pixel, frame)", glsl_size(stored.size));
    return {"blue_noise", {with_channels(stored.channels, 4, std::move(function))}};
}

// A mask of 64 x 64 pixels and 8 frames takes a twentieth of a second.
void draft(BlueNoiseBake& asset, int) {
    for (int& edge : asset.size) edge = std::min(edge, 64);
    asset.frames = std::min(asset.frames, 8);
}

}  // namespace

float mask_value(std::uint32_t rank, std::size_t pixels, PixelType type) {
    if (type != PixelType::unorm8 && type != PixelType::unorm16) {
        return static_cast<float>((rank + 0.5) / static_cast<double>(pixels));
    }
    const std::uint64_t codes = type == PixelType::unorm8 ? 256 : 65536;
    const std::uint64_t code = codes * rank / pixels;
    return static_cast<float>(static_cast<double>(code) / static_cast<double>(codes - 1));
}

Outcome<Baked> bake_blue_noise(const BlueNoiseBake& bake, const BakeOptions& options,
                               Baked volume) {
    const std::vector<std::uint32_t> ranks = noise::void_and_cluster_ranks(
        {bake.voxels(), bake.spatial_sigma, bake.temporal_sigma, bake.seed}, options);
    if (options.cancelled()) return {};
    const std::shared_ptr<const VoxelArray> voxels = mask_voxels(bake, ranks);

    volume.kind = "blue_noise";
    volume.content = "blue noise, dimensionless: in each frame all values are equally frequent";
    volume.mapping = "pixels";
    volume.axes = axes_of(bake.voxels());
    volume.channel_names = {"Y"};
    set_files(bake, volume);
    volume.voxel_size_m.fill(1.0 / bake.size[0]);  // the mask is a metre wide
    volume.up_axis = "+z";
    const MaskView mask{bake.voxels(), &voxels->channel(0)};
    volume.details.emplace_back("low_power_of_frames", to_digits(low_power_of_frames(mask), 3));
    volume.details.emplace_back("low_power_over_time", to_digits(low_power_over_time(mask), 3));
    add_voxels(bake.voxels(), voxels, volume);
    return finish_volume(
        std::move(volume),
        {.histogram_ranges = {{0, 1}},
         .measure = [&mask](const Baked&, const BakeOptions&) { return certificate_of(mask); },
         .probe_place = [&bake](const std::array<double, 3>& uvw,
                                int) { return place_of(bake.voxels(), uvw); }},
        options);
}

Baker<BlueNoiseBake> baker(BakerTag<BlueNoiseBake>) {
    return {.version = 1,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .draft = draft};
}

}  // namespace skybake
