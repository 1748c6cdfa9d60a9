#include "config/assets/optical_depth.h"

#include <fmt/format.h>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/fields/fields.h"
#include "config/sections/layer.h"
#include "config/text/mapped.h"

namespace skybake::config {
namespace {

constexpr std::string_view ai_2014 = "Ai et al. 2014";

constexpr Choice depth_table_choices[] = {
    {OpticalDepthTable::to_top, "to_top",
     "column from a point to the top of the atmosphere, by angle and altitude"},
    {OpticalDepthTable::between, "between", "column between two points"},
    {OpticalDepthTable::density, "density", "density by altitude"},
    {OpticalDepthTable::phase, "phase", "phase functions, by scattering angle"},
};

constexpr Choice coordinates_choices[] = {
    {BetweenCoordinates::altitudes, "altitudes",
     "two altitudes and the angle between them at the planet's centre"},
    {BetweenCoordinates::distance, "distance", "altitude, zenith angle, distance along the ray"},
};

constexpr Choice depth_sampling_choices[] = {
    {DepthSampling::exact, "exact", "quadrature to the last digit"},
    {DepthSampling::equal_attenuation, "equal_attenuation",
     "shells that attenuate light from above equally, with one sample in each"},
    {DepthSampling::uniform, "uniform", "shells of equal thickness, with one sample in each"},
};

constexpr Words shells = {"equal_attenuation", "uniform"};

const Row<OpticalDepthBake> optical_depth_table[] = {
    {"table", Kind::choice, &OpticalDepthBake::table, "which of the tables to bake",
     depth_table_choices, Default{R"("to_top")"}, Cited{ai_2014}},
    {"size", Kind::voxels, &OpticalDepthBake::size,
     "texels along u, v, w; by default [256, 128, 1] of to_top, [64, 64, 64] of between, [1024, 1, "
     "1] of the others",
     texel_range},
    {"kinds", Kind::text_list, &OpticalDepthBake::kinds,
     "one to four layers of the atmosphere, each a channel (a third of zeros after two); by "
     "default all of them",
     Hint{"for example [\"air\", \"dust\", \"fog\", \"rain\"]"}},
    {"coordinates", Kind::choice, &OpticalDepthBake::coordinates, "how the two points are given",
     coordinates_choices, Default{R"("altitudes")"}, When{"table", "between"}, Cited{ai_2014}},
    {"sampling", Kind::choice, &OpticalDepthBake::sampling, "how densities are summed along a ray",
     depth_sampling_choices, Default{R"("exact")"}, When{"table", {"to_top", "between"}},
     Cited{ai_2014}},
    {"shells", Kind::integer, &OpticalDepthBake::shells, "number of shells", Range{1, 4096},
     Default{"32"}, When{"sampling", shells}},
    {"max_altitude", Kind::length, &OpticalDepthBake::max_altitude,
     "altitude of the highest shell; the air above is left out", Range{1, 1e9},
     Default{R"("35 km")"}, When{"sampling", shells}, Cited{ai_2014}},
};

VoxelCounts default_size(OpticalDepthTable table) {
    switch (table) {
        case OpticalDepthTable::to_top:
            return {256, 128, 1};
        case OpticalDepthTable::between:
            return {64, 64, 64};
        default:
            return {1024, 1, 1};
    }
}

// Reports a first axis that is too short. Each kind of rays needs two or more texels of its own
// along u.
void check_ray_kinds(const DecodedSection& bake, const VoxelCounts& size, int least,
                     Decoder& decoder) {
    if (size[0] >= least) return;
    decoder.report("E0142", bake, "size",
                   fmt::format("is {}: its first axis is divided among the kinds of paths",
                               voxels_to_string(size)),
                   fmt::format("give it at least {} texels", least));
}

// Fills in the values that depend on the table and the layers. It reports a size that the table
// cannot have (E0142).
void resolve_optical_depth(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    constexpr std::size_t most_kinds = 4;
    const auto table = choice_of<OpticalDepthTable>(bake.at("table"));
    if (!table) return;
    derive(bake.at("size"), default_size(*table));
    derive(bake.at("kinds"),
           mapped<std::string>(recipe.parameters.atmosphere.layers, &Layer::name));
    const auto* kinds = bake.value<std::vector<std::string>>("kinds");
    const std::size_t count = kinds ? kinds->size() : 1;
    if ((count < 1 || count > most_kinds) && decoder.complete) {
        decoder.report("E0129", bake, "kinds", fmt::format("has {} layers", count),
                       "each has a channel, of which there are one to four; name the layers");
    }
    const int axes = *table == OpticalDepthTable::to_top    ? 2
                     : *table == OpticalDepthTable::between ? 3
                                                            : 1;
    resolve_axes_and_files(bake, axes, most_kinds, decoder);
    const auto coordinates = choice_of<BetweenCoordinates>(bake.at("coordinates"));
    const bool falls = axes == 3 && coordinates == BetweenCoordinates::distance;
    const auto* size = bake.value<VoxelCounts>("size");
    if (axes > 1 && size) check_ray_kinds(bake, *size, falls ? 8 : 4, decoder);
}

std::vector<Read> reads_of(const Parameters& parameters, const OpticalDepthBake&) {
    return reads_of_air(parameters, Roles::all());
}

}  // namespace

AssetKind asset_kind(Tag<OpticalDepthBake>) {
    return make_asset_kind<OpticalDepthBake>(
        {.name = "optical_depth",
         .documentation = "columns, densities or phase functions of up to four kinds of particles",
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::factors},
        with_file_fields(optical_depth_table, {.pixel_type = R"("float")"}), reads_of,
        resolve_optical_depth);
}

}  // namespace skybake::config
