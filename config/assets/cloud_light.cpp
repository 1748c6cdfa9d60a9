#include "config/assets/cloud_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/file_decoder.h"
#include "config/assets/source_volume.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"
#include "config/sections/parameters.h"

namespace skybake::config {
namespace {

constexpr Range light_cell_range{1, most_cloud_light_cell};
constexpr double degree_in_radians = std::numbers::pi / 180;
// A ray at 1 degree passes 57 voxels for each one that it rises.
constexpr Range sun_range{degree_in_radians, std::numbers::pi / 2};

constexpr Choice contents_choices[] = {
    {CloudLightContents::optical_depth, "optical_depth",
     "from a point to each sun, through the layer as it repeats"},
    {CloudLightContents::transmittance, "transmittance", "exp(-optical depth) to each sun"},
    {CloudLightContents::shadow, "shadow",
     "a map of one slice: the optical depth of the whole layer, from its base to each sun"},
    {CloudLightContents::optical_depth_harmonics, "optical_depth_harmonics",
     "optical depth to suns anywhere above the horizon, as harmonics of their directions"},
    {CloudLightContents::transmittance_harmonics, "transmittance_harmonics",
     "transmittance to suns anywhere above the horizon, as harmonics of their directions"},
    {CloudLightContents::sky_visibility, "sky_visibility",
     "transmittance to the sky, and 0 below the horizon, as harmonics of the direction"},
    {CloudLightContents::sun_radiance, "sun_radiance",
     "sunlight that the cloud scatters at least twice, as harmonics of its direction of travel"},
    {CloudLightContents::sky_radiance, "sky_radiance",
     "light of a uniform sky that the cloud scatters, of all orders, as such harmonics"},
    {CloudLightContents::clear_sky_radiance, "clear_sky_radiance",
     "the same of the recipe's clear sky under one sun, for a mean radiance of 1"},
    {CloudLightContents::ground_radiance, "ground_radiance",
     "light of uniform ground that the cloud scatters, of all orders, as such harmonics"},
};

constexpr Words of_suns = {"optical_depth", "transmittance", "shadow", "sun_radiance",
                           "clear_sky_radiance"};
constexpr Words in_harmonics = {"optical_depth_harmonics",
                                "transmittance_harmonics",
                                "sky_visibility",
                                "sun_radiance",
                                "sky_radiance",
                                "clear_sky_radiance",
                                "ground_radiance"};
constexpr Words of_radiance = {"sun_radiance", "sky_radiance", "clear_sky_radiance",
                               "ground_radiance"};

const Row<CloudLightBake> cloud_light_table[] = {
    {source_volume_field, &CloudLightBake::of},
    {source_channel_field, &CloudLightBake::channel},
    {"contents", Kind::choice, &CloudLightBake::contents, "what the channels hold",
     contents_choices, Default{R"("optical_depth")"}},
    {"sun_elevations", Kind::angles, &CloudLightBake::sun_elevations,
     "one, three or four suns, each with a channel; radiance takes one", sun_range,
     KeyFlag::required, Hint{"for example [\"60 deg\", \"30 deg\", \"10 deg\"]"},
     When{"contents", of_suns}},
    {"sun_azimuths", Kind::angles, &CloudLightBake::sun_azimuths,
     "azimuth of each sun, from +x towards +y; by default all 0", turn_range,
     When{"contents", of_suns}},
    {"degree", Kind::integer, &CloudLightBake::degree,
     "degree of the harmonics, which have (degree + 1)^2 coefficients", harmonics_degree_range,
     Default{"1"}, When{"contents", in_harmonics}},
    {"part", Kind::integer, &CloudLightBake::part,
     "which four of the coefficients the channels are; degree 2 has 3 parts, degree 3 has 4",
     Range{1, 4}, Default{"1"}, When{"contents", in_harmonics}},
    {"cell", Kind::integer, &CloudLightBake::cell,
     "voxels along each edge of a texel: 4 gives 1/64 as many texels as the volume has voxels; by "
     "default 2 of what is stored for each sun, whose shadows have edges",
     light_cell_range, Default{"4"}, Hint{"2 to 8"}, Exclusive{"size"}},
    {"max_error", Kind::fraction, &CloudLightBake::max_error,
     "in place of cell, asks for the fewest texels of which the RMS error of lookups within cloud "
     "is at most this share of the light that nothing shades",
     lookup_error_range, Hint{"for example \"5 %\""}, Exclusive{"size"},
     When{"contents",
          {"optical_depth", "transmittance", "shadow", "optical_depth_harmonics",
           "transmittance_harmonics", "sky_visibility"}}},
    {with(droplet_diameter_field, When{"contents", of_radiance}),
     &CloudLightBake::droplet_diameter},
    {with(single_scattering_albedo_field, When{"contents", of_radiance}),
     &CloudLightBake::single_scattering_albedo},
};

VoxelCounts texels_of(const CloudVolumeBake& volume, int cell, bool is_map) {
    VoxelCounts texels = cells_of(volume, cell);
    if (is_map) texels[2] = 1;
    return texels;
}

void check_cells(const DecodedSection& bake, const CloudVolumeBake& volume,
                 const VoxelCounts& texels, const RecipeSoFar& recipe, Decoder& decoder) {
    const Cloud* cloud = find_cloud(volume, recipe);
    if (!cloud || cloud->extent[0].meters <= 0 || texels[2] == 1) return;
    CloudVolumeBake coarse = volume;
    coarse.size = texels;
    check_cubes(bake, voxel_edges(*cloud, coarse), bake.at("of").source->place, decoder);
}

// Depths beyond what halves hold are floats by default. No ray to a sun of elevation e is deeper than
// the layer's extinction times its thickness over sin(e), which is at least 2 e / pi.
void derive_pixel_type(DecodedSection& bake, CloudLightContents contents, const Cloud* cloud) {
    constexpr double largest_half = 65504;
    const auto* elevations = bake.value<std::vector<double>>("sun_elevations");
    if (!is_depth(contents) || !cloud || !elevations) return;
    const double lowest = *std::ranges::min_element(*elevations);
    const double depth = cloud->extinction_scale.per_meter * cloud->extent[2].meters *
                         std::numbers::pi / (2 * lowest);
    DecodedField& type = bake.at("pixel_type");
    if (!(depth <= largest_half)) derive(type, chosen(*type.field, PixelType::float32));
}

// Returns how many of the four channels of a part hold coefficients.
std::size_t harmonics_in_part(int degree, int part) {
    const int coefficients = (degree + 1) * (degree + 1);
    return static_cast<std::size_t>(std::clamp(coefficients - 4 * (part - 1), 0, 4));
}

// This is one section while it is checked.
struct ContentsCheck {
    const DecodedSection& bake;
    Decoder& decoder;

    std::size_t angles(std::string_view key) const {
        const auto* value = bake.value<std::vector<double>>(key);
        return value ? value->size() : 0;
    }

    // Returns the number of suns, or 1 if it cannot be told.
    std::size_t check_suns() const {
        const std::size_t suns = angles("sun_elevations");
        if (suns == 2 || suns > 4) {
            decoder.report("E0129", bake, "sun_elevations",
                           fmt::format("has {} suns, and a file one, three or four channels", suns),
                           suns == 2 ? "add a sun, or bake them as two assets"
                                     : "bake them as several assets of at most four suns");
        }
        check_azimuths();
        return std::clamp<std::size_t>(suns, 1, 4);
    }

    void check_azimuths() const {
        const std::size_t suns = angles("sun_elevations");
        const std::size_t azimuths = angles("sun_azimuths");
        if (azimuths > 0 && suns > 0 && azimuths != suns) {
            decoder.report(
                "E0171", bake, "sun_azimuths",
                fmt::format("has {} azimuths for {} sun{}", azimuths, suns, suns == 1 ? "" : "s"),
                "give one azimuth for each elevation");
        }
    }

    void check_sun_of_radiance() const {
        const std::size_t suns = angles("sun_elevations");
        if (suns > 1) {
            decoder.report("E0176", bake, "sun_elevations",
                           fmt::format("has {} suns, and a file the radiance of one", suns),
                           "give one elevation, and bake an asset for each sun");
        }
        check_azimuths();
    }

    std::size_t check_part() const {
        const std::optional<int> degree = bake.whole("degree");
        const std::optional<int> part = bake.whole("part");
        if (!degree || !part) return 1;
        const std::size_t channels = harmonics_in_part(*degree, *part);
        if (channels > 0) return channels;
        const int coefficients = (*degree + 1) * (*degree + 1);
        const int parts = (coefficients + 3) / 4;
        decoder.report(
            "E0171", bake, "part",
            fmt::format("is {}, but harmonics of degree {} have {} coefficient{} in {} part{}",
                        *part, *degree, coefficients, coefficients == 1 ? "" : "s", parts,
                        parts == 1 ? "" : "s"),
            fmt::format("use at most {}", parts));
        return 1;
    }
};

// Returns the number of channels, or 1 if it cannot be told. It reports a number of suns that no file
// holds (E0129), azimuths that are not one for each sun and a part that the harmonics do not have
// (E0171), and several suns of one file of radiance (E0176).
std::size_t check_contents(const DecodedSection& bake, CloudLightContents contents,
                           Decoder& decoder) {
    const ContentsCheck check{bake, decoder};
    if (is_per_sun(contents)) return check.check_suns();
    if (is_of_one_sun(contents)) check.check_sun_of_radiance();
    return check.check_part();
}

// Reports a clear sky without an atmosphere, and a cloud that rises above the air (E0189). `cloud` is
// null if it has errors.
void check_clear_sky(const DecodedSection& bake, const Cloud* cloud, const RecipeSoFar& recipe,
                     Decoder& decoder) {
    const Atmosphere& air = recipe.parameters.atmosphere;
    const double thickness_m = air.top_radius.meters - air.ground_radius.meters;
    if (air.top_radius.meters <= 0) {
        if (!decoder.complete || decoder.diagnostics.has_errors()) return;
        return decoder.report("E0189", bake, "contents",
                              "needs a sky, and the recipe has no [atmosphere]",
                              "give the recipe an atmosphere, for instance preset = \"earth\"");
    }
    if (!cloud) return;
    const double top_m = cloud->base_altitude.meters + cloud->extent[2].meters;
    if (thickness_m <= 0 || top_m < thickness_m) return;
    decoder.report(
        "E0189", bake, "contents",
        fmt::format("needs air above the cloud, whose top is at {}", length_to_string(top_m)),
        fmt::format("the air ends {} above the ground", length_to_string(thickness_m)));
}

// Fills in the number of `mips`. It reports a name that is not a cloud volume's (E0133), a channel
// that the volume does not have (E0134), a number of suns that no file holds (E0129), azimuths that
// are not one for each sun and a part that the harmonics do not have (E0171), several suns of one
// file of radiance (E0176), a clear sky that is not above the layer (E0189), and faults of the files of any volume (file_decoder.h). It warns of
// texels that are not cubes (W0211).
void resolve_cloud_light(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const auto contents = choice_of<CloudLightContents>(bake.at("contents"));
    const std::size_t channels = contents ? check_contents(bake, *contents, decoder) : 1;
    const CloudVolumeBake* volume = find_source_volume(bake, recipe, decoder);
    if (contents == CloudLightContents::clear_sky_radiance) {
        check_clear_sky(bake, volume ? find_cloud(*volume, recipe) : nullptr, recipe, decoder);
    }
    if (volume && contents) derive_pixel_type(bake, *contents, find_cloud(*volume, recipe));
    // A chosen size and a cell exclude each other, also in the recipe that a file carries.
    const bool is_chosen = bake.at("max_error").value.has_value();
    if (contents && is_per_sun(*contents) && !is_chosen) derive(bake.at("cell"), 2.0);
    check_pixel_type(bake, decoder);
    if (!volume) return;
    check_source_channel(bake, *volume, recipe, decoder);
    if (is_chosen) {
        check_chosen_files(bake, "cell", decoder);
        check_channels(bake, channels, decoder);
        return;
    }
    const std::optional<int> cell = bake.whole("cell");
    if (!cell || !contents || volume->size[0] == 0) return;
    const VoxelCounts texels = texels_of(*volume, *cell, *contents == CloudLightContents::shadow);
    resolve_files(bake, texels, Halving::down, decoder);
    check_cells(bake, *volume, texels, recipe, decoder);
    check_voxel_count(bake, texels, channels, bake.at("of").source->place, decoder);
}

std::vector<Read> reads_of(const Parameters& parameters, const CloudLightBake& bake) {
    std::vector<Read> reads = reads_of_source_volume(parameters, bake.of);
    if (bake.contents == CloudLightContents::clear_sky_radiance) {
        append(reads_of_light(parameters, Roles::all()), reads);
    }
    return reads;
}

}  // namespace

std::size_t channels_of(const CloudLightBake& bake) {
    return is_per_sun(bake.contents) ? bake.sun_elevations.size()
                                     : harmonics_in_part(bake.degree, bake.part);
}

AssetKind asset_kind(Tag<CloudLightBake>) {
    return make_asset_kind<CloudLightBake>(
        {.name = "cloud_light",
         .documentation = "the light within a cloud volume, in place of a march towards the sun",
         .of_another_bake = true},
        with_file_fields(cloud_light_table, {.formats = R"(["exr"])"}), reads_of,
        resolve_cloud_light);
}

}  // namespace skybake::config
