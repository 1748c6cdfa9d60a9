#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range voxel_range{1, 16384};
constexpr Range frequency_range{1, 1048576};
constexpr Range octave_range{1, 16};
constexpr Range lacunarity_range{1, 16};
constexpr Range gain_range{0, 4};
constexpr Range gains_range{0, 1e10};  // includes the weight of the last of 16 octaves with gain 4
constexpr Range value_range{-1e6, 1e6};
constexpr Range bias_range{0.001, 0.999};  // beyond it, single precision divides by 0

constexpr std::string_view perlin_and_worley =
    "Perlin 2002, Improving Noise; Worley 1996, A Cellular Texture Basis Function";
constexpr std::string_view worley_1996 = "Worley 1996, A Cellular Texture Basis Function";
constexpr std::string_view musgrave_1994 =
    "Musgrave, in Ebert et al. 1994, Texturing and Modeling: A Procedural Approach";
constexpr std::string_view bridson_2007 =
    "Bridson, Hourihan and Nordenstam 2007, Curl-Noise for Procedural Fluid Flow";
constexpr std::string_view schlick_1994 =
    "Schlick 1994, Fast Alternatives to Perlin's Bias and Gain Functions";
constexpr std::string_view tileable_volume_noise = "Hillaire, TileableVolumeNoise";
constexpr std::string_view takram = "takram, three-clouds";

constexpr std::array sampling_choices = {
    Choice{NoiseSampling::centers, "centers", "voxel i of N at (i + 1/2)/N"},
    Choice{NoiseSampling::corners, "corners", "voxel i of N at i/N"},
    Choice{NoiseSampling::slices_at_corners, "slices_at_corners",
           "centers along x and y, corners along z"},
};
constexpr std::array pack_choices = {
    Choice{NoisePacking::none, "none", "each channel as it is"},
    Choice{NoisePacking::shape, "shape",
           "of R, G, B and A: remap(R, w - 1, 1, 0, 1) with w = 0.625 G + 0.25 B + 0.125 A"},
    Choice{NoisePacking::detail, "detail", "of R, G and B: 0.625 R + 0.25 G + 0.125 B"},
};
constexpr std::array type_choices = {
    Choice{NoiseType::constant, "constant", "the value everywhere"},
    Choice{NoiseType::perlin, "perlin", "improved gradient noise"},
    Choice{NoiseType::worley, "worley", "distances to one jittered point per cell"},
    Choice{NoiseType::perlin_worley, "perlin_worley",
           "remap(perlin, 0, 1, worley, 1): Perlin noise dilated by Worley noise"},
    Choice{NoiseType::curl, "curl", "one component of the curl of three gradient noises"},
};
constexpr std::array fractal_choices = {
    Choice{NoiseFractal::fbm, "fbm", "0.5 + 0.5 * sum of the octaves"},
    Choice{NoiseFractal::rectified, "rectified",
           "max(0, sum of the octaves), as in TileableVolumeNoise"},
    Choice{NoiseFractal::ridged, "ridged", "1 - |n| of each octave"},
    Choice{NoiseFractal::billow, "billow", "|n| of each octave"},
};
constexpr std::array feature_choices = {
    Choice{WorleyFeature::f1, "f1", "distance to the nearest point"},
    Choice{WorleyFeature::f2, "f2", "distance to the second nearest point"},
    Choice{WorleyFeature::f2_minus_f1, "f2_minus_f1",
           "their difference: 0 on the borders of cells"},
};
constexpr std::array value_form_choices = {
    Choice{WorleyValue::distance, "distance", "d, in cells"},
    Choice{WorleyValue::one_minus_distance, "one_minus_distance", "1 - d, 0 from d = 1 on"},
    Choice{WorleyValue::one_minus_distance_over_sqrt3, "one_minus_distance_over_sqrt3",
           "1 - d / sqrt(3), as in Olajos 2016"},
    Choice{WorleyValue::one_minus_distance_squared, "one_minus_distance_squared",
           "1 - d * d, 0 from d = 1 on, as in TileableVolumeNoise"},
};
constexpr std::array component_choices = {
    Choice{CurlComponent::x, "x", "d/dy of potential z - d/dz of potential y"},
    Choice{CurlComponent::y, "y", "d/dz of potential x - d/dx of potential z"},
    Choice{CurlComponent::z, "z", "d/dx of potential y - d/dy of potential x"},
};
// These are the types for which a key applies.
constexpr std::string_view constant_noise[] = {"constant"};
constexpr std::string_view noises[] = {"perlin", "worley", "perlin_worley", "curl"};
constexpr std::string_view with_perlin[] = {"perlin", "perlin_worley"};
constexpr std::string_view with_worley[] = {"worley", "perlin_worley"};
constexpr std::string_view perlin_worley[] = {"perlin_worley"};
constexpr std::string_view curl[] = {"curl"};

const std::array noise_table = {
    NoiseField{
        {.key = "preset",
         .kind = Kind::text,
         .documentation = "name of a noise preset to start from, which the section's keys override",
         .only_shown = true},
        {}},
    NoiseField{{.key = "seed",
                .kind = Kind::seed,
                .fallback = "0",
                .documentation = "another seed gives another noise of the same kind"},
               &Noise::seed},
    NoiseField{
        {.key = "size",
         .kind = Kind::voxels,
         .range = voxel_range,
         .fallback = "[128, 128, 128]",
         .documentation = "voxels that the noise is made for; the default of size in [bake.*]",
         .hint = "shapes have 128 each, details 32 each; 1 along z gives a picture",
         .citation = schneider_2015,
         .role = Role::usual},
        &Noise::size},
    NoiseField{{.key = "sampling",
                .kind = Kind::choice,
                .choices = sampling_choices,
                .fallback = R"("centers")",
                .documentation = "where voxels lie in the tile"},
               &Noise::sampling},
    NoiseField{{.key = "pack",
                .kind = Kind::choice,
                .choices = pack_choices,
                .fallback = R"("none")",
                .documentation = "merge the channels into one, Y",
                .citation = takram},
               &Noise::pack},
    NoiseField{{.key = "aliases",
                .kind = Kind::flag,
                .fallback = "false",
                .documentation = "octaves that are too fine for `size` are part of its look, so "
                                 "that no warning names them",
                .only_shown = true,
                .role = Role::usual},
               &Noise::aliases},
};

const std::array channel_table = {
    NoiseChannelField{{.key = "type",
                       .kind = Kind::choice,
                       .choices = type_choices,
                       .required = true,
                       .documentation = "kind of noise",
                       .citation = perlin_and_worley},
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
    NoiseChannelField{{.key = "worley_frequency",
                       .kind = Kind::frequency,
                       .range = frequency_range,
                       .fallback = "4",
                       .documentation = "frequency of the cellular part",
                       .exclusive_group = "worley_frequencies",
                       .exclusive_side = "series",
                       .selector = "type",
                       .selected_by = perlin_worley,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "worley_octaves",
                       .kind = Kind::integer,
                       .range = octave_range,
                       .fallback = "3",
                       .documentation = "octaves of the cellular part",
                       .exclusive_group = "worley_frequencies",
                       .exclusive_side = "series",
                       .selector = "type",
                       .selected_by = perlin_worley,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "worley_lacunarity",
                       .kind = Kind::integer,
                       .range = lacunarity_range,
                       .fallback = "2",
                       .documentation = "lacunarity of the cellular part",
                       .exclusive_group = "worley_frequencies",
                       .exclusive_side = "series",
                       .selector = "type",
                       .selected_by = perlin_worley,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "worley_frequencies",
                       .kind = Kind::frequencies,
                       .range = frequency_range,
                       .documentation = "frequencies of the cellular part",
                       .exclusive_group = "worley_frequencies",
                       .selector = "type",
                       .selected_by = perlin_worley},
                      {}},
    NoiseChannelField{{.key = "worley_gain",
                       .kind = Kind::number,
                       .range = gain_range,
                       .fallback = "0.5",
                       .documentation = "gain of the cellular part",
                       .exclusive_group = "worley_gains",
                       .selector = "type",
                       .selected_by = perlin_worley,
                       .only_shown = true},
                      {}},
    NoiseChannelField{{.key = "worley_gains",
                       .kind = Kind::gains,
                       .range = gains_range,
                       .documentation = "gains of the cellular part",
                       .hint = "cloud shapes have [0.625, 0.25, 0.125]",
                       .citation = schneider_2015,
                       .exclusive_group = "worley_gains",
                       .selector = "type",
                       .selected_by = perlin_worley},
                      {}},
    NoiseChannelField{{.key = "feature",
                       .kind = Kind::choice,
                       .choices = feature_choices,
                       .fallback = R"("f1")",
                       .documentation = "which distance d of cellular noise",
                       .citation = worley_1996,
                       .selector = "type",
                       .selected_by = with_worley},
                      &NoiseChannel::feature},
    NoiseChannelField{{.key = "value_form",
                       .kind = Kind::choice,
                       .choices = value_form_choices,
                       .fallback = R"("one_minus_distance")",
                       .documentation = "value of cellular noise at distance d",
                       .selector = "type",
                       .selected_by = with_worley},
                      &NoiseChannel::value_form},
    NoiseChannelField{{.key = "component",
                       .kind = Kind::choice,
                       .choices = component_choices,
                       .fallback = R"("x")",
                       .documentation = "which component of the curl",
                       .citation = bridson_2007,
                       .selector = "type",
                       .selected_by = curl},
                      &NoiseChannel::component},
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

}  // namespace

std::span<const NoiseField> noise_fields() { return noise_table; }

std::span<const NoiseChannelField> noise_channel_fields() { return channel_table; }

}  // namespace skybake::config
