// What a noise is to the kernels: octaves with their keys, weights and per-axis tables, all that
// does not depend on which voxels are asked for. Made once per bake, then only read.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/math/aligned_floats.h"
#include "bakers/noise/tile_axis.h"
#include "config/sections/noise.h"

namespace skybake::noise {

// Vectors of up to so many floats may be loaded from any voxel of an axis on.
inline constexpr int kLanePadding = 16;

// One octave's cells along one axis, per voxel 0 ... size - 1, with kLanePadding further entries:
// the last cell again, fraction 0.
struct AxisCells {
    std::vector<std::int32_t> cell;
    AlignedFloats fraction;  // position in the cell, in [0, 1), rounded to float
};

// The four functions of gradient_basis.h per voxel, padded by zeros.
struct AxisBasis {
    AlignedFloats weight_0, weight_1, distance_0, distance_1;
};

// One octave of gradient noise, or its derivative along an axis.
struct GradientOctave {
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    int derivative_axis = -1;  // -1: the noise itself
    float amplitude = 1;       // on the noise itself
    std::array<AxisCells, 3> cells;
    std::array<AxisBasis, 3> basis;  // the y axis' times amplitude
};

// What becomes of an octave's value n before it is weighted.
enum class OctaveShape { plain, absolute, one_minus_absolute };

// sum over octaves of  weight * shape(n);  for OctaveShape::plain the weights are in the
// amplitudes.
struct GradientStack {
    OctaveShape shape = OctaveShape::plain;
    std::vector<GradientOctave> octaves;
    std::vector<float> weights;
};

// One octave of cellular noise. Channels that use equal octaves share one.
struct CellField {
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    config::WorleyFeature feature = config::WorleyFeature::f1;
    config::WorleyValue value_form = config::WorleyValue::distance;
    std::array<AxisCells, 3> cells;
};

struct WeightedField {
    int field = 0;  // in NoisePlan::fields
    float weight = 0;
};

struct ChannelPlan {
    config::NoiseType type = config::NoiseType::constant;
    float value = 0;  // constant
    config::NoiseFractal fractal = config::NoiseFractal::fbm;
    GradientStack gradient;
    std::vector<WeightedField> cells;
    // After the noise itself, in this order.
    bool remapped = false;
    float remap_low_in = 0, remap_scale = 1, remap_low_out = 0;
    bool stepped = false;
    float step_from = 0, step_scale = 1;  // 1 / (to - from)
    bool invert = false;
    bool biased = false;
    float bias_slope = 0;  // 1/b - 2
    bool clamped = false;
    float clamp_low = 0, clamp_high = 1;

    // Whether any of these changes a value.
    bool is_shaped() const { return remapped || stepped || invert || biased || clamped; }
};

struct NoisePlan {
    std::array<TileAxis, 3> axes;
    std::vector<CellField> fields;
    std::vector<ChannelPlan> channels;
    config::NoisePacking pack = config::NoisePacking::none;
    int output_channels() const {
        return pack == config::NoisePacking::none ? static_cast<int>(channels.size()) : 1;
    }
};

NoisePlan make_noise_plan(const config::Noise& noise, const std::array<int, 3>& size);

// The range that a channel's values are meant to lie in: [0, 1], [-1, 1] for curl, either carried
// through remap, smoothstep, invert, bias and clamp. Never empty.
std::array<double, 2> nominal_range(const config::NoiseChannel& channel);

}  // namespace skybake::noise
