#include "tests/noise/noise_specification.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/noise/lattice_hash.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;
using config::WorleyValue;

// How far from its voxel a sample is, in tiles. Null: it is not displaced.
using Displacement = std::array<float, 3>;

// A sample's cell along an axis, not wrapped, and its place in it.
struct CellPlace {
    std::int64_t cell = 0;
    float fraction = 0;
};

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
    return derivative ? gradient_basis_derivative(position) : gradient_basis(position);
}

// A displacement by whole tiles is none, so that what is left of it has all its digits.
CellPlace displaced_place(const LatticePosition& position, int frequency, float displacement) {
    const float within = displacement - std::nearbyint(displacement);
    const float place = cell_fraction(position) + within * static_cast<float>(frequency);
    const float cells = std::floor(place);
    return {position.cell + static_cast<std::int64_t>(cells), place - cells};
}

// The functions of gradient_basis in single precision.
GradientBasis basis_at(float u) {
    const float weight_1 = ((u * u) * u) * (u * (6 * u - 15) + 10);
    const float weight_0 = 1 - weight_1;
    return {weight_0, weight_1, u * weight_0, (u - 1) * weight_1};
}

struct MovingGradient {
    float x = 0;
    float y = 0;
    float z = 0;
    float rest = 0;
};

// A gradient of four dimensions at one time (gradient_blend-inl.h).
MovingGradient gradient_at(const TimeStep& time, std::uint32_t x, std::uint32_t y,
                           std::uint32_t z) {
    const Gradient4 near = lattice_gradient_4(row_key(time.keys[0], y, z), x);
    const Gradient4 far = lattice_gradient_4(row_key(time.keys[1], y, z), x);
    const GradientBasis& b = time.basis;
    return {near.x * b.weight_0 + far.x * b.weight_1, near.y * b.weight_0 + far.y * b.weight_1,
            near.z * b.weight_0 + far.z * b.weight_1, near.t * b.distance_0 + far.t * b.distance_1};
}

// The octave's lattice has a gradient at each point, and a value beside it if it changes in time.
MovingGradient gradient_of(const GradientOctave& octave, std::uint32_t x, std::uint32_t y,
                           std::uint32_t z) {
    if (octave.time) return gradient_at(*octave.time, x, y, z);
    const Gradient gradient = lattice_gradient(row_key(octave.key, y, z), x);
    return {gradient.x, gradient.y, gradient.z, 0};
}

// Returns one octave of gradient noise multiplied by its amplitude.
float gradient_octave_at(const std::array<TileAxis, 3>& axes, const GradientOctave& octave,
                         const Voxel& voxel, const Displacement* displacement) {
    std::array<std::int64_t, 3> cell;
    std::array<GradientBasis, 3> basis;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const LatticePosition at =
            lattice_position(axes[axis], octave.frequency[axis], voxel[axis]);
        cell[axis] = at.cell;
        basis[axis] = basis_of(octave, axis, at);
        if (displacement != nullptr) {
            const CellPlace place =
                displaced_place(at, octave.frequency[axis], (*displacement)[axis]);
            cell[axis] = place.cell;
            basis[axis] = basis_at(place.fraction);
        }
    }
    basis[1] = scaled(basis[1], octave.amplitude);
    const auto gradient = [&](int dx, int dy, int dz) {
        return gradient_of(octave, wrapped_cell(cell[0] + dx, octave.frequency[0]),
                           wrapped_cell(cell[1] + dy, octave.frequency[1]),
                           wrapped_cell(cell[2] + dz, octave.frequency[2]));
    };
    const auto along_z = [&](int dx, int dy) {
        const MovingGradient near = gradient(dx, dy, 0);
        const MovingGradient far = gradient(dx, dy, 1);
        const GradientBasis& b = basis[2];
        BlendedAlongZ blended{near.z * b.distance_0 + far.z * b.distance_1,
                              near.x * b.weight_0 + far.x * b.weight_1,
                              near.y * b.weight_0 + far.y * b.weight_1};
        if (octave.time) {
            blended.distance += near.rest * b.weight_0 + far.rest * b.weight_1;
        }
        return blended;
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

// --- Cellular noise -----------------------------------------------------------------------------

struct NearestPoints {
    float first = std::numeric_limits<float>::infinity();  // squared distances
    float second = std::numeric_limits<float>::infinity();
    void add(float squared_distance) {
        second = std::min(second, std::max(first, squared_distance));
        first = std::min(first, squared_distance);
    }
};

constexpr float kOneOverSqrt3 = 0x1.279a74p-1f;

bool needs_no_root(WorleyFeature feature, WorleyValue form) {
    return form == WorleyValue::one_minus_distance_squared && feature != WorleyFeature::f2_minus_f1;
}

// Returns the value from the squared distances to the nearest and to the second nearest point.
float cell_value(WorleyFeature feature, WorleyValue form, float first, float second) {
    if (needs_no_root(feature, form)) {
        return std::max(0.0f, 1 - (feature == WorleyFeature::f1 ? first : second));
    }
    float distance = std::sqrt(feature == WorleyFeature::f1 ? first : second);
    if (feature == WorleyFeature::f2_minus_f1) distance -= std::sqrt(first);
    switch (form) {
        case WorleyValue::distance:
            return distance;
        case WorleyValue::one_minus_distance:
            return std::max(0.0f, 1 - distance);
        case WorleyValue::one_minus_distance_over_sqrt3:
            return 1 - distance * kOneOverSqrt3;
        case WorleyValue::one_minus_distance_squared:
            return std::max(0.0f, 1 - distance * distance);
    }
    return distance;
}

// The two greatest bumps at a place (cell_tile-inl.h).
struct GreatestBumps {
    float first = 0;
    float second = 0;

    void add(float squared_distance, float height) {
        const float t = std::max(0.0f, 1 - std::sqrt(squared_distance));
        const float bump = height * ((t * t) * (3 - 2 * t));
        second = std::max(second, std::min(first, bump));
        first = std::max(first, bump);
    }
    float value() const { return first - second; }
};

// Returns one octave of cellular noise: worley noise in its value form, from the nearest points
// among the 125 cells around the sample, which always contain them, or alligator noise.
float cell_field_at(const std::array<TileAxis, 3>& axes, const CellField& field, const Voxel& voxel,
                    const Displacement* displacement) {
    std::array<CellPlace, 3> at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const LatticePosition position =
            lattice_position(axes[axis], field.frequency[axis], voxel[axis]);
        at[axis] = displacement == nullptr
                       ? CellPlace{position.cell, cell_fraction(position)}
                       : displaced_place(position, field.frequency[axis], (*displacement)[axis]);
    }
    const auto wrapped = [&](std::size_t axis, int offset) {
        return wrapped_cell(at[axis].cell + offset, field.frequency[axis]);
    };
    NearestPoints nearest;
    GreatestBumps bumps;
    for (int dz = -2; dz <= 2; ++dz) {
        for (int dy = -2; dy <= 2; ++dy) {
            const RowKey row = row_key(field.key, wrapped(1, dy), wrapped(2, dz));
            for (int dx = -2; dx <= 2; ++dx) {
                const CellPoint point = cell_point(row, wrapped(0, dx), field.shift);
                const float x = (at[0].fraction - point.x) - static_cast<float>(dx);
                const float y = (at[1].fraction - point.y) - static_cast<float>(dy);
                const float z = (at[2].fraction - point.z) - static_cast<float>(dz);
                const float squared_distance = (x * x + y * y) + z * z;
                nearest.add(squared_distance);
                bumps.add(squared_distance, point.height);
            }
        }
    }
    if (field.kind == CellKind::alligator) return bumps.value();
    return cell_value(field.feature, field.value_form, nearest.first, nearest.second);
}

// --- Channels -----------------------------------------------------------------------------------

float gradient_sum(const NoisePlan& plan, const GradientStack& stack, const Voxel& voxel,
                   const Displacement* displacement) {
    float sum = 0;
    for (std::size_t i = 0; i < stack.octaves.size(); ++i) {
        const float octave = gradient_octave_at(plan.axes, stack.octaves[i], voxel, displacement);
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

float gradient_part(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel,
                    const Displacement* displacement) {
    const float sum = gradient_sum(plan, channel.gradient, voxel, displacement);
    if (channel.type == NoiseType::curl) return sum;
    if (channel.fractal == NoiseFractal::fbm) return sum * 0.5f + 0.5f;
    if (channel.fractal == NoiseFractal::rectified) return std::max(0.0f, sum);
    return sum;
}

float cell_part(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel,
                const Displacement* displacement) {
    float sum = 0;
    for (const auto& [field, weight] : channel.cells) {
        sum += cell_field_at(plan.axes, plan.fields[static_cast<std::size_t>(field)], voxel,
                             displacement) *
               weight;
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

Displacement displacement_at(const NoisePlan& plan, const WarpPlan& warp, const Voxel& voxel) {
    Displacement displacement{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        displacement[axis] = gradient_sum(plan, warp[axis], voxel, nullptr);
    }
    return displacement;
}

float channel_at(const NoisePlan& plan, const ChannelPlan& channel, const Voxel& voxel) {
    float value = channel.value;
    Displacement displacement{};
    const Displacement* displaced = nullptr;
    if (channel.warp >= 0) {
        displacement =
            displacement_at(plan, plan.warps[static_cast<std::size_t>(channel.warp)], voxel);
        displaced = &displacement;
    }
    if (!channel.gradient.octaves.empty()) value = gradient_part(plan, channel, voxel, displaced);
    if (channel.type == NoiseType::worley || config::is_alligator(channel.type)) {
        value = cell_part(plan, channel, voxel, displaced);
    }
    if (channel.type == NoiseType::perlin_worley) {
        // remap(gradient, 0, 1, cells, 1)
        const float cells = cell_part(plan, channel, voxel, displaced);
        value = cells + value * (1 - cells);
    }
    return shaped(channel, value);
}

}  // namespace

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
