#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

// These are the ranges of the keys of any series of octaves.
constexpr Range frequency_range{1, 1048576};
constexpr Range octave_range{1, 16};
constexpr Range lacunarity_range{1, 16};
constexpr Range gain_range{0, 4};
// It includes the weight of the last of 16 octaves with gain 4.
constexpr Range gains_range{0, 1e10};

constexpr std::string_view bridson_2007 =
    "Bridson, Hourihan and Nordenstam 2007, Curl-Noise for Procedural Fluid Flow";
constexpr std::string_view takram = "takram, three-clouds";

constexpr Choice sampling_choices[] = {
    {NoiseSampling::centers, "centers", "voxel i of N at (i + 1/2)/N"},
    {NoiseSampling::corners, "corners", "voxel i of N at i/N"},
    {NoiseSampling::slices_at_corners, "slices_at_corners",
     "centers along x and y, corners along z"},
};
constexpr Choice pack_choices[] = {
    {NoisePacking::none, "none", "each channel as it is"},
    {NoisePacking::shape, "shape",
     "of R, G, B and A: remap(R, w - 1, 1, 0, 1) with w = 0.625 G + 0.25 B + 0.125 A"},
    {NoisePacking::detail, "detail", "of R, G and B: 0.625 R + 0.25 G + 0.125 B"},
};

const Row<Noise> noise_table[] = {
    {"preset", Kind::text, nullptr,
     "name of a noise preset to start from, which the section's keys override",
     KeyFlag::only_shown},
    {"seed", Kind::seed, &Noise::seed, "another seed gives another noise of the same kind",
     Default{"0"}},
    {"size", Kind::voxels, &Noise::size,
     "voxels that the noise is made for; the default of size in [bake.*]", texel_range,
     Default{"[128, 128, 128]"},
     Hint{"shapes have 128 each, details 32 each; 1 along z gives a picture"},
     Cited{schneider_2015}, Role::usual},
    {"sampling", Kind::choice, &Noise::sampling, "where voxels lie in the tile", sampling_choices,
     Default{R"("centers")"}},
    {"pack", Kind::choice, &Noise::pack, "merge the channels into one, Y", pack_choices,
     Default{R"("none")"}, Cited{takram}},
    {"aliases", Kind::flag, &Noise::aliases,
     "octaves that are too fine for `size` are part of its look, so that no warning names them",
     Default{"false"}, KeyFlag::only_shown, Role::usual},
    {"period", Kind::integer, &Noise::period,
     "frames of a loop in time, after which the noise repeats bit for bit; without it the noise "
     "stands still",
     Range{1, 1e6}, Hint{"48 is two seconds of film"}},
    {"time", Kind::integer, &Noise::time,
     "the frame; frames before 0 and from `period` on are repeats", Range{-1e9, 1e9}, Default{"0"},
     Needs{"period"}},
    {"time_cells", Kind::integer, &Noise::time_cells,
     "lattice cells per loop along time, of the coarsest octave; finer ones have more",
     Range{1, 1024}, Default{"4"},
     Hint{"twice as many change the noise twice as fast; a single one hardly does"},
     Needs{"period"}},
    {"drift", Kind::frequency, &Noise::drift,
     "whole tiles per loop that the wind carries the noise along x, y and z", Range{-1024, 1024},
     Default{"0"}, Hint{"[1, 0, 0] is a wind of a tile per loop along +x"}, Needs{"period"}},
};

constexpr Choice feature_choices[] = {
    {WorleyFeature::f1, "f1", "distance to the nearest point"},
    {WorleyFeature::f2, "f2", "distance to the second nearest point"},
    {WorleyFeature::f2_minus_f1, "f2_minus_f1", "their difference: 0 on the borders of cells"},
};
constexpr Choice value_form_choices[] = {
    {WorleyValue::distance, "distance", "d, in cells"},
    {WorleyValue::one_minus_distance, "one_minus_distance", "1 - d, 0 from d = 1 on"},
    {WorleyValue::one_minus_distance_over_sqrt3, "one_minus_distance_over_sqrt3",
     "1 - d / sqrt(3), as in Olajos 2016"},
    {WorleyValue::one_minus_distance_squared, "one_minus_distance_squared",
     "1 - d * d, 0 from d = 1 on, as in TileableVolumeNoise"},
};
constexpr Choice warp_choices[] = {
    {NoiseWarp::curl, "curl", "the curl of three gradient noises, which has no sources"},
    {NoiseWarp::gradient, "gradient", "three gradient noises"},
};
// These are the types for which a key applies.
constexpr Words warped = {"perlin", "worley", "perlin_worley", "alligator", "curly_alligator"};
constexpr Words with_worley = {"worley", "perlin_worley"};

constexpr Range value_range{-1e6, 1e6};
constexpr Range bias_range{0.001, 0.999};  // beyond it, single precision divides by 0

constexpr std::string_view musgrave_1994 =
    "Musgrave, in Ebert et al. 1994, Texturing and Modeling: A Procedural Approach";

constexpr Choice type_choices[] = {
    {NoiseType::constant, "constant", "the value everywhere"},
    {NoiseType::perlin, "perlin", "improved gradient noise"},
    {NoiseType::worley, "worley", "distances to one jittered point per cell"},
    {NoiseType::perlin_worley, "perlin_worley",
     "remap(perlin, 0, 1, worley, 1): Perlin noise dilated by Worley noise"},
    {NoiseType::curl, "curl", "one component of the curl of three gradient noises"},
    {NoiseType::alligator, "alligator",
     "the greatest less the second greatest of smooth bumps of random height, one per cell"},
    {NoiseType::curly_alligator, "curly_alligator",
     "alligator noise that curl noise displaces, by a quarter of a cell without warp_strength"},
};
constexpr Choice fractal_choices[] = {
    {NoiseFractal::fbm, "fbm", "0.5 + 0.5 * sum of the octaves"},
    {NoiseFractal::rectified, "rectified", "max(0, sum of the octaves), as in TileableVolumeNoise"},
    {NoiseFractal::ridged, "ridged", "1 - |n| of each octave"},
    {NoiseFractal::billow, "billow", "|n| of each octave"},
};
constexpr Choice component_choices[] = {
    {CurlComponent::x, "x", "d/dy of potential z - d/dz of potential y"},
    {CurlComponent::y, "y", "d/dz of potential x - d/dx of potential z"},
    {CurlComponent::z, "z", "d/dx of potential y - d/dy of potential x"},
};
// These are the types for which a key applies.
constexpr Words noises = {"perlin", "worley",    "perlin_worley",
                          "curl",   "alligator", "curly_alligator"};

const Row<NoiseChannel> channel_table[] = {
    {"type", Kind::choice, &NoiseChannel::type, "kind of noise", type_choices, KeyFlag::required,
     Cited{
         "Perlin 2002, Improving Noise; Worley 1996, A Cellular Texture Basis Function; alligator: "
         "Side Effects Software, HDK sample `alligator`, and Schneider 2023, Nubis Cubed"}},
    {"value", Kind::number, &NoiseChannel::value, "the value everywhere", value_range,
     KeyFlag::required, When{"type", "constant"}},
    {"frequency", Kind::frequency, nullptr,
     "lattice cells per tile in the first octave, one number or one per axis", frequency_range,
     Default{"4"}, Hint{"up to a quarter of the number of voxels does not alias"},
     Exclusive{"frequencies", "series"}, When{"type", noises}, KeyFlag::only_shown},
    {"octaves", Kind::integer, nullptr,
     "number of octaves; without it there are as many as gains, if these are given", octave_range,
     Default{"1"}, Exclusive{"frequencies", "series"}, When{"type", noises}, KeyFlag::only_shown},
    {"lacunarity", Kind::integer, nullptr, "frequency of an octave over that of the one before",
     lacunarity_range, Default{"2"}, Exclusive{"frequencies", "series"}, When{"type", noises},
     Cited{musgrave_1994}, KeyFlag::only_shown},
    {"frequencies", Kind::frequencies, nullptr, "frequency of every octave, in place of a series",
     frequency_range, Hint{"takram's Perlin-Worley noise has [8, 32, 56]"},
     Exclusive{"frequencies"}, When{"type", noises}},
    {"gain", Kind::number, nullptr, "weight of an octave over that of the one before", gain_range,
     Default{"0.5"}, Exclusive{"gains"}, When{"type", noises}, Cited{musgrave_1994},
     KeyFlag::only_shown},
    {"gains", Kind::gains, nullptr, "weight of every octave; they are divided by their sum",
     gains_range, Hint{"cloud shapes have [0.625, 0.25, 0.125]"}, Exclusive{"gains"},
     When{"type", noises}, Cited{"Hillaire, TileableVolumeNoise"}},
    {"fractal", Kind::choice, &NoiseChannel::fractal, "how octaves of gradient noise are summed",
     fractal_choices, Default{R"("fbm")"}, When{"type", {"perlin", "perlin_worley"}},
     Cited{musgrave_1994}},
    {"worley_frequency", Kind::frequency, nullptr, "frequency of the cellular part",
     frequency_range, Default{"4"}, Exclusive{"worley_frequencies", "series"},
     When{"type", "perlin_worley"}, KeyFlag::only_shown},
    {"worley_octaves", Kind::integer, nullptr, "octaves of the cellular part", octave_range,
     Default{"3"}, Exclusive{"worley_frequencies", "series"}, When{"type", "perlin_worley"},
     KeyFlag::only_shown},
    {"worley_lacunarity", Kind::integer, nullptr, "lacunarity of the cellular part",
     lacunarity_range, Default{"2"}, Exclusive{"worley_frequencies", "series"},
     When{"type", "perlin_worley"}, KeyFlag::only_shown},
    {"worley_frequencies", Kind::frequencies, nullptr, "frequencies of the cellular part",
     frequency_range, Exclusive{"worley_frequencies"}, When{"type", "perlin_worley"}},
    {"worley_gain", Kind::number, nullptr, "gain of the cellular part", gain_range, Default{"0.5"},
     Exclusive{"worley_gains"}, When{"type", "perlin_worley"}, KeyFlag::only_shown},
    {"worley_gains", Kind::gains, nullptr, "gains of the cellular part", gains_range,
     Hint{"cloud shapes have [0.625, 0.25, 0.125]"}, Exclusive{"worley_gains"},
     When{"type", "perlin_worley"}, Cited{schneider_2015}},
    {"feature", Kind::choice, &NoiseChannel::feature, "which distance d of cellular noise",
     feature_choices, Default{R"("f1")"}, When{"type", with_worley},
     Cited{"Worley 1996, A Cellular Texture Basis Function"}},
    {"value_form", Kind::choice, &NoiseChannel::value_form, "value of cellular noise at distance d",
     value_form_choices, Default{R"("one_minus_distance")"}, When{"type", with_worley}},
    {"component", Kind::choice, &NoiseChannel::component, "which component of the curl",
     component_choices, Default{R"("x")"}, When{"type", "curl"}, Cited{bridson_2007}},
    {"warp_strength", Kind::number, &NoiseChannel::warp_strength,
     "displacement, in tiles, where the noise that displaces is 1", Range{-16, 16},
     Hint{"a quarter of a cell of the first octave curls the noise; metres are divided by the "
          "length of the tile"},
     When{"type", warped}, Cited{"Perlin 1985, An Image Synthesizer"}},
    {"warp_by", Kind::choice, &NoiseChannel::warp_by, "the noise that displaces, by default curl",
     warp_choices, When{"type", warped}, Cited{bridson_2007}},
    {"warp_frequency", Kind::frequency, nullptr, "frequency of the noise that displaces",
     frequency_range, Default{"4"}, Exclusive{"warp_frequencies", "series"}, When{"type", warped},
     KeyFlag::only_shown},
    {"warp_octaves", Kind::integer, nullptr, "octaves of the noise that displaces", octave_range,
     Default{"1"}, Exclusive{"warp_frequencies", "series"}, When{"type", warped},
     KeyFlag::only_shown},
    {"warp_lacunarity", Kind::integer, nullptr, "lacunarity of the noise that displaces",
     lacunarity_range, Default{"2"}, Exclusive{"warp_frequencies", "series"}, When{"type", warped},
     KeyFlag::only_shown},
    {"warp_frequencies", Kind::frequencies, nullptr, "frequencies of the noise that displaces",
     frequency_range, Exclusive{"warp_frequencies"}, When{"type", warped}},
    {"warp_gain", Kind::number, nullptr, "gain of the noise that displaces", gain_range,
     Default{"0.5"}, Exclusive{"warp_gains"}, When{"type", warped}, KeyFlag::only_shown},
    {"warp_gains", Kind::gains, nullptr, "gains of the noise that displaces", gains_range,
     Exclusive{"warp_gains"}, When{"type", warped}},
    // These make the value of the octaves into that of the channel.
    {"seed", Kind::seed, &NoiseChannel::seed,
     "seed that is combined with the noise's and makes channels of equal keys differ", Default{"0"},
     When{"type", noises}},
    {"remap", Kind::remap, &NoiseChannel::remap,
     "[in_low, in_high, out_low, out_high]: linear, so that in_low becomes out_low", value_range,
     Default{"[0, 1, 0, 1]"}, Hint{"1 - d / sqrt(3) takes values from 0.43 to 0.96"}},
    {"smoothstep", Kind::edges, &NoiseChannel::smoothstep,
     "after remap, a smooth rise from 0 at the first edge to 1 at the second", value_range,
     Hint{"takram's weather has [0.8, 1.4]"}, Cited{takram}},
    {"invert", Kind::flag, &NoiseChannel::invert, "1 - v, after remap and smoothstep",
     Default{"false"}},
    {"bias", Kind::number, &NoiseChannel::bias,
     "after invert, the value that 0.5 becomes: v / ((1/bias - 2) (1 - v) + 1) in [0, 1], v beyond",
     bias_range, Default{"0.5"}, Hint{"0.5 changes nothing"},
     Cited{"Schlick 1994, Fast Alternatives to Perlin's Bias and Gain Functions"}},
    {"clamp", Kind::clamp, &NoiseChannel::clamp,
     "bounds of the values, after everything else; true means [0, 1]", value_range,
     Hint{"integer pixel types hold only [0, 1]"}},
};

}  // namespace

std::span<const Row<Noise>> noise_fields() { return noise_table; }

std::span<const Row<NoiseChannel>> noise_channel_fields() { return channel_table; }

}  // namespace skybake::config
