// This header declares tileable noise, [noise.NAME], and the rules for its octaves.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/sections/forward.h"

namespace skybake::config {

struct DecodedSection;
struct Decoder;

enum class NoiseType { constant, perlin, worley, perlin_worley, curl, alligator, curly_alligator };
inline bool is_alligator(NoiseType type) {
    return type == NoiseType::alligator || type == NoiseType::curly_alligator;
}
enum class NoiseFractal { fbm, rectified, ridged, billow };
enum class WorleyFeature { f1, f2, f2_minus_f1 };
enum class WorleyValue {
    distance,
    one_minus_distance,
    one_minus_distance_over_sqrt3,
    one_minus_distance_squared
};
enum class CurlComponent { x, y, z };
enum class NoiseWarp { curl, gradient };

// This is a sum of octaves of one kind of noise. `frequencies[i]` is the number of lattice cells
// per tile along x, y and z of octave i. `gains[i]` is its weight, before the weights are divided
// by their sum.
struct NoiseOctaves {
    std::vector<std::array<int, 3>> frequencies;
    std::vector<double> gains;

    bool operator==(const NoiseOctaves&) const = default;
};

// This is one channel of a noise.
struct NoiseChannel {
    std::string name;  // "R", "G", "B", "A", or "Y" where it is the only one
    NoiseType type = NoiseType::perlin;
    double value = 0;      // constant
    NoiseOctaves octaves;  // all types but constant; for perlin_worley, the gradient part
    NoiseFractal fractal = NoiseFractal::fbm;   // perlin, perlin_worley
    NoiseOctaves worley_octaves;                // the cellular part of perlin_worley
    WorleyFeature feature = WorleyFeature::f1;  // for worley and perlin_worley
    WorleyValue value_form = WorleyValue::one_minus_distance;
    CurlComponent component = CurlComponent::x;  // curl
    std::uint64_t seed = 0;                      // used together with the noise's own
    // The noise is read at the place plus `warp_strength` times a vector noise, in tiles.
    double warp_strength = 0;  // 0: where it is
    NoiseWarp warp_by = NoiseWarp::curl;
    NoiseOctaves warp_octaves;
    // These change a value v, in this order.
    std::array<double, 4> remap{0, 1, 0, 1};          // [in low, in high, out low, out high]
    std::optional<std::array<double, 2>> smoothstep;  // 0 at the first, 1 at the second
    bool invert = false;                              // 1 - v
    double bias = 0.5;                                // Schlick's; 0.5 changes nothing
    std::array<double, 2> clamp{-std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};

    bool operator==(const NoiseChannel&) const = default;
};

enum class NoiseSampling { centers, corners, slices_at_corners };
enum class NoisePacking { none, shape, detail };

// This is one [noise.NAME].
struct Noise {
    std::string name;
    std::uint64_t seed = 0;
    std::array<int, 3> size{};  // voxels it is made for; the default of a bake's size
    NoiseSampling sampling = NoiseSampling::centers;
    NoisePacking pack = NoisePacking::none;
    bool aliases = false;                 // octaves too fine for `size` are intended
    int period = 0;                       // frames of a loop in time; 0: the noise stands still
    int time = 0;                         // the frame; any integer, as frames repeat
    std::array<int, 3> drift{};           // tiles per loop that the wind moves the noise
    int time_cells = 1;                   // lattice cells per loop along time
    std::array<int, 3> repeats{1, 1, 1};  // tiles per volume, which frequencies include
    std::vector<NoiseChannel> channels;   // in the order R, G, B, A

    bool operator==(const Noise&) const = default;
};

// Returns the names of the channels of a noise in files: Y if it has one, or packs them into one.
std::vector<std::string> channel_names(const Noise& noise);

// These are the keys that describe one series of octaves in a channel's section.
struct OctaveKeys {
    std::string_view frequency, octaves, lacunarity, frequencies, gain, gains;
};

inline constexpr OctaveKeys plain_octave_keys{"frequency",   "octaves", "lacunarity",
                                              "frequencies", "gain",    "gains"};
inline constexpr OctaveKeys worley_octave_keys{"worley_frequency",  "worley_octaves",
                                               "worley_lacunarity", "worley_frequencies",
                                               "worley_gain",       "worley_gains"};
inline constexpr OctaveKeys warp_octave_keys{"warp_frequency",   "warp_octaves", "warp_lacunarity",
                                             "warp_frequencies", "warp_gain",    "warp_gains"};

// Turns the keys of a series of octaves (frequency, octaves, lacunarity, gain) into lists with one
// frequency and one gain per octave. It fills in `frequencies` and `gains` of the section, and
// returns them. It returns empty lists if the channel's type has no such octaves or a key is at
// fault. Errors: a frequency is above its range (E0128), or the numbers of gains and octaves differ
// (E0108).
NoiseOctaves resolve_octaves(DecodedSection& channel, const OctaveKeys& keys, Decoder& decoder);

// A lattice cell of an octave needs at least this many voxels along each axis to be shown. The
// checks below use integer arithmetic.
inline constexpr int fewest_voxels_per_cell = 4;

// Whether a lattice cell has too few voxels to be shown, on an axis of more than one voxel.
bool is_coarse(const std::array<int, 3>& frequency, const std::array<int, 3>& size);

// Whether every voxel lies on a lattice point, where gradient noise is 0 by definition. Voxel i of
// N lies at (i + 1/2) f / N cells, or at i f / N on axes that are sampled at corners.
bool is_zero_everywhere(const std::array<int, 3>& frequency, const std::array<int, 3>& size,
                        NoiseSampling sampling);

}  // namespace skybake::config

namespace skybake {
using config::NoiseChannel;
using config::NoiseFractal;
using config::NoiseOctaves;
using config::NoisePacking;
using config::NoiseType;
}  // namespace skybake
