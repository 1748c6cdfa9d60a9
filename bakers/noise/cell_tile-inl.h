// Finds least squared distances of a tile of voxels, in vectors along x in some rows and slices, and the
// values of cellular noise that they make.
#if defined(SKYBAKE_BAKERS_NOISE_CELL_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_NOISE_CELL_TILE_INL_H_
#undef SKYBAKE_BAKERS_NOISE_CELL_TILE_INL_H_
#else
#define SKYBAKE_BAKERS_NOISE_CELL_TILE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <limits>

#include "bakers/noise/lattice_hash-inl.h"
#include "bakers/noise/noise_plan.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Returns the value from the squared distances to the nearest and to the second nearest point.
template <class V>
HWY_INLINE V cell_value(config::WorleyFeature feature, config::WorleyValue form, V first,
                        V second) {
    constexpr float kOneOverSqrt3 = 0x1.279a74p-1f;
    const hn::DFromV<V> d;
    const V one = hn::Set(d, 1.0f);
    if (form == config::WorleyValue::one_minus_distance_squared &&
        feature != config::WorleyFeature::f2_minus_f1) {  // needs no root
        const V squared = feature == config::WorleyFeature::f1 ? first : second;
        return hn::Max(hn::Zero(d), hn::Sub(one, squared));
    }
    V distance = hn::Sqrt(feature == config::WorleyFeature::f1 ? first : second);
    if (feature == config::WorleyFeature::f2_minus_f1) {
        distance = hn::Sub(distance, hn::Sqrt(first));
    }
    switch (form) {
        case config::WorleyValue::distance:
            return distance;
        case config::WorleyValue::one_minus_distance:
            return hn::Max(hn::Zero(d), hn::Sub(one, distance));
        case config::WorleyValue::one_minus_distance_over_sqrt3:
            return hn::Sub(one, hn::Mul(distance, hn::Set(d, kOneOverSqrt3)));
        case config::WorleyValue::one_minus_distance_squared:
            return hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(distance, distance)));
    }
    return distance;
}

// Distances of samples, at fractions of their cells along an axis, to the nearer face.
template <class V>
HWY_INLINE V distance_to_face(V fraction) {
    return hn::Min(fraction, hn::Sub(hn::Set(hn::DFromV<V>(), 1.0f), fraction));
}

// True if no point beyond `rings` rings of cells can be nearer to samples at a distance of `to_face`
// to the faces of their cells than points at these squared distances are. The slack is far above what
// rounding does.
template <class V>
HWY_INLINE bool is_within_rings(V squared, int rings, V to_face) {
    const hn::DFromV<V> d;
    const V reach = hn::Add(hn::Set(d, static_cast<float>(rings)), to_face);
    return hn::AllTrue(d, hn::Le(hn::Mul(squared, hn::Set(d, 1.00001f)), hn::Mul(reach, reach)));
}

// The two greatest bumps at a place, of which alligator noise is the difference.
//
//   bump of a point = height * s(1 - d),   s(t) = 3 t^2 - 2 t^3 for t > 0, else 0,
//
// d the distance to the point in cells. A bump ends where the cells about the place's own do.
// Side Effects Software, Houdini Development Kit, sample `alligator`.
template <class V>
struct GreatestBumpsVector {
    V first, second;

    HWY_INLINE void add(V squared_distance, V height) {
        const hn::DFromV<V> d;
        const V t = hn::Max(hn::Zero(d), hn::Sub(hn::Set(d, 1.0f), hn::Sqrt(squared_distance)));
        const V rise = hn::Mul(hn::Mul(t, t), hn::Sub(hn::Set(d, 3.0f), hn::Add(t, t)));
        const V bump = hn::Mul(height, rise);
        second = hn::Max(second, hn::Min(first, bump));
        first = hn::Max(first, bump);
    }
    HWY_INLINE V value() const { return hn::Sub(first, second); }
};

// Squared distance of voxels to points along one axis: the specification's
// ((fraction - point) - offset)^2, where `offset` is minus that of the points' cells.
HWY_INLINE FloatVector squared_along(FloatVector fraction, FloatVector point, FloatVector offset) {
    const auto distance = hn::Add(hn::Sub(fraction, point), offset);
    return hn::Mul(distance, distance);
}

// Loops over a tile are unrolled at any level of optimisation, so that it stays in registers.
//
// Takes squared distances to points one after the other, and keeps the least, for kSecond also the
// second least. They are not negative, so that the bits of floats have their order, and processors
// have more units for the minima of integers.
template <std::size_t kRows, std::size_t kDepth, bool kSecond>
class CellTile {
  public:
    HWY_INLINE CellTile() {
        const auto infinity =
            hn::BitCast(kBits, hn::Set(Floats(), std::numeric_limits<float>::infinity()));
        HWY_UNROLL(8)
        for (auto& row : nearest_) {
            HWY_UNROLL(8)
            for (auto& value : row) value = infinity;
        }
        HWY_UNROLL(8)
        for (auto& row : next_) {
            HWY_UNROLL(8)
            for (auto& value : row) value = infinity;
        }
    }

    HWY_INLINE void take(std::size_t row, std::size_t slice, FloatVector squared_distance) {
        const auto squared = hn::BitCast(kBits, squared_distance);
        auto& nearest = nearest_[row][slice];
        if constexpr (kSecond) {
            auto& next = next_[row][slice];
            next = hn::Min(next, hn::Max(nearest, squared));
        }
        nearest = hn::Min(nearest, squared);
    }

    // Returns, lane by lane, the greatest of the squared distances that decide on values.
    HWY_INLINE FloatVector farthest() const {
        auto farthest = hn::Zero(kBits);
        HWY_UNROLL(8)
        for (std::size_t row = 0; row < kRows; ++row) {
            HWY_UNROLL(8)
            for (std::size_t slice = 0; slice < kDepth; ++slice) {
                farthest = hn::Max(farthest, second(row, slice));
            }
        }
        return hn::BitCast(Floats(), farthest);
    }

    HWY_INLINE FloatVector value(const CellField& field, std::size_t row, std::size_t slice) const {
        return cell_value(field.feature, field.value_form,
                          hn::BitCast(Floats(), nearest_[row][slice]),
                          hn::BitCast(Floats(), second(row, slice)));
    }

    // Writes the field's values to what place(row, slice) points to.
    template <class Place>
    HWY_INLINE void store(const CellField& field, const Place& place) const {
        HWY_UNROLL(8)
        for (std::size_t row = 0; row < kRows; ++row) {
            HWY_UNROLL(8)
            for (std::size_t slice = 0; slice < kDepth; ++slice) {
                hn::StoreU(value(field, row, slice), Floats(), place(row, slice));
            }
        }
    }

  private:
    static constexpr hn::RebindToSigned<Floats> kBits{};
    using BitsVector = hn::Vec<hn::RebindToSigned<Floats>>;

    HWY_INLINE BitsVector second(std::size_t row, std::size_t slice) const {
        if constexpr (kSecond) return next_[row][slice];
        return nearest_[row][slice];
    }

    BitsVector nearest_[kRows][kDepth];
    BitsVector next_[kSecond ? kRows : 1][kSecond ? kDepth : 1];
};

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_NOISE_CELL_TILE_INL_H_
