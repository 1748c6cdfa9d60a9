// Gradients of four dimensions at one time.
//
// Between the lattices before and after a frame, at the place v along time, improved noise of four
// dimensions is
//
//   sum over k = 0, 1 of W_k sum over the corners c of (gx u_c + gy v_c + gz w_c + gt t_k) W(c),
//
// t_k the distance to lattice k and W_k its weight. So it is noise of three dimensions whose corners
// have the gradient sum_k W_k (gx, gy, gz) and beside it the value sum_k W_k t_k gt, which needs no
// more work per voxel. gradient_blend-inl.h computes the same for vectors.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The keys of a lattice row before and after a frame.
using TimeKeys = std::array<RowKey, 2>;

inline TimeKeys time_keys(const TimeStep& time, std::uint32_t y, std::uint32_t z) {
    return {row_key(time.keys[0], y, z), row_key(time.keys[1], y, z)};
}

struct MovingGradient {
    float x = 0;
    float y = 0;
    float z = 0;
    float rest = 0;
};

inline MovingGradient gradient_at(const GradientBasis& time, const TimeKeys& keys,
                                  std::uint32_t x) {
    const Gradient4 near = lattice_gradient_4(keys[0], x);
    const Gradient4 far = lattice_gradient_4(keys[1], x);
    return {near.x * time.weight_0 + far.x * time.weight_1,
            near.y * time.weight_0 + far.y * time.weight_1,
            near.z * time.weight_0 + far.z * time.weight_1,
            near.t * time.distance_0 + far.t * time.distance_1};
}

}  // namespace skybake::noise
