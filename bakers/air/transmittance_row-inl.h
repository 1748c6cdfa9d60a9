// Rows of a TransmittanceField for kernels: the transmittances at one altitude, combined once and
// read for many suns.
#if defined(SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#undef SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#else
#define SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
#endif

#include "bakers/air/transmittance_field.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Reads the channels of a TransmittanceField's row at a column in [0, columns - 1].
HWY_INLINE void read_row(const double* row, Lanes column, int channels, Lanes* value) {
    const Lanes whole = ((column - Lanes(0.5)) + Lanes(kRoundToInteger)) - Lanes(kRoundToInteger);
    const Lanes t = column - whole;
    const hn::RebindToSigned<Lanes::Tag> integers;
    const Lanes first = whole * Lanes(channels) + Lanes(kRoundToInteger);
    const auto index =
        hn::Sub(hn::BitCast(integers, first.v), hn::BitCast(integers, Lanes(kRoundToInteger).v));
    for (int c = 0; c < channels; ++c) {
        const Lanes left(hn::GatherIndex(Lanes::Tag(), row + c, index));
        const Lanes right(hn::GatherIndex(Lanes::Tag(), row + channels + c, index));
        value[c] = left + t * (right - left);
    }
}

HWY_INLINE void read_row(const double* row, double column, int channels, double* value) {
    const double whole = ((column - 0.5) + kRoundToInteger) - kRoundToInteger;
    const double t = column - whole;
    for (int c = 0; c < channels; ++c) {
        const double* left = row + static_cast<int>(whole) * channels + c;
        value[c] = left[0] + t * (left[channels] - left[0]);
    }
}

// Combines the transmittances at one altitude from the field's rows, from number `first` on, which begins
// a vector.
template <class Real>
HWY_INLINE void combine_row(const TransmittanceField& field, double altitude_km, double* row,
                            int first = 0) {
    using Access = LaneAccess<Real>;
    const TransmittanceField::Row at = field.row_at(altitude_km);
    const int n = field.row_size();
    for (int i = first; i < n; i += Access::kCount) {
        const Real values = Real(at.weights[0]) * Access::load(at.values + i) +
                            Real(at.weights[1]) * Access::load(at.values + n + i);
        const Real slopes = Real(at.weights[2]) * Access::load(at.slopes + i) +
                            Real(at.weights[3]) * Access::load(at.slopes + n + i);
        Access::store(values + slopes, row + i);
    }
}

// A row made by combine_row, with the numbers that are needed to read it at its altitude.
struct SunlightRow {
    const double* values;
    int channels;
    double q;               // R_top^2 - r^2, in km^2
    double nearest_top_km;  // d_min
    double columns_per_km;
    double last_column;
    bool is_flat;  // see TransmittanceField
};

HWY_INLINE SunlightRow sunlight_row(const TransmittanceField& field, double altitude_km,
                                    const double* values) {
    const Shell& shell = field.shell();
    const double gain = shell.thickness_km - altitude_km;
    const double farthest =
        horizon_distance_km(shell, altitude_km) + horizon_distance_km(shell, shell.thickness_km);
    const double last_column = field.columns() - 1.0;
    return {values,
            field.channels(),
            square_gain_km2(shell, altitude_km, gain),
            gain,
            last_column / (farthest - gain),
            last_column,
            field.is_flat()};
}

// Returns the distance to the top where r mu_s = s. The formula of ray.h avoids the cancellation
// that this difference has for suns above the horizontal; these kernels keep the difference, so
// that the bits of their assets do not change.
template <class Real>
HWY_INLINE Real distance_to_top(const SunlightRow& at, Real s_km) {
    return square_root(s_km * s_km + Real(at.q)) - s_km;
}

// Returns the column, in [0, last_column], of a sun in whose direction the top is `distance_km` away;
// the nearest end for suns below the horizon.
template <class Real>
HWY_INLINE Real column_towards(const SunlightRow& at, Real distance_km) {
    Real column = (distance_km - Real(at.nearest_top_km)) * Real(at.columns_per_km);
    if (at.is_flat) {
        const Real x_mu = maximum(column, Real(0.0)) * Real(1 / at.last_column);
        column = Real(at.last_column) * square_root(square_root(x_mu));
    }
    return minimum(maximum(column, Real(0.0)), Real(at.last_column));
}

// Reads the transmittances towards such a sun.
template <class Real>
HWY_INLINE void sunlight_towards(const SunlightRow& at, Real distance_km, Real* value) {
    read_row(at.values, column_towards(at, distance_km), at.channels, value);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_ATMOSPHERE_TRANSMITTANCE_ROW_INL_H_
