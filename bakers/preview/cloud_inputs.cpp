#include "bakers/preview/cloud_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "bakers/preview/check_options.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/frames.h"
#include "config/text/mapped.h"

namespace skybake {

namespace {

template <class Section>
const Section* section_named(const Parameters& parameters, const std::string& name) {
    const auto bake = std::ranges::find(parameters.bakes, name, &Bake::name);
    return bake != parameters.bakes.end() ? bake->find<Section>() : nullptr;
}

// Returns the bake of a frame of clouds, or null.
const CloudVolumeBake* frame_bake(const PreviewAssets& assets, const PreviewAsset& asset) {
    if (!assets.recipe || asset.voxels.empty()) return nullptr;
    const std::string& name = asset.entry.name;
    const auto* bake = section_named<CloudVolumeBake>(assets.recipe->parameters, name);
    const bool is_frame = bake != nullptr && bake->frame > 0 && config::sequence_name(name) != name;
    return is_frame ? bake : nullptr;
}

bool is_played(const PagePicture& picture) { return picture.frames_per_second > 0; }

// Returns the place of a cloud volume among the frames that a preview shows, or nothing if it is no frame
// or the only one that is shown.
std::optional<SequenceFrame> sequence_frame(const PreviewAssets& assets,
                                            const PreviewAsset& asset) {
    const CloudVolumeBake* own = frame_bake(assets, asset);
    if (own == nullptr) return std::nullopt;
    SequenceFrame frame = {config::sequence_name(asset.entry.name), 0, 0, 0};
    for (const PreviewAsset& other : assets.assets) {
        const CloudVolumeBake* bake = frame_bake(assets, other);
        if (bake == nullptr || config::sequence_name(other.entry.name) != frame.sequence) continue;
        if (frame.count == 0) frame.per_second = bake->frames_per_second;
        if (&other == &asset) frame.index = frame.count;
        ++frame.count;
    }
    if (frame.count < 2) return std::nullopt;
    return frame;
}

}  // namespace

void SequenceScenes::share_exposures(CloudPreviewInput& input) const {
    if (!input.frame) return;
    const auto found = std::ranges::find(sequences_, input.frame->sequence, &Sequence::name);
    if (found != sequences_.end()) input.exposures = found->exposures;
}

void SequenceScenes::take(const SequenceFrame& frame, std::vector<PagePicture>& pictures) {
    const auto others = std::stable_partition(pictures.begin(), pictures.end(), is_played);
    auto sequence = std::ranges::find(sequences_, frame.sequence, &Sequence::name);
    if (sequence == sequences_.end()) {
        sequence = sequences_.insert(sequence, Sequence{frame.sequence, {}, {}});
        sequence->scene.title = frame.sequence + ", frame by frame";
        sequence->scene.content = fmt::format(
            "The pictures show {} frames of {}, which play at {:g} per second. All have the camera "
            "and the exposure of the first one.",
            frame.count, frame.sequence, frame.per_second);
        sequence->scene.clouds = true;
        for (auto picture = pictures.begin(); picture != others; ++picture) {
            sequence->exposures.push_back(picture->exposure.value_or(1));
        }
    }
    std::move(pictures.begin(), others, std::back_inserter(sequence->scene.pictures));
    pictures.erase(pictures.begin(), others);
}

std::vector<PageScene> SequenceScenes::scenes() && {
    return mapped<PageScene>(sequences_, [](Sequence& one) { return std::move(one.scene); });
}

namespace {

const Cloud* cloud_of(const Parameters& parameters, const CloudVolumeBake* bake) {
    const auto cloud = std::ranges::find_if(
        parameters.clouds, [&](const Cloud& one) { return bake && one.name == bake->cloud; });
    return cloud == parameters.clouds.end() ? nullptr : &*cloud;
}

void add_occupancy(const PreviewAssets& assets, CloudPreviewInput& input) {
    const Parameters& parameters = assets.recipe->parameters;
    for (const PreviewAsset& asset : assets.assets) {
        const auto* bake = section_named<OccupancyBake>(parameters, asset.entry.name);
        if (bake == nullptr || bake->of != input.volume->entry.name || asset.voxels.empty())
            continue;
        input.occupancy = &asset;
        input.occupancy_bake = bake;
        return;
    }
}

void add_sky(const PreviewAssets& assets, CloudPreviewInput& input) {
    input.transmittance = assets.of_kind("transmittance");
    input.multiple_scattering = assets.of_kind("multiple_scattering");
    input.air = &*assets.recipe;
}

void choose_light(const PreviewOptions& options, CloudPreviewInput& input) {
    const double heading = input.camera.heading_degrees.value_or(kHeading);
    const double azimuth = options.sun_azimuth_deg.value_or(heading + kSunBesideView);
    std::vector<double> elevations = options.sun_elevations_deg;
    if (elevations.empty()) elevations = {input.suns.front().elevation_degrees};
    input.suns.clear();
    for (const double elevation : elevations) input.suns.push_back({elevation, azimuth});
    input.exposure_stops = options.exposure_stops;
    input.tone_curve = options.tone_curve.value_or(ToneCurve::film);
    input.table_sky = options.table_sky;
}

// Adds a picture against the light, unless somebody has placed the sun, or has many pictures made.
void add_light_against(const PreviewOptions& options, CloudPreviewInput& input) {
    input.last_is_against =
        !options.sun_azimuth_deg && !options.draft && !input.frame && options.turntable == 0;
    if (!input.last_is_against) return;
    const double heading = input.camera.heading_degrees.value_or(kHeading);
    input.suns.push_back({input.suns.front().elevation_degrees, heading + kSunAgainstView});
}

// Chooses the camera and the size of pictures. For a draft, the size is at most 768 along its
// longer edge; the draft then has half of it.
void choose_frame(const PreviewOptions& options, CloudPreviewInput& input) {
    constexpr int longest_of_draft = 768;
    if (options.camera) input.camera = *options.camera;
    if (options.picture_size) {
        input.width = (*options.picture_size)[0];
        input.height = (*options.picture_size)[1];
    }
    input.camera.whole_tile = input.frame.has_value();
    input.single = options.single || options.turntable > 0;
    input.turntable = options.turntable;
    input.progress = options.progress;
    input.light = options.light;
    input.draft = options.draft;
    const int longest = std::max(input.width, input.height);
    if (!options.draft || longest <= longest_of_draft) return;
    input.width = std::max(input.width * longest_of_draft / longest, 1);
    input.height = std::max(input.height * longest_of_draft / longest, 1);
}

}  // namespace

CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options) {
    CloudPreviewInput input;
    if (!assets.recipe || asset.voxels.empty()) return input;
    const Parameters& parameters = assets.recipe->parameters;
    const std::string& name = asset.entry.name;
    if (const auto* grid = section_named<OccupancyBake>(parameters, name)) {
        input.volume_bake = section_named<CloudVolumeBake>(parameters, grid->of);
        input.cloud = cloud_of(parameters, input.volume_bake);
        input.occupancy = &asset;
        input.occupancy_bake = grid;
    } else if (const auto* volume = section_named<CloudVolumeBake>(parameters, name)) {
        input.volume_bake = volume;
        input.cloud = cloud_of(parameters, volume);
        input.volume = &asset;
        add_occupancy(assets, input);
        add_sky(assets, input);
        if (options.turntable == 0) input.frame = sequence_frame(assets, asset);
    }
    choose_frame(options, input);
    choose_light(options, input);
    if (!has_scene(lit_pictures_of(assets), options)) add_light_against(options, input);
    return input;
}

std::vector<CloudPreviewInput> scene_input(const PreviewAssets& assets,
                                           const PreviewOptions& options) {
    std::vector<CloudPreviewInput> layers;
    for (const PreviewAsset& asset : assets.assets) {
        CloudPreviewInput input = cloud_input(assets, asset, options);
        if (input.volume == nullptr || input.cloud == nullptr) continue;
        const auto same = std::ranges::find_if(
            layers, [&](const auto& other) { return other.cloud->name == input.cloud->name; });
        if (same == layers.end()) {
            layers.push_back(std::move(input));
        } else if (input.volume->voxels.size() > same->volume->voxels.size()) {
            *same = std::move(input);
        }
    }
    for (CloudPreviewInput& layer : layers) {
        if (!layer.last_is_against) add_light_against(options, layer);
    }
    return layers;
}

namespace {

using config::OccupancyContent;

// Returns the values of the channel `content` as they were before storing.
std::optional<std::vector<float>> values_of(const PreviewAsset& grid, const OccupancyBake& bake,
                                            OccupancyContent content) {
    const auto found = std::ranges::find(bake.contents, content);
    if (found == bake.contents.end()) return std::nullopt;
    const auto channel = static_cast<std::size_t>(found - bake.contents.begin());
    const bool is_share = content == OccupancyContent::leap && occupancy::is_unorm(bake.pixel_type);
    const float scale = is_share ? 255.0F : 1.0F;
    std::vector<float> values;
    for (std::size_t i = channel; i < grid.voxels.size(); i += bake.contents.size()) {
        values.push_back(grid.voxels[i] * scale);
    }
    return values;
}

std::array<int, 3> size_of(const ManifestAsset& entry) {
    return {entry.size[0], entry.size[1], entry.size[2]};
}

}  // namespace

std::optional<std::vector<float>> leaps_of_grid(const PreviewAsset& grid, const OccupancyBake& bake,
                                                float threshold) {
    if (!grid.entry.is_volume()) return std::nullopt;
    const std::array<int, 3> size = size_of(grid.entry);
    if (grid.voxels.size() != occupancy::count_of(size) * bake.contents.size()) return std::nullopt;
    if (auto leaps = values_of(grid, bake, OccupancyContent::leap)) {
        for (float& leap : *leaps) leap = std::round(leap);  // a unorm value is a quotient by 255
        return leaps;
    }
    for (const auto& [content, greatest_empty] :
         {std::pair(OccupancyContent::occupied, 0.0F),
          std::pair(OccupancyContent::maximum, threshold)}) {
        const auto values = values_of(grid, bake, content);
        if (!values) continue;
        const auto occupied = [empty = greatest_empty](float value) -> std::uint8_t {
            return value > empty ? 1 : 0;
        };
        const auto leaps =
            occupancy::leap_distance({size, mapped<std::uint8_t>(*values, occupied)});
        return std::vector<float>(leaps.begin(), leaps.end());
    }
    return std::nullopt;
}

std::optional<LeapGrid> leap_grid_of(const PreviewAsset& volume, const PreviewAsset& grid,
                                     const OccupancyBake& bake, float threshold) {
    const bool sees_all = bake.rule == config::OccupancyRule::exact &&
                          bake.filter != config::OccupancyFilter::nearest &&
                          (bake.channel.empty() || bake.channel == volume.entry.channels.front());
    if (!sees_all || bake.of != volume.entry.name || !grid.entry.is_volume()) return std::nullopt;
    const std::array<int, 3> voxels = size_of(volume.entry);
    if (occupancy::CellGrid{voxels, bake.cell}.size() != size_of(grid.entry)) return std::nullopt;
    const auto leaps = leaps_of_grid(grid, bake, threshold);
    if (!leaps) return std::nullopt;
    return leap_grid(voxels, bake.cell, *leaps);
}

}  // namespace skybake
