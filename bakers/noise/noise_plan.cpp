#include "bakers/noise/noise_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "bakers/noise/lattice_hash.h"

namespace skybake::noise {

namespace {

using config::CurlComponent;
using config::NoiseChannel;
using config::NoiseFractal;
using config::NoiseOctaves;
using config::NoiseType;

AxisCells axis_cells(const TileAxis& axis, int frequency) {
    AxisCells cells;
    const auto count = static_cast<std::size_t>(axis.size);
    cells.cell.resize(count + kLanePadding);
    cells.fraction.resize(count + kLanePadding);
    for (int i = 0; i < axis.size; ++i) {
        const LatticePosition position = lattice_position(axis, frequency, i);
        cells.cell[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(position.cell);
        cells.fraction[static_cast<std::size_t>(i)] = cell_fraction(position);
    }
    std::fill(cells.cell.begin() + axis.size, cells.cell.end(),
              cells.cell[static_cast<std::size_t>(axis.size - 1)]);
    return cells;
}

AxisBasis axis_basis(const TileAxis& axis, int frequency, bool derivative, float amplitude) {
    AxisBasis basis;
    const auto count = static_cast<std::size_t>(axis.size + kLanePadding);
    for (AlignedFloats* values :
         {&basis.weight_0, &basis.weight_1, &basis.distance_0, &basis.distance_1}) {
        values->resize(count);
    }
    for (int i = 0; i < axis.size; ++i) {
        const LatticePosition position = lattice_position(axis, frequency, i);
        const GradientBasis value = scaled(
            derivative ? gradient_basis_derivative(position) : gradient_basis(position), amplitude);
        const auto at = static_cast<std::size_t>(i);
        basis.weight_0[at] = value.weight_0;
        basis.weight_1[at] = value.weight_1;
        basis.distance_0[at] = value.distance_0;
        basis.distance_1[at] = value.distance_1;
    }
    return basis;
}

GradientOctave gradient_octave(const std::array<TileAxis, 3>& axes,
                               const std::array<int, 3>& frequency, std::uint64_t key,
                               int derivative_axis, double amplitude) {
    GradientOctave octave{frequency, key, derivative_axis, static_cast<float>(amplitude), {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        octave.cells[axis] = axis_cells(axes[axis], frequency[axis]);
        octave.basis[axis] =
            axis_basis(axes[axis], frequency[axis], derivative_axis == static_cast<int>(axis),
                       axis == 1 ? octave.amplitude : 1.0f);
    }
    return octave;
}

// The weights over their sum.
std::vector<double> weights_of(const NoiseOctaves& octaves) {
    const double sum = std::accumulate(octaves.gains.begin(), octaves.gains.end(), 0.0);
    std::vector<double> weights;
    for (const double gain : octaves.gains) weights.push_back(gain / sum);
    return weights;
}

OctaveShape shape_of(NoiseFractal fractal) {
    if (fractal == NoiseFractal::ridged) return OctaveShape::one_minus_absolute;
    return fractal == NoiseFractal::billow ? OctaveShape::absolute : OctaveShape::plain;
}

// Keys of one channel of one noise.
struct Keys {
    std::uint64_t noise_seed = 0;
    std::uint64_t channel_seed = 0;
    // Of octave i.
    std::uint64_t operator()(Purpose purpose, const NoiseOctaves& octaves, std::size_t i) const {
        const auto begin = octaves.frequencies.begin();
        const auto end = begin + static_cast<std::ptrdiff_t>(i);
        const auto repetition = std::count(begin, end, octaves.frequencies[i]);
        return octave_key(noise_seed, channel_seed, purpose, octaves.frequencies[i],
                          static_cast<int>(repetition));
    }
};

GradientStack gradient_stack(const NoiseChannel& channel, const std::array<TileAxis, 3>& axes,
                             const Keys& keys) {
    GradientStack stack{shape_of(channel.fractal), {}, {}};
    const std::vector<double> weights = weights_of(channel.octaves);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto& frequency = channel.octaves.frequencies[i];
        const bool plain = stack.shape == OctaveShape::plain;
        stack.octaves.push_back(gradient_octave(axes, frequency,
                                                keys(Purpose::gradient, channel.octaves, i), -1,
                                                plain ? weights[i] : 1));
        stack.weights.push_back(static_cast<float>(weights[i]));
    }
    return stack;
}

// One component of the curl of three potentials, curl_x = d potential_z / dy - d potential_y / dz
// and so on around. Derivatives are taken along the tile and divided by the greatest frequency of
// the first octave, so that values are of the order of 1.
GradientStack curl_stack(const NoiseChannel& channel, const std::array<TileAxis, 3>& axes,
                         const Keys& keys) {
    constexpr std::array<Purpose, 3> kPotentials = {Purpose::potential_x, Purpose::potential_y,
                                                    Purpose::potential_z};
    const auto axis = static_cast<std::size_t>(channel.component);
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    const auto& first_octave = channel.octaves.frequencies.front();
    const double unit = *std::max_element(first_octave.begin(), first_octave.end());
    GradientStack stack;
    const std::vector<double> weights = weights_of(channel.octaves);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto& frequency = channel.octaves.frequencies[i];
        stack.octaves.push_back(
            gradient_octave(axes, frequency, keys(kPotentials[last], channel.octaves, i),
                            static_cast<int>(next), weights[i] * frequency[next] / unit));
        stack.octaves.push_back(
            gradient_octave(axes, frequency, keys(kPotentials[next], channel.octaves, i),
                            static_cast<int>(last), -weights[i] * frequency[last] / unit));
    }
    return stack;
}

int field_index(NoisePlan& plan, CellField field) {
    for (std::size_t i = 0; i < plan.fields.size(); ++i) {
        const CellField& other = plan.fields[i];
        if (other.key == field.key && other.frequency == field.frequency &&
            other.feature == field.feature && other.value_form == field.value_form) {
            return static_cast<int>(i);
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        field.cells[axis] = axis_cells(plan.axes[axis], field.frequency[axis]);
    }
    plan.fields.push_back(std::move(field));
    return static_cast<int>(plan.fields.size()) - 1;
}

std::vector<WeightedField> cell_fields(const NoiseChannel& channel, const NoiseOctaves& octaves,
                                       const Keys& keys, NoisePlan& plan) {
    std::vector<WeightedField> fields;
    const std::vector<double> weights = weights_of(octaves);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto& frequency = octaves.frequencies[i];
        const int field = field_index(
            plan,
            {frequency, keys(Purpose::cells, octaves, i), channel.feature, channel.value_form, {}});
        fields.push_back({field, static_cast<float>(weights[i])});
    }
    return fields;
}

ChannelPlan channel_plan(const NoiseChannel& channel, std::uint64_t noise_seed, NoisePlan& plan) {
    const Keys keys{noise_seed, channel.seed};
    ChannelPlan result;
    result.type = channel.type;
    result.value = static_cast<float>(channel.value);
    result.fractal = channel.fractal;
    if (channel.type == NoiseType::perlin || channel.type == NoiseType::perlin_worley) {
        result.gradient = gradient_stack(channel, plan.axes, keys);
    }
    if (channel.type == NoiseType::curl) {
        result.gradient = curl_stack(channel, plan.axes, keys);
        result.fractal = NoiseFractal::fbm;
    }
    if (channel.type == NoiseType::worley) {
        result.cells = cell_fields(channel, channel.octaves, keys, plan);
    }
    if (channel.type == NoiseType::perlin_worley) {
        result.cells = cell_fields(channel, channel.worley_octaves, keys, plan);
    }
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    result.remapped = channel.remap != std::array<double, 4>{0, 1, 0, 1};
    result.remap_low_in = static_cast<float>(low_in);
    result.remap_scale = static_cast<float>((high_out - low_out) / (high_in - low_in));
    result.remap_low_out = static_cast<float>(low_out);
    result.stepped = channel.smoothstep.has_value();
    if (result.stepped) {
        const auto& [from, to] = *channel.smoothstep;
        result.step_from = static_cast<float>(from);
        result.step_scale = static_cast<float>(1 / (to - from));
    }
    result.invert = channel.invert;
    result.biased = channel.bias != 0.5;
    result.bias_slope = static_cast<float>(1 / channel.bias - 2);
    result.clamped = std::isfinite(channel.clamp[0]);
    result.clamp_low = static_cast<float>(channel.clamp[0]);
    result.clamp_high = static_cast<float>(channel.clamp[1]);
    return result;
}

double smooth_step(const std::array<double, 2>& edges, double value) {
    const double t = std::clamp((value - edges[0]) / (edges[1] - edges[0]), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

NoisePlan make_noise_plan(const config::Noise& noise, const std::array<int, 3>& size) {
    assert(size[0] >= 1 && size[1] >= 1 && size[2] >= 1);
    NoisePlan plan;
    plan.axes = tile_axes(size, noise.sampling);
    plan.pack = noise.pack;
    for (const NoiseChannel& channel : noise.channels) {
        plan.channels.push_back(channel_plan(channel, noise.seed, plan));
    }
    return plan;
}

std::array<double, 2> nominal_range(const NoiseChannel& channel) {
    std::array<double, 2> range = {0, 1};
    if (channel.type == NoiseType::curl) range = {-1, 1};
    if (channel.type == NoiseType::constant)
        range = {std::min(0.0, channel.value), std::max(1.0, channel.value)};
    const auto& [low_in, high_in, low_out, high_out] = channel.remap;
    for (double& bound : range) {
        bound = low_out + (bound - low_in) * (high_out - low_out) / (high_in - low_in);
        if (channel.smoothstep) bound = smooth_step(*channel.smoothstep, bound);
        if (channel.invert) bound = 1 - bound;
        // Bias leaves 0, 1 and what is beyond where it is, and is monotonic.
        if (bound > 0 && bound < 1) bound /= (1 / channel.bias - 2) * (1 - bound) + 1;
        bound = std::clamp(bound, channel.clamp[0], channel.clamp[1]);
    }
    if (range[0] > range[1]) std::swap(range[0], range[1]);
    // One value alone: a range about it.
    if (range[0] == range[1]) range = {range[0] - 0.5, range[1] + 0.5};
    return range;
}

std::array<TileAxis, 3> tile_axes(const std::array<int, 3>& size, config::NoiseSampling sampling) {
    using config::NoiseSampling;
    const int across = sampling == NoiseSampling::corners ? 0 : 1;
    const int along = sampling == NoiseSampling::centers ? 1 : 0;
    return {{{size[0], across}, {size[1], across}, {size[2], along}}};
}

bool is_resolved(const std::array<TileAxis, 3>& axes, const std::array<int, 3>& frequency) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (frequency[axis] > axes[axis].size && axes[axis].size > 1) return false;
    }
    return true;
}

namespace {

double fade(double u) { return u * u * u * (u * (6 * u - 15) + 10); }
double fade_derivative(double u, double one_minus_u) {
    const double product = u * one_minus_u;
    return 30 * product * product;
}

// u and 1 - u, each with all its digits.
struct Fraction {
    double u = 0;
    double one_minus_u = 0;
};

Fraction fraction_of(const LatticePosition& position) {
    const auto denominator = static_cast<double>(position.denominator);
    return {static_cast<double>(position.numerator) / denominator,
            static_cast<double>(position.denominator - position.numerator) / denominator};
}

}  // namespace

GradientBasis gradient_basis(const LatticePosition& position) {
    const auto [u, one_minus_u] = fraction_of(position);
    const double weight_0 = fade(one_minus_u);  // 1 - fade(u), without the cancellation
    const double weight_1 = fade(u);
    return {static_cast<float>(weight_0), static_cast<float>(weight_1),
            static_cast<float>(u * weight_0), static_cast<float>(-one_minus_u * weight_1)};
}

GradientBasis gradient_basis_derivative(const LatticePosition& position) {
    const auto [u, one_minus_u] = fraction_of(position);
    const double slope = fade_derivative(u, one_minus_u);
    return {static_cast<float>(-slope), static_cast<float>(slope),
            static_cast<float>(fade(one_minus_u) - u * slope),
            static_cast<float>(fade(u) - one_minus_u * slope)};
}

}  // namespace skybake::noise
