#include "config/assets/aerial_perspective.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/fields/field_reader.h"
#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Choice aerial_content_choices[] = {
    {AerialContent::in_scatter_and_transmittance, "in_scatter_and_transmittance",
     "light in R, G, B and the channels' mean transmittance in A"},
    {AerialContent::in_scatter, "in_scatter", "light alone"},
    {AerialContent::transmittance, "transmittance", "transmittance alone, of each channel"},
};

constexpr Choice slices_choices[] = {
    {SliceSpacing::linear, "linear", "w = distance / view_distance"},
    {SliceSpacing::squared, "squared",
     "w = sqrt(distance / view_distance): closer together near the camera"},
};

constexpr Choice slices_begin_choices[] = {
    {SlicesBegin::camera, "camera", "distances count from the camera"},
    {SlicesBegin::air, "air",
     "distances count from where each view ray enters the air, and end with twice its way to the "
     "ground, or its way through the air"},
};

const Row<AerialPerspectiveBake> aerial_perspective_table[] = {
    {"size", Kind::voxels, &AerialPerspectiveBake::size,
     "voxels across and down the picture, and the number of slices", texel_range,
     Default{"[32, 32, 32]"}, Cited{hillaire_2020}},
    {"content", Kind::choice, &AerialPerspectiveBake::content, "what the channels hold",
     aerial_content_choices, Default{R"("in_scatter_and_transmittance")"}},
    {camera_altitude_field, &AerialPerspectiveBake::altitude},
    {"sun_elevation", Kind::angle, &AerialPerspectiveBake::sun_elevation,
     "elevation of the sun at the camera", elevation_range, KeyFlag::required},
    {"heading", Kind::angle, &AerialPerspectiveBake::heading,
     "camera heading, clockwise from the sun's azimuth", turn_range, Default{R"("0 deg")"}},
    {"pitch", Kind::angle, &AerialPerspectiveBake::pitch,
     "camera pitch, upwards from the horizontal", elevation_range, Default{R"("0 deg")"}},
    {"fov", Kind::angle, &AerialPerspectiveBake::fov, "angle between the lower and the upper edge",
     Range{0, std::numbers::pi, true, true}, Default{R"("60 deg")"}},
    {"aspect", Kind::number, &AerialPerspectiveBake::aspect, "width of the picture over its height",
     Range{1e-3, 1e3}, Default{"1.7777777777777777"}},
    {"view_distance", Kind::length, &AerialPerspectiveBake::view_distance,
     "distance at w = 1, from where the slices begin; by default that of [scene], or its default, "
     "and in space the longest way through the air",
     view_distance_range},
    {"slices", Kind::choice, &AerialPerspectiveBake::slices, "the distance that a slice stands for",
     slices_choices, Default{R"("squared")"}, Cited{hillaire_2020}},
    {"slices_begin", Kind::choice, &AerialPerspectiveBake::slices_begin,
     "where the slices begin; by default with the air for cameras in space", slices_begin_choices},
    {orders_field, &AerialPerspectiveBake::orders},
    {layers_field, &AerialPerspectiveBake::layers},
};

Length default_view_distance() {
    const Field& field = *find_field(*find_section("scene"), "view_distance");
    return {std::get<double>(*default_value(field, std::nullopt))};
}

void check_channels(const DecodedSection& bake, Decoder& decoder) {
    if (!decoder.channels || decoder.channels == 3) return;
    const auto content = choice_of<AerialContent>(bake.at("content"));
    if (content != AerialContent::in_scatter_and_transmittance) return;
    decoder.report(
        "E0129", bake, "content",
        fmt::format("is for three channels of light, and this recipe has {}", *decoder.channels),
        "bake content = \"in_scatter\" and content = \"transmittance\" as two assets");
}

// The longest way of a ray through the air, which grazes the ground.
double longest_way_m(const Atmosphere& atmosphere) {
    const double ground = atmosphere.ground_radius.meters;
    const double top = atmosphere.top_radius.meters;
    return 2 * std::sqrt((top - ground) * (top + ground));
}

// Slices of a camera in space begin with the air.
void resolve_slices(DecodedSection& bake, const Parameters& parameters) {
    const Atmosphere& air = parameters.atmosphere;
    const double thickness = air.top_radius.meters - air.ground_radius.meters;
    const std::optional<double> altitude = bake.number("altitude");
    if (!altitude || *altitude <= thickness) return;
    DecodedField& begin = bake.at("slices_begin");
    derive(begin, chosen(*begin.field, SlicesBegin::air));
    if (choice_of<SlicesBegin>(begin) != SlicesBegin::air) return;
    derive(bake.at("view_distance"), longest_way_m(air));
}

// Fills in the distance of view and the number of `mips`. It reports channels that cannot form an
// image (E0129) and faults of the files of any volume (file_decoder.h).
void resolve_aerial_perspective(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::optional<Scene>& scene = recipe.parameters.scene;
    derive(bake.at("view_distance"),
           scene ? scene->view_distance.meters : default_view_distance().meters);
    resolve_slices(bake, recipe.parameters);
    check_channels(bake, decoder);
    check_pixel_type(bake, decoder);
    const auto* voxels = bake.value<VoxelCounts>("size");
    if (!voxels) return;
    resolve_files(bake, *voxels, Halving::down, decoder);
    check_voxel_count(bake, *voxels, 4, bake.place_of("size"), decoder);
}

}  // namespace

AssetKind asset_kind(Tag<AerialPerspectiveBake>) {
    return make_asset_kind<AerialPerspectiveBake>(
        {.name = "aerial_perspective",
         .documentation = "the air between a camera and what it looks at",
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors},
        with_file_fields(aerial_perspective_table, {}), reads_of_all_light,
        resolve_aerial_perspective);
}

}  // namespace skybake::config
