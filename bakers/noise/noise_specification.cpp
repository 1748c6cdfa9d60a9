#include "bakers/noise/noise_specification.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/noise/cell_value.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

namespace {

using config::NoiseFractal;
using config::NoisePacking;
using config::NoiseType;

// Blends of gradients along z, at one lattice point of x and y.
struct BlendedAlongZ {
    float distance = 0;  // sum of gz times the distance functions
    float x = 0;         // sum of gx times the weights
    float y = 0;
};

// Blends along z and y, at one lattice point of x.
struct BlendedAlongYZ {
    float value = 0;
    float slope = 0;
};

GradientBasis basis_of(const GradientOctave& octave, std::size_t index,
                       const LatticePosition& position) {
    const bool derivative = octave.derivative_axis == static_cast<int>(index);
    const GradientBasis basis =
        derivative ? gradient_basis_derivative(position) : gradient_basis(position);
    return scaled(basis, index == 1 ? octave.amplitude : 1.0f);
}

// --- Cellular noise -----------------------------------------------------------------------------

struct NearestPoints {
    float first = std::numeric_limits<float>::infinity();  // squared distances
    float second = std::numeric_limits<float>::infinity();
    void add(float squared_distance) {
        second = std::min(second, std::max(first, squared_distance));
        first = std::min(first, squared_distance);
    }
};

// --- Channels -----------------------------------------------------------------------------------

float gradient_sum(const NoisePlan& plan, const GradientStack& stack, const Voxel& voxel) {
    float sum = 0;
    for (std::size_t i = 0; i < stack.octaves.size(); ++i) {
        const float octave = gradient_octave_at(plan.axes, stack.octaves[i], voxel);
        switch (stack.shape) {
            case OctaveShape::plain:
                sum += octave;
                break;
            case OctaveShape::absolute:
                sum += std::fabs(octave) * stack.weights[i];
                break;
            case OctaveShape::one_minus_absolute:
                sum += (1 - std::fabs(octave)) * stack.weights[i];
                break;
        }
    }
    return sum;
}

float gradient_part(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel) {
    const float sum = gradient_sum(plan, channel.gradient, voxel);
    if (channel.type == NoiseType::curl) return sum;
    if (channel.fractal == NoiseFractal::fbm) return sum * 0.5f + 0.5f;
    if (channel.fractal == NoiseFractal::rectified) return std::max(0.0f, sum);
    return sum;
}

float cell_part(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel) {
    float sum = 0;
    for (const auto& [field, weight] : channel.cells) {
        sum +=
            cell_field_at(plan.axes, plan.fields[static_cast<std::size_t>(field)], voxel) * weight;
    }
    return sum;
}

// A zero keeps its sign where the bound is zero.
float between(float value, float low, float high) {
    if (value < low) return low;
    return value > high ? high : value;
}

float shaped(const ChannelPlan& channel, float value) {
    if (channel.remapped) {
        value = (value - channel.remap_low_in) * channel.remap_scale + channel.remap_low_out;
    }
    if (channel.stepped) {
        const float x = between((value - channel.step_from) * channel.step_scale, 0, 1);
        value = (x * x) * (3 - 2 * x);
    }
    if (channel.invert) value = 1 - value;
    if (channel.biased && value >= 0 && value <= 1)
        value = value / ((1 - value) * channel.bias_slope + 1);
    if (channel.clamped) value = between(value, channel.clamp_low, channel.clamp_high);
    return value;
}

float channel_at(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel) {
    float value = channel.value;
    if (!channel.gradient.octaves.empty()) value = gradient_part(plan, channel, voxel);
    if (channel.type == NoiseType::worley) value = cell_part(plan, channel, voxel);
    if (channel.type == NoiseType::perlin_worley) {
        // remap(gradient, 0, 1, cells, 1)
        const float cells = cell_part(plan, channel, voxel);
        value = cells + value * (1 - cells);
    }
    return shaped(channel, value);
}

}  // namespace

float gradient_octave_at(const std::array<TileAxis, 3>& axes, const GradientOctave& octave,
                         const Voxel& voxel) {
    std::array<LatticePosition, 3> at;
    std::array<GradientBasis, 3> basis;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] = lattice_position(axes[axis], octave.frequency[axis], voxel[axis]);
        basis[axis] = basis_of(octave, axis, at[axis]);
    }
    const auto gradient = [&](int dx, int dy, int dz) {
        const std::uint32_t x = wrapped_cell(at[0].cell + dx, octave.frequency[0]);
        const std::uint32_t y = wrapped_cell(at[1].cell + dy, octave.frequency[1]);
        const std::uint32_t z = wrapped_cell(at[2].cell + dz, octave.frequency[2]);
        return lattice_gradient(row_key(octave.key, y, z), x);
    };
    const auto along_z = [&](int dx, int dy) {
        const Gradient near = gradient(dx, dy, 0);
        const Gradient far = gradient(dx, dy, 1);
        const GradientBasis& b = basis[2];
        return BlendedAlongZ{near.z * b.distance_0 + far.z * b.distance_1,
                             near.x * b.weight_0 + far.x * b.weight_1,
                             near.y * b.weight_0 + far.y * b.weight_1};
    };
    const auto along_yz = [&](int dx) {
        const BlendedAlongZ near = along_z(dx, 0);
        const BlendedAlongZ far = along_z(dx, 1);
        const GradientBasis& b = basis[1];
        return BlendedAlongYZ{(near.distance * b.weight_0 + near.y * b.distance_0) +
                                  (far.distance * b.weight_1 + far.y * b.distance_1),
                              near.x * b.weight_0 + far.x * b.weight_1};
    };
    const BlendedAlongYZ near = along_yz(0);
    const BlendedAlongYZ far = along_yz(1);
    const GradientBasis& b = basis[0];
    return (near.value * b.weight_0 + far.value * b.weight_1) +
           (near.slope * b.distance_0 + far.slope * b.distance_1);
}

float cell_field_at(const std::array<TileAxis, 3>& axes, const CellField& field,
                    const Voxel& voxel) {
    std::array<LatticePosition, 3> at;
    std::array<float, 3> fraction;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] = lattice_position(axes[axis], field.frequency[axis], voxel[axis]);
        fraction[axis] = cell_fraction(at[axis]);
    }
    const auto wrapped = [&](std::size_t axis, int offset) {
        return wrapped_cell(at[axis].cell + offset, field.frequency[axis]);
    };
    NearestPoints nearest;
    for (int dz = -2; dz <= 2; ++dz) {
        for (int dy = -2; dy <= 2; ++dy) {
            const RowKey row = row_key(field.key, wrapped(1, dy), wrapped(2, dz));
            for (int dx = -2; dx <= 2; ++dx) {
                const CellPoint point = cell_point(row, wrapped(0, dx));
                const float x = (fraction[0] - point.x) - static_cast<float>(dx);
                const float y = (fraction[1] - point.y) - static_cast<float>(dy);
                const float z = (fraction[2] - point.z) - static_cast<float>(dz);
                nearest.add((x * x + y * y) + z * z);
            }
        }
    }
    return cell_value(field.feature, field.value_form, nearest.first, nearest.second);
}

std::vector<float> noise_at(const NoisePlan& plan, const Voxel& voxel) {
    std::vector<float> values;
    for (const ChannelPlan& channel : plan.channels) {
        values.push_back(channel_at(plan, channel, voxel));
    }
    if (plan.pack == NoisePacking::detail) {
        return {(values[0] * 0.625f + values[1] * 0.25f) + values[2] * 0.125f};
    }
    if (plan.pack == NoisePacking::shape) {
        // remap(R, cells - 1, 1, 0, 1) with cells = .625 G + .25 B + .125 A
        const float cells = (values[1] * 0.625f + values[2] * 0.25f) + values[3] * 0.125f;
        const float gap = 1 - cells;
        return {(values[0] + gap) / (gap + 1)};
    }
    return values;
}

}  // namespace skybake::noise
