#include "bakers/preview/sequences.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/frames.h"

namespace skybake {

namespace {

// Returns the bake of a frame of clouds, or null.
const config::CloudVolumeBake* frame_bake(const PreviewAssets& assets, const PreviewAsset& asset) {
    if (!assets.recipe || asset.voxels.empty()) return nullptr;
    for (const config::Bake& bake : assets.recipe->parameters.bakes) {
        const auto* volume = bake.find<config::CloudVolumeBake>();
        if (volume != nullptr && bake.name == asset.entry.name) {
            return volume->frame > 0 && config::sequence_name(bake.name) != bake.name ? volume
                                                                                      : nullptr;
        }
    }
    return nullptr;
}

bool is_played(const PagePicture& picture) { return picture.frames_per_second > 0; }

}  // namespace

std::optional<SequenceFrame> sequence_frame(const PreviewAssets& assets,
                                            const PreviewAsset& asset) {
    const config::CloudVolumeBake* own = frame_bake(assets, asset);
    if (own == nullptr) return std::nullopt;
    SequenceFrame frame = {config::sequence_name(asset.entry.name), 0, 0, 0};
    for (const PreviewAsset& other : assets.assets) {
        const config::CloudVolumeBake* bake = frame_bake(assets, other);
        if (bake == nullptr || config::sequence_name(other.entry.name) != frame.sequence) continue;
        if (frame.count == 0) frame.per_second = bake->frames_per_second;
        if (&other == &asset) frame.index = frame.count;
        ++frame.count;
    }
    if (frame.count < 2) return std::nullopt;
    return frame;
}

void SequenceScenes::share_exposures(CloudPreviewInput& input) const {
    if (!input.frame) return;
    const auto found = exposures_.find(input.frame->sequence);
    if (found != exposures_.end()) input.exposures = found->second;
}

void SequenceScenes::take(const SequenceFrame& frame, std::vector<PagePicture>& pictures) {
    const auto others = std::stable_partition(pictures.begin(), pictures.end(), is_played);
    const auto [scene, is_new] = scenes_.try_emplace(frame.sequence);
    if (is_new) {
        order_.push_back(frame.sequence);
        scene->second.title = frame.sequence + ", frame by frame";
        scene->second.content = fmt::format(
            "The pictures show {} frames of {}, which play at {:g} per second. All have the camera "
            "and "
            "the exposure of the first one.",
            frame.count, frame.sequence, frame.per_second);
        scene->second.clouds = true;
        for (auto picture = pictures.begin(); picture != others; ++picture) {
            exposures_[frame.sequence].push_back(picture->exposure.value_or(1));
        }
    }
    std::move(pictures.begin(), others, std::back_inserter(scene->second.pictures));
    pictures.erase(pictures.begin(), others);
}

std::vector<PageScene> SequenceScenes::scenes() && {
    std::vector<PageScene> all;
    for (const std::string& name : order_) all.push_back(std::move(scenes_.at(name)));
    return all;
}

}  // namespace skybake
