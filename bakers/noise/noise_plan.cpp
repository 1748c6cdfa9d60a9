#include "bakers/noise/noise_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_stacks.h"

namespace skybake::noise {
namespace {

int field_index(NoisePlan& plan, CellField field) {
    for (std::size_t i = 0; i < plan.fields.size(); ++i) {
        const CellField& other = plan.fields[i];
        if (other.kind == field.kind && other.warp == field.warp && other.key == field.key &&
            other.frequency == field.frequency && other.feature == field.feature &&
            other.value_form == field.value_form) {
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
                                       const OctaveMaker& maker, int warp, NoisePlan& plan) {
    const bool alligator = config::is_alligator(channel.type);
    std::vector<WeightedField> fields;
    const std::vector<double> weights = weights_of(octaves);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        CellField field;
        field.kind = alligator ? CellKind::alligator : CellKind::worley;
        field.warp = warp;
        field.frequency = octaves.frequencies[i];
        field.shift = maker.shift(field.frequency);
        field.key = maker.keys(alligator ? Purpose::alligator : Purpose::cells, octaves, i);
        field.feature = channel.feature;
        field.value_form = channel.value_form;
        fields.push_back({field_index(plan, std::move(field)), static_cast<float>(weights[i])});
    }
    return fields;
}

// Fills in the octaves of a channel.
void add_octaves(const NoiseChannel& channel, const OctaveMaker& maker, NoisePlan& plan,
                 ChannelPlan& result) {
    const int warp = result.warp;
    switch (channel.type) {
        case NoiseType::constant:
            break;
        case NoiseType::perlin_worley:
            result.cells = cell_fields(channel, channel.worley_octaves, maker, warp, plan);
            [[fallthrough]];
        case NoiseType::perlin:
            result.gradient = gradient_stack(channel, maker);
            break;
        case NoiseType::curl:
            result.gradient =
                curl_stack(channel.octaves, static_cast<std::size_t>(channel.component),
                           kPotentials, 1, maker);
            result.fractal = NoiseFractal::fbm;
            break;
        case NoiseType::worley:
        case NoiseType::alligator:
        case NoiseType::curly_alligator:
            result.cells = cell_fields(channel, channel.octaves, maker, warp, plan);
            break;
    }
}

// Returns the warp of a channel, which channels before it may have, too, or -1 if it has none.
int warp_index(const Noise& noise, const NoiseChannel& channel, const OctaveMaker& maker,
               NoisePlan& plan) {
    if (channel.warp_strength == 0) return -1;
    assert(channel.type != NoiseType::constant && channel.type != NoiseType::curl);
    for (std::size_t i = 0; i < plan.channels.size(); ++i) {
        const NoiseChannel& other = noise.channels[i];
        if (other.warp_strength == channel.warp_strength && other.warp_by == channel.warp_by &&
            other.warp_octaves == channel.warp_octaves && other.seed == channel.seed) {
            return plan.channels[i].warp;
        }
    }
    plan.warps.push_back(warp_plan(channel, noise.repeats, maker));
    return static_cast<int>(plan.warps.size()) - 1;
}

ChannelPlan channel_plan(const Noise& noise, const NoiseChannel& channel, NoisePlan& plan) {
    const OctaveMaker maker{plan.axes,  {noise.seed, channel.seed}, noise.period,
                            noise.time, noise.time_cells,           lowest_cells(noise)};
    ChannelPlan result;
    result.type = channel.type;
    result.value = static_cast<float>(channel.value);
    result.fractal = channel.fractal;
    result.warp = warp_index(noise, channel, maker, plan);
    add_octaves(channel, maker, plan, result);
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

// The wind carries the noise's values along, so that samples are taken against it. After a loop the
// noise has moved by whole tiles.
void add_drift(const Noise& noise, std::array<TileAxis, 3>& axes) {
    for (std::size_t i = 0; i < 3; ++i) {
        TileAxis& axis = axes[i];
        axis.drift_steps = std::int64_t{noise.period} * noise.repeats[i];
        const std::int64_t carried = -std::int64_t{noise.drift[i]} * (noise.time % noise.period);
        axis.drift = carried - floor_divide(carried, axis.drift_steps) * axis.drift_steps;
    }
}

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

NoisePlan make_noise_plan(const Noise& noise, const std::array<int, 3>& size) {
    assert(size[0] >= 1 && size[1] >= 1 && size[2] >= 1);
    NoisePlan plan;
    plan.axes = tile_axes(size, noise.sampling);
    if (noise.period > 0) add_drift(noise, plan.axes);
    plan.pack = noise.pack;
    for (const NoiseChannel& channel : noise.channels) {
        plan.channels.push_back(channel_plan(noise, channel, plan));
    }
    return plan;
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

NoisePlan tile_beyond(NoisePlan plan, std::size_t axis) {
    const auto move = [axis](auto& octave) {
        std::vector<std::int32_t>& cells = octave.cells[axis].cell;
        const int period = octave.frequency[axis];
        const int by = cells.front() < period ? period : -period;
        for (std::int32_t& cell : cells) cell += by;
    };
    const auto move_all = [&](GradientStack& stack) { std::ranges::for_each(stack.octaves, move); };
    std::ranges::for_each(plan.fields, move);
    for (ChannelPlan& channel : plan.channels) move_all(channel.gradient);
    for (WarpPlan& warp : plan.warps) std::ranges::for_each(warp, move_all);
    return plan;
}

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
