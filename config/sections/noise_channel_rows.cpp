#include <array>
#include <initializer_list>
#include <span>
#include <vector>

#include "config/fields/fields.h"
#include "config/sections/noise_rows.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range value_range{-1e6, 1e6};
constexpr Range bias_range{0.001, 0.999};  // beyond it, single precision divides by 0

constexpr std::string_view kinds_of_noise =
    "Perlin 2002, Improving Noise; Worley 1996, A Cellular Texture Basis Function; alligator: "
    "Side Effects Software, HDK sample `alligator`, and Schneider 2023, Nubis Cubed";
constexpr std::string_view musgrave_1994 =
    "Musgrave, in Ebert et al. 1994, Texturing and Modeling: A Procedural Approach";
constexpr std::string_view schlick_1994 =
    "Schlick 1994, Fast Alternatives to Perlin's Bias and Gain Functions";
constexpr std::string_view tileable_volume_noise = "Hillaire, TileableVolumeNoise";

constexpr std::array type_choices = {
    Choice{NoiseType::constant, "constant", "the value everywhere"},
    Choice{NoiseType::perlin, "perlin", "improved gradient noise"},
    Choice{NoiseType::worley, "worley", "distances to one jittered point per cell"},
    Choice{NoiseType::perlin_worley, "perlin_worley",
           "remap(perlin, 0, 1, worley, 1): Perlin noise dilated by Worley noise"},
    Choice{NoiseType::curl, "curl", "one component of the curl of three gradient noises"},
    Choice{NoiseType::alligator, "alligator",
           "the greatest less the second greatest of smooth bumps of random height, one per cell"},
    Choice{
        NoiseType::curly_alligator, "curly_alligator",
        "alligator noise that curl noise displaces, by a quarter of a cell without warp_strength"},
};
constexpr std::array fractal_choices = {
    Choice{NoiseFractal::fbm, "fbm", "0.5 + 0.5 * sum of the octaves"},
    Choice{NoiseFractal::rectified, "rectified",
           "max(0, sum of the octaves), as in TileableVolumeNoise"},
    Choice{NoiseFractal::ridged, "ridged", "1 - |n| of each octave"},
    Choice{NoiseFractal::billow, "billow", "|n| of each octave"},
};
constexpr std::array component_choices = {
    Choice{CurlComponent::x, "x", "d/dy of potential z - d/dz of potential y"},
    Choice{CurlComponent::y, "y", "d/dz of potential x - d/dx of potential z"},
    Choice{CurlComponent::z, "z", "d/dx of potential y - d/dy of potential x"},
};
// These are the types for which a key applies.
constexpr std::string_view constant_noise[] = {"constant"};
constexpr std::string_view noises[] = {"perlin", "worley",    "perlin_worley",
                                       "curl",   "alligator", "curly_alligator"};
constexpr std::string_view with_perlin[] = {"perlin", "perlin_worley"};
constexpr std::string_view curl[] = {"curl"};

const std::array octave_table = {
    NoiseChannelField{{.key = "type",
                       .kind = Kind::choice,
                       .choices = type_choices,
                       .required = true,
                       .documentation = "kind of noise",
                       .citation = kinds_of_noise},
                      &NoiseChannel::type},
    NoiseChannelField{{.key = "value",
                       .kind = Kind::number,
                       .range = value_range,
                       .required = true,
                       .documentation = "the value everywhere",
                       .selector = "type",
                       .selected_by = constant_noise},
                      &NoiseChannel::value},
    NoiseChannelField{
        {.key = "frequency",
         .kind = Kind::frequency,
         .range = frequency_range,
         .fallback = "4",
         .documentation = "lattice cells per tile in the first octave, one number or one per axis",
         .hint = "up to a quarter of the number of voxels does not alias",
         .exclusive_group = "frequencies",
         .exclusive_side = "series",
         .selector = "type",
         .selected_by = noises,
         .only_shown = true},
        {}},
    NoiseChannelField{
        {.key = "octaves",
         .kind = Kind::integer,
         .range = octave_range,
         .fallback = "1",
         .documentation =
             "number of octaves; without it there are as many as gains, if these are given",
         .exclusive_group = "frequencies",
         .exclusive_side = "series",
         .selector = "type",
         .selected_by = noises,
         .only_shown = true},
        {}},
    NoiseChannelField{{.key = "lacunarity",
                       .kind = Kind::integer,
                       .range = lacunarity_range,
                       .fallback = "2",
                       .documentation = "frequency of an octave over that of the one before",
                       .citation = musgrave_1994,
                       .exclusive_group = "frequencies",
                       .exclusive_side = "series",
                       .selector = "type",
                       .selected_by = noises,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "frequencies",
                       .kind = Kind::frequencies,
                       .range = frequency_range,
                       .documentation = "frequency of every octave, in place of a series",
                       .hint = "takram's Perlin-Worley noise has [8, 32, 56]",
                       .exclusive_group = "frequencies",
                       .selector = "type",
                       .selected_by = noises},
                      {}},
    NoiseChannelField{{.key = "gain",
                       .kind = Kind::number,
                       .range = gain_range,
                       .fallback = "0.5",
                       .documentation = "weight of an octave over that of the one before",
                       .citation = musgrave_1994,
                       .exclusive_group = "gains",
                       .selector = "type",
                       .selected_by = noises,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "gains",
                       .kind = Kind::gains,
                       .range = gains_range,
                       .documentation = "weight of every octave; they are divided by their sum",
                       .hint = "cloud shapes have [0.625, 0.25, 0.125]",
                       .citation = tileable_volume_noise,
                       .exclusive_group = "gains",
                       .selector = "type",
                       .selected_by = noises},
                      {}},
    NoiseChannelField{{.key = "fractal",
                       .kind = Kind::choice,
                       .choices = fractal_choices,
                       .fallback = R"("fbm")",
                       .documentation = "how octaves of gradient noise are summed",
                       .citation = musgrave_1994,
                       .selector = "type",
                       .selected_by = with_perlin},
                      &NoiseChannel::fractal},
};

const std::array curl_table = {
    NoiseChannelField{{.key = "component",
                       .kind = Kind::choice,
                       .choices = component_choices,
                       .fallback = R"("x")",
                       .documentation = "which component of the curl",
                       .citation = bridson_2007,
                       .selector = "type",
                       .selected_by = curl},
                      &NoiseChannel::component},
};

// These make the value of the octaves into that of the channel.
const std::array value_table = {
    NoiseChannelField{
        {.key = "seed",
         .kind = Kind::seed,
         .fallback = "0",
         .documentation =
             "seed that is combined with the noise's and makes channels of equal keys differ",
         .selector = "type",
         .selected_by = noises},
        &NoiseChannel::seed},
    NoiseChannelField{
        {.key = "remap",
         .kind = Kind::remap,
         .range = value_range,
         .fallback = "[0, 1, 0, 1]",
         .documentation =
             "[in_low, in_high, out_low, out_high]: linear, so that in_low becomes out_low",
         .hint = "1 - d / sqrt(3) takes values from 0.43 to 0.96"},
        &NoiseChannel::remap},
    NoiseChannelField{
        {.key = "smoothstep",
         .kind = Kind::edges,
         .range = value_range,
         .documentation = "after remap, a smooth rise from 0 at the first edge to 1 at the second",
         .hint = "takram's weather has [0.8, 1.4]",
         .citation = takram},
        &NoiseChannel::smoothstep},
    NoiseChannelField{{.key = "invert",
                       .kind = Kind::flag,
                       .fallback = "false",
                       .documentation = "1 - v, after remap and smoothstep"},
                      &NoiseChannel::invert},
    NoiseChannelField{{.key = "bias",
                       .kind = Kind::number,
                       .range = bias_range,
                       .fallback = "0.5",
                       .documentation = "after invert, the value that 0.5 becomes: v / ((1/bias - "
                                        "2) (1 - v) + 1) in [0, 1], v beyond",
                       .hint = "0.5 changes nothing",
                       .citation = schlick_1994},
                      &NoiseChannel::bias},
    NoiseChannelField{
        {.key = "clamp",
         .kind = Kind::clamp,
         .range = value_range,
         .documentation = "bounds of the values, after everything else; true means [0, 1]",
         .hint = "integer pixel types hold only [0, 1]"},
        &NoiseChannel::clamp},
};

std::vector<NoiseChannelField> joined(
    std::initializer_list<std::span<const NoiseChannelField>> tables) {
    std::vector<NoiseChannelField> rows;
    for (const auto& table : tables) rows.insert(rows.end(), table.begin(), table.end());
    return rows;
}

}  // namespace

std::span<const NoiseChannelField> noise_channel_fields() {
    static const std::vector<NoiseChannelField> rows =
        joined({octave_table, cellular_fields(), curl_table, displacement_fields(), value_table});
    return rows;
}

}  // namespace skybake::config
