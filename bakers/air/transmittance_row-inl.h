// Rows of a TransmittanceField for kernels: one altitude's transmittances, made once and read for
// many suns.
#if defined(SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#undef SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#else
#define SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#endif

#include "bakers/air/transmittance_field.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// Reads the channels of a TransmittanceField's row at a column in [0, columns - 1].
HWY_INLINE void read_row(const double* row, int stride, Lanes column, int channels, Lanes* value) {
    const Lanes shifted = (column - Lanes(0.5)) + Lanes(kRoundToInteger);
    const Lanes t = column - (shifted - Lanes(kRoundToInteger));
    const hn::RebindToSigned<Lanes::Tag> integers;
    const auto index =
        hn::Sub(hn::BitCast(integers, shifted.v), hn::BitCast(integers, Lanes(kRoundToInteger).v));
    for (int c = 0; c < channels; ++c) {
        const double* channel = row + c * stride;
        const Lanes left(hn::GatherIndex(Lanes::Tag(), channel, index));
        const Lanes right(hn::GatherIndex(Lanes::Tag(), channel + 1, index));
        value[c] = left + t * (right - left);
    }
}

HWY_INLINE void read_row(const double* row, int stride, double column, int channels,
                         double* value) {
    const double whole = ((column - 0.5) + kRoundToInteger) - kRoundToInteger;
    const double t = column - whole;
    for (int c = 0; c < channels; ++c) {
        const double* left = row + c * stride + static_cast<int>(whole);
        value[c] = left[0] + t * (left[1] - left[0]);
    }
}

// The transmittances at one altitude, combined from the field's rows.
template <class Real>
HWY_INLINE void combine_row(const TransmittanceField& field, double altitude_km, double* row) {
    using Access = LaneAccess<Real>;
    const TransmittanceField::Row at = field.row_at(altitude_km);
    const int n = field.row_size();
    for (int i = 0; i < n; i += Access::kCount) {
        const Real values = Real(at.weights[0]) * Access::load(at.values + i) +
                            Real(at.weights[1]) * Access::load(at.values + n + i);
        const Real slopes = Real(at.weights[2]) * Access::load(at.slopes + i) +
                            Real(at.weights[3]) * Access::load(at.slopes + n + i);
        Access::store(values + slopes, row + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
