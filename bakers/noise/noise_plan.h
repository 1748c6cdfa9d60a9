// A noise prepared for the kernels: octaves with their keys, weights and per-axis tables, that is,
// all that does not depend on which voxels are requested. A plan is made once per bake and then
// only read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/math/memory.h"
#include "config/sections/noise.h"

namespace skybake::noise {

// The positions of a tile's voxels on a lattice are computed in integers, so that tiling is exact
// for any size and frequency:
//
//   position of voxel i = ((2 i + o) / (2 N) + d) f cells,   o = 1: voxel centres, o = 0: lower
//   corners; d is how far the wind has carried the noise the other way, a fraction of a tile
//
// i may be any integer: voxel i + N is the same as voxel i.

// One axis of a tile: the number of voxels, and the place of the samples within them.
struct TileAxis {
    int size = 0;
    int offset = 0;  // of the sample within its voxel, in half voxels: 0 or 1
    // The samples' shift against the noise, in [0, 1) tiles: drift / drift_steps.
    std::int64_t drift = 0;
    std::int64_t drift_steps = 1;
};

std::array<TileAxis, 3> tile_axes(const std::array<int, 3>& size, config::NoiseSampling sampling);

// A sample on a lattice, at cell + numerator / denominator, with 0 <= numerator < denominator.
struct LatticePosition {
    std::int64_t cell = 0;  // not wrapped
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;
};

inline std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
    const std::int64_t quotient = a / b;
    return quotient - (a % b < 0 ? 1 : 0);
}

inline LatticePosition lattice_position(const TileAxis& axis, int frequency, std::int64_t voxel) {
    const std::int64_t denominator = std::int64_t{2} * axis.size * axis.drift_steps;
    const std::int64_t steps = (2 * voxel + axis.offset) * axis.drift_steps;
    const std::int64_t scaled = (steps + std::int64_t{2} * axis.size * axis.drift) * frequency;
    const std::int64_t cell = floor_divide(scaled, denominator);
    return {cell, scaled - cell * denominator, denominator};
}

// True if the lattice has at most one cell per voxel along every axis of more than one voxel. Then
// neighbouring voxels share lattice points, and the kernels that use this apply.
bool is_resolved(const std::array<TileAxis, 3>& axes, const std::array<int, 3>& frequency);

// Returns the position in the cell, in [0, 1), rounded to float as the kernels for cells use it.
inline float cell_fraction(const LatticePosition& position) {
    return static_cast<float>(static_cast<double>(position.numerator) /
                              static_cast<double>(position.denominator));
}

// Returns the cell's index in the lattice, which repeats after `frequency` cells.
inline std::uint32_t wrapped_cell(std::int64_t cell, int frequency) {
    return static_cast<std::uint32_t>(cell - floor_divide(cell, frequency) * frequency);
}

// Vectors of up to this many floats may be loaded from any voxel of an axis on.
inline constexpr int kLanePadding = 16;

// One octave's cells along one axis, for voxels 0 to size - 1, and kLanePadding further entries
// with the last cell and fraction 0.
struct AxisCells {
    std::vector<std::int32_t> cell;  // below twice the frequency, as noise may drift by a tile
    AlignedFloats fraction;          // position in the cell, in [0, 1), rounded to float
};

// The four functions of GradientBasis for each voxel, padded by zeros.
struct AxisBasis {
    AlignedFloats weight_0, weight_1, distance_0, distance_1;
};

// Gradient noise along one axis as a sum of four products.
//
// Let u be the position in a cell, w = 6u^5 - 15u^4 + 10u^3 and v = u - 1. Improved noise is
//
//   sum over the corners k of a cell of  (gx u_k + gy v_k + gz t_k) W(x) W(y) W(z),
//
// so along each axis it consists of the weights (1-w, w) and of (u (1-w), v w), distances times
// weights. Its derivative along an axis is the same sum with the derivatives of that axis's four
// functions. They are computed in double from an exact fraction and rounded once.
struct GradientBasis {
    float weight_0 = 0;    // 1 - w
    float weight_1 = 0;    // w
    float distance_0 = 0;  // u (1 - w)
    float distance_1 = 0;  // (u - 1) w
};

GradientBasis gradient_basis(const LatticePosition& position);

// Returns each function multiplied by a factor, rounded to float.
inline GradientBasis scaled(const GradientBasis& basis, float factor) {
    return {basis.weight_0 * factor, basis.weight_1 * factor, basis.distance_0 * factor,
            basis.distance_1 * factor};
}

// Returns the derivative of each function by u.
GradientBasis gradient_basis_derivative(const LatticePosition& position);

// The place of a frame on the fourth axis of a lattice, between two lattices of three dimensions.
struct TimeStep {
    std::array<std::uint64_t, 2> keys{};  // of the lattice before the frame and of that after it
    GradientBasis basis;
};

// One octave of gradient noise, or its derivative along an axis.
struct GradientOctave {
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    int derivative_axis = -1;      // -1: the noise itself
    float amplitude = 1;           // factor on the noise itself
    std::optional<TimeStep> time;  // none: the noise has three dimensions
    std::array<AxisCells, 3> cells;
    std::array<AxisBasis, 3> basis;  // the y axis's are multiplied by the amplitude
};

// The function of an octave's value n that is weighted and summed.
enum class OctaveShape { plain, absolute, one_minus_absolute };

// The sum over octaves of weight * shape(n). For OctaveShape::plain the weights are contained in
// the amplitudes.
struct GradientStack {
    OctaveShape shape = OctaveShape::plain;
    std::vector<GradientOctave> octaves;
    std::vector<float> weights;
};

// The three components of a displacement, in tiles.
using WarpPlan = std::array<GradientStack, 3>;

// The functions that an octave may make of the points of cells.
enum class CellKind { worley, alligator };

// How far points are along their paths, in [0, kPathSteps) each (lattice_hash.h). A loop in time has n
// slow paths and n + 1 fast ones, so that no part of it is played twice.
struct PathShift {
    std::uint32_t slow = 0;
    std::uint32_t fast = 0;
    bool operator==(const PathShift&) const = default;
};

// One octave of cellular noise. Channels that use equal octaves share one field.
struct CellField {
    CellKind kind = CellKind::worley;
    int warp = -1;    // index in NoisePlan::warps; -1: voxels are read where they are
    PathShift shift;  // of points along their paths
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    config::WorleyFeature feature = config::WorleyFeature::f1;
    config::WorleyValue value_form = config::WorleyValue::distance;
    std::array<AxisCells, 3> cells;
};

struct WeightedField {
    int field = 0;  // index in NoisePlan::fields
    float weight = 0;
};

struct ChannelPlan {
    NoiseType type = NoiseType::constant;
    float value = 0;  // constant
    NoiseFractal fractal = NoiseFractal::fbm;
    GradientStack gradient;
    std::vector<WeightedField> cells;
    int warp = -1;  // of its gradients and cells
    // Changes that are applied to the noise, in this order.
    bool remapped = false;
    float remap_low_in = 0, remap_scale = 1, remap_low_out = 0;
    bool stepped = false;
    float step_from = 0, step_scale = 1;  // 1 / (to - from)
    bool invert = false;
    bool biased = false;
    float bias_slope = 0;  // 1/b - 2
    bool clamped = false;
    float clamp_low = 0, clamp_high = 1;

    // True if any of these changes a value.
    bool is_shaped() const { return remapped || stepped || invert || biased || clamped; }
};

struct NoisePlan {
    std::array<TileAxis, 3> axes;
    std::vector<WarpPlan> warps;
    std::vector<CellField> fields;
    std::vector<ChannelPlan> channels;
    NoisePacking pack = NoisePacking::none;
    int output_channels() const {
        return pack == NoisePacking::none ? static_cast<int>(channels.size()) : 1;
    }
};

NoisePlan make_noise_plan(const Noise& noise, const std::array<int, 3>& size);

// Returns the plan whose voxels on a lower face are those a tile's length away: their cells are a
// period of each lattice further on, or further back where the wind has carried them past the first.
NoisePlan tile_beyond(NoisePlan plan, std::size_t axis);

}  // namespace skybake::noise
