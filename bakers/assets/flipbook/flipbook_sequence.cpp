#include "bakers/assets/flipbook/flipbook_sequence.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/noise_volume/noise_volume.h"
#include "bakers/assets/weather_map/weather_map_table.h"
#include "bakers/field/block_voxels.h"
#include "config/sections/frames.h"

namespace skybake {

using config::NoiseVolumeBake;
using config::WeatherMapBake;

namespace {

// Makes a frame as its own baker does, before its blocks are coded.
Outcome<Baked> numbers_of_frame(const Parameters& at_its_time, const Bake& first,
                                const BakeOptions& options) {
    if (const auto* noise = first.find<NoiseVolumeBake>()) {
        return {make_noise_volume(noise_named(at_its_time, noise->noise), *noise, {}), {}};
    }
    if (const auto* map = first.find<WeatherMapBake>()) {
        return make_weather_map(noise_named(at_its_time, map->noise), *map, options, {});
    }
    const auto& bake = first.as<CloudVolumeBake>();
    Facts details;
    const Outcome<CloudInputs> inputs = cloud_inputs(at_its_time, bake, details, options);
    if (!inputs.value) return {{}, inputs.diagnostics};
    return {make_cloud_volume(cloud_named(at_its_time, bake.cloud), bake, *inputs.value, {}), {}};
}

}  // namespace

Layer layer_of(const VoxelSource& source, const VoxelBox& box, std::size_t channels) {
    Layer values(channels * static_cast<std::size_t>(box.count()));
    std::vector<float*> targets;
    for (std::size_t c = 0; c < channels; ++c) {
        targets.push_back(values.data() + c * static_cast<std::size_t>(box.count()));
    }
    source.fill(box, targets);
    return values;
}

Outcome<Baked> make_frame(const Parameters& at_its_time, const Bake& first,
                          const BakeOptions& options) {
    Outcome<Baked> frame = numbers_of_frame(at_its_time, first, options);
    if (frame.value) code_levels(*frame.value);
    return frame;
}

std::vector<Diagnostic> FlipbookSequence::read() {
    for (int frame = 1; frame <= asset.length + 1; ++frame) {
        Outcome<Baked> made = make_frame(config::at_frame(parameters, frame), first, options);
        if (!made.value) return std::move(made.diagnostics);
        if (frame <= asset.length) voxels.push_back(made.value->levels.front().voxels);
        if (frame == 1) kind = *made.value;
        if (frame > asset.length) loops = shown_of(*made.value) == shown_of(kind);
    }
    return {};
}

// The slice of a frame that the flipbook shows.
Layer FlipbookSequence::shown_of(const Baked& frame) const {
    const auto [width, height, depth] = frame.levels.front().size;
    return layer_of(*frame.levels.front().voxels, {{0, 0, asset.slice}, {width, height, 1}},
                    frame.channel_names.size());
}

std::array<int, 3> FlipbookSequence::size() const {
    const auto [width, height, depth] = kind.levels.front().size;
    return {width, height, asset.length};
}

std::vector<std::array<double, 2>> FlipbookSequence::usual_ranges() const {
    if (const auto* noise = first.find<NoiseVolumeBake>()) {
        return skybake::usual_ranges(noise_named(parameters, noise->noise));
    }
    return std::vector<std::array<double, 2>>(kind.channel_names.size(), {0, 1});
}

FrameVoxels::FrameVoxels(std::vector<std::shared_ptr<const VoxelSource>> frames, int slice)
    : frames_(std::move(frames)), slice_(slice) {}

VoxelBox FrameVoxels::slice_of(const VoxelBox& box) const {
    return {{box.origin[0], box.origin[1], slice_}, {box.size[0], box.size[1], 1}};
}

void FrameVoxels::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    const VoxelBox part = slice_of(box);
    std::vector<float*> targets = channels;
    for (int z = 0; z < box.size[2]; ++z) {
        frames_[static_cast<std::size_t>(box.origin[2] + z)]->fill(part, targets);
        for (float*& target : targets) {
            if (target != nullptr) target += part.count();
        }
    }
}

bool FrameVoxels::is_empty(const VoxelBox& box) const {
    const auto begin = frames_.begin() + box.origin[2];
    return std::all_of(begin, begin + box.size[2],
                       [&](const auto& frame) { return frame->is_empty(slice_of(box)); });
}

}  // namespace skybake
