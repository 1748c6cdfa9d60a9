#include "config/sections/noise_rows.h"

#include "config/fields/fields.h"

namespace skybake::config {
namespace {

constexpr Range warp_range{-16, 16};

constexpr std::string_view worley_1996 = "Worley 1996, A Cellular Texture Basis Function";
constexpr std::string_view perlin_1985 = "Perlin 1985, An Image Synthesizer";

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
constexpr std::string_view warped[] = {"perlin", "worley", "perlin_worley", "alligator",
                                       "curly_alligator"};
constexpr std::string_view with_worley[] = {"worley", "perlin_worley"};
constexpr std::string_view perlin_worley[] = {"perlin_worley"};

const NoiseChannelField cellular_table[] = {
    {"worley_frequency", Kind::frequency, nullptr, "frequency of the cellular part",
     frequency_range, Default{"4"}, Exclusive{"worley_frequencies", "series"},
     When{"type", perlin_worley}, KeyFlag::only_shown},
    {"worley_octaves", Kind::integer, nullptr, "octaves of the cellular part", octave_range,
     Default{"3"}, Exclusive{"worley_frequencies", "series"}, When{"type", perlin_worley},
     KeyFlag::only_shown},
    {"worley_lacunarity", Kind::integer, nullptr, "lacunarity of the cellular part",
     lacunarity_range, Default{"2"}, Exclusive{"worley_frequencies", "series"},
     When{"type", perlin_worley}, KeyFlag::only_shown},
    {"worley_frequencies", Kind::frequencies, nullptr, "frequencies of the cellular part",
     frequency_range, Exclusive{"worley_frequencies"}, When{"type", perlin_worley}},
    {"worley_gain", Kind::number, nullptr, "gain of the cellular part", gain_range, Default{"0.5"},
     Exclusive{"worley_gains"}, When{"type", perlin_worley}, KeyFlag::only_shown},
    {"worley_gains", Kind::gains, nullptr, "gains of the cellular part", gains_range,
     Hint{"cloud shapes have [0.625, 0.25, 0.125]"}, Exclusive{"worley_gains"},
     When{"type", perlin_worley}, Cited{schneider_2015}},
    {"feature", Kind::choice, &NoiseChannel::feature, "which distance d of cellular noise",
     feature_choices, Default{R"("f1")"}, When{"type", with_worley}, Cited{worley_1996}},
    {"value_form", Kind::choice, &NoiseChannel::value_form, "value of cellular noise at distance d",
     value_form_choices, Default{R"("one_minus_distance")"}, When{"type", with_worley}},
};

const NoiseChannelField displacement_table[] = {
    {"warp_strength", Kind::number, &NoiseChannel::warp_strength,
     "displacement, in tiles, where the noise that displaces is 1", warp_range,
     Hint{"a quarter of a cell of the first octave curls the noise; metres are "
          "divided by the length of the tile"},
     When{"type", warped}, Cited{perlin_1985}},
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
};

}  // namespace

std::span<const NoiseChannelField> cellular_fields() { return cellular_table; }

std::span<const NoiseChannelField> displacement_fields() { return displacement_table; }

}  // namespace skybake::config
