// Blends the gradients of the eight corners of a vector of samples' cells, also those of four
// dimensions at one time.
//
// Between the lattices before and after a frame, at the place v along time, improved noise of four
// dimensions is
//
//   sum over k = 0, 1 of W_k sum over the corners c of (gx u_c + gy v_c + gz w_c + gt t_k) W(c),
//
// t_k the distance to lattice k and W_k its weight. So it is noise of three dimensions whose corners
// have the gradient sum_k W_k (gx, gy, gz) and beside it the value sum_k W_k t_k gt, which needs no
// more work per voxel.
#if defined(SKYBAKE_BAKERS_NOISE_GRADIENT_BLEND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_GRADIENT_BLEND_INL_H_
#undef SKYBAKE_BAKERS_NOISE_GRADIENT_BLEND_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_GRADIENT_BLEND_INL_H_
#endif

#include <hwy/highway.h>

#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/noise_plan.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE FloatVector blend(FloatVector a, FloatVector weight_a, FloatVector b,
                             FloatVector weight_b) {
    return hn::Add(hn::Mul(a, weight_a), hn::Mul(b, weight_b));
}

struct MovingGradientVector {
    FloatVector x, y, z, rest;
};

HWY_INLINE MovingGradientVector gradient_at(const GradientBasis& time, const RowKeyVector& before,
                                            const RowKeyVector& after, WordVector scaled_x) {
    const Floats d;
    const Gradient4Vector near = lattice_gradient_4(before, scaled_x);
    const Gradient4Vector far = lattice_gradient_4(after, scaled_x);
    const auto weight_0 = hn::Set(d, time.weight_0);
    const auto weight_1 = hn::Set(d, time.weight_1);
    return {blend(near.x, weight_0, far.x, weight_1), blend(near.y, weight_0, far.y, weight_1),
            blend(near.z, weight_0, far.z, weight_1),
            blend(near.t, hn::Set(d, time.distance_0), far.t, hn::Set(d, time.distance_1))};
}

// The functions of GradientBasis.
struct Basis {
    FloatVector weight_0, weight_1, distance_0, distance_1;
};

// basis_at has those of one voxel, bases_from those of the voxels from one on.
HWY_INLINE Basis basis_at(const AxisBasis& axis, std::size_t voxel) {
    return {hn::Set(kFloats, axis.weight_0[voxel]), hn::Set(kFloats, axis.weight_1[voxel]),
            hn::Set(kFloats, axis.distance_0[voxel]), hn::Set(kFloats, axis.distance_1[voxel])};
}

HWY_INLINE Basis bases_from(const AxisBasis& axis, std::size_t voxel) {
    return {hn::LoadU(kFloats, axis.weight_0.data() + voxel),
            hn::LoadU(kFloats, axis.weight_1.data() + voxel),
            hn::LoadU(kFloats, axis.distance_0.data() + voxel),
            hn::LoadU(kFloats, axis.distance_1.data() + voxel)};
}

struct CellBasis {
    Basis x, y, z;
};

struct BlendedAlongZ {
    FloatVector distance, x, y;
};

struct BlendedAlongYZ {
    FloatVector value, slope;
};

template <class Gradient>
HWY_INLINE BlendedAlongZ along_z(const Gradient& near, const Gradient& far, const Basis& z) {
    auto distance = blend(near.z, z.distance_0, far.z, z.distance_1);
    if constexpr (requires { near.rest; }) {
        distance = hn::Add(distance, blend(near.rest, z.weight_0, far.rest, z.weight_1));
    }
    return {distance, blend(near.x, z.weight_0, far.x, z.weight_1),
            blend(near.y, z.weight_0, far.y, z.weight_1)};
}

// Lattice rows whose gradients stand still, and ones whose gradients change in time. keys(key) returns
// those of each lane's row for the key of a lattice.
struct StillRow {
    template <class RowKeys>
    static HWY_INLINE StillRow of(const GradientOctave& octave, const RowKeys& keys) {
        return {keys(octave.key)};
    }
    HWY_INLINE GradientVector gradient(WordVector scaled_x) const {
        return lattice_gradient(key, scaled_x);
    }
    RowKeyVector key;
};

struct MovingRow {
    template <class RowKeys>
    static HWY_INLINE MovingRow of(const GradientOctave& octave, const RowKeys& keys) {
        const TimeStep& time = *octave.time;
        return {&time.basis, keys(time.keys[0]), keys(time.keys[1])};
    }
    HWY_INLINE MovingGradientVector gradient(WordVector scaled_x) const {
        return gradient_at(*time, before, after, scaled_x);
    }
    const GradientBasis* time;
    RowKeyVector before, after;
};

// rows[dy][dz].gradient(scaled_x) returns the gradients at lattice points.
template <class Row>
HWY_INLINE BlendedAlongYZ along_yz(const Row (&rows)[2][2], WordVector scaled_x, const Basis& y,
                                   const Basis& z) {
    const BlendedAlongZ near =
        along_z(rows[0][0].gradient(scaled_x), rows[0][1].gradient(scaled_x), z);
    const BlendedAlongZ far =
        along_z(rows[1][0].gradient(scaled_x), rows[1][1].gradient(scaled_x), z);
    return {hn::Add(blend(near.distance, y.weight_0, near.y, y.distance_0),
                    blend(far.distance, y.weight_1, far.y, y.distance_1)),
            blend(near.x, y.weight_0, far.x, y.weight_1)};
}

template <class Row>
HWY_INLINE FloatVector blended_gradients(const Row (&rows)[2][2], WordVector near_x,
                                         WordVector far_x, const CellBasis& basis) {
    const Basis& x = basis.x;
    const BlendedAlongYZ near = along_yz(rows, near_x, basis.y, basis.z);
    const BlendedAlongYZ far = along_yz(rows, far_x, basis.y, basis.z);
    return hn::Add(blend(near.value, x.weight_0, far.value, x.weight_1),
                   blend(near.slope, x.distance_0, far.slope, x.distance_1));
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_GRADIENT_BLEND_INL_H_
