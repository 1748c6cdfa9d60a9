#include "bakers/air/optical_depth.h"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/air/optical_depth.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/optical_depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Stores what one vector of rays has, in the columns from `first` to at most `count`.
HWY_INLINE void store_depths(const Lanes* tau, int channels, int count, int first,
                             double* optical_depth) {
    const int used = std::min(static_cast<int>(Lanes::kCount), count - first);
    for (int c = 0; c < channels; ++c) {
        double values[Lanes::kCount];
        tau[c].store(values);
        for (int i = 0; i < used; ++i) optical_depth[c * count + first + i] = values[i];
    }
}

// Loads the numbers of rays, that of ray i at values[i * stride], from ray `first` of `count` on; lanes
// beyond the last ray repeat it.
HWY_INLINE Lanes load_rays(const double* values, int stride, int first, int count) {
    double rays[Lanes::kCount];
    for (int i = 0; i < static_cast<int>(Lanes::kCount); ++i) {
        rays[i] = values[std::min(first + i, count - 1) * stride];
    }
    return Lanes::load(rays);
}

// Altitude i is altitudes_km[i * stride].
void OpticalDepthRow(const Medium& medium, const double* altitudes_km, int stride,
                     const double* s_km, int count, double* optical_depth) {
    constexpr int kLanes = static_cast<int>(Lanes::kCount);
    for (int first = 0; first < count; first += kLanes) {
        Lanes tau[kMaxChannels];
        optical_depth_to_top(medium, load_rays(altitudes_km, stride, first, count),
                             load_rays(s_km, 1, first, count), tau);
        store_depths(tau, medium.channels, count, first, optical_depth);
    }
}

// The gain of altitude over a stretch x of a ray with s: (x (x + 2 s)) / (r' + r).
template <class Real>
HWY_INLINE Real gain_over(Real r_km, Real s_km, Real x_km) {
    const Real q = x_km * (x_km + Real(2.0) * s_km);
    return q / (square_root(maximum(r_km * r_km + q, Real(0.0))) + r_km);
}

// Adds the depth of a stretch x of a ray that rises all along, or falls all along.
template <class Real>
HWY_INLINE void add_stretch(const Medium& medium, ClimbStart<Real> start, Real x_km, Real* tau) {
    const auto falls = start.s_km < Real(0.0);
    if (any(falls)) {
        const Real gain = gain_over(start.r_km, start.s_km, x_km);
        start = {select(falls, start.altitude_km + gain, start.altitude_km),
                 select(falls, start.r_km + gain, start.r_km),
                 select(falls, -(start.s_km + x_km), start.s_km)};
    }
    const Real climbed = gain_over(start.r_km, start.s_km, x_km);
    add_climb(medium, start, maximum(climbed, Real(0.0)), tau);
}

// Adds the depth of a path, which may fall to the ray's nearest point and rise from there.
template <class Real>
HWY_INLINE void add_path(const Medium& medium, Real altitude_km, Real s_km, Real length_km,
                         Real* tau) {
    const Real zero(0.0);
    const Real r = Real(medium.ground_radius_km) + altitude_km;
    const auto turns = (s_km < zero) & (s_km + length_km > zero);
    if (!any(turns)) return add_stretch(medium, {altitude_km, r, s_km}, length_km, tau);
    const Real drop = select(turns, drop_to_nearest(r, s_km), zero);
    const ClimbStart<Real> start = {altitude_km - drop, r - drop, select(turns, zero, s_km)};
    add_stretch(medium, start, select(turns, -s_km, length_km), tau);
    add_stretch(medium, start, select(turns, s_km + length_km, zero), tau);
}

// Path i begins at altitudes_km[i * stride] with s_km[i * stride].
void OpticalDepthsAlong(const Medium& medium, const double* altitudes_km, const double* s_km,
                        int stride, const double* lengths_km, int count, double* optical_depth) {
    constexpr int kLanes = static_cast<int>(Lanes::kCount);
    for (int first = 0; first < count; first += kLanes) {
        Lanes tau[kMaxChannels];
        for (Lanes& of_channel : tau) of_channel = Lanes(0.0);
        add_path(medium, load_rays(altitudes_km, stride, first, count),
                 load_rays(s_km, stride, first, count), load_rays(lengths_km, 1, first, count),
                 tau);
        store_depths(tau, medium.channels, count, first, optical_depth);
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(OpticalDepthRow);
HWY_EXPORT(OpticalDepthsAlong);

void optical_depth_to_top(const Medium& medium, double altitude_km, const double* s_km, int count,
                          double* optical_depth) {
    assert(count >= 0);
    HWY_DYNAMIC_DISPATCH(OpticalDepthRow)(medium, &altitude_km, 0, s_km, count, optical_depth);
}

void optical_depth_to_top(const Medium& medium, std::span<const double> altitudes_km,
                          std::span<const double> s_km, double* optical_depth) {
    assert(altitudes_km.size() == s_km.size());
    HWY_DYNAMIC_DISPATCH(OpticalDepthRow)
    (medium, altitudes_km.data(), 1, s_km.data(), static_cast<int>(s_km.size()), optical_depth);
}

Spectrum optical_depth_to_top(const Medium& medium, double altitude_km, double s_km) {
    Spectrum tau{};
    HWY_NAMESPACE::optical_depth_to_top(medium, altitude_km, s_km, data(tau));
    return tau;
}

Spectrum optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                             double distance_km) {
    Spectrum tau{};
    const double s = (medium.ground_radius_km + altitude_km) * cos_zenith;
    HWY_NAMESPACE::add_path(medium, altitude_km, s, distance_km, data(tau));
    return tau;
}

void optical_depth_along(const Medium& medium, std::span<const double> altitudes_km,
                         std::span<const double> s_km, std::span<const double> lengths_km,
                         double* optical_depth) {
    assert(altitudes_km.size() == s_km.size() && s_km.size() == lengths_km.size());
    HWY_DYNAMIC_DISPATCH(OpticalDepthsAlong)
    (medium, altitudes_km.data(), s_km.data(), 1, lengths_km.data(), static_cast<int>(s_km.size()),
     optical_depth);
}

void optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                         std::span<const double> distances_km, double* optical_depth) {
    const double s = (medium.ground_radius_km + altitude_km) * cos_zenith;
    HWY_DYNAMIC_DISPATCH(OpticalDepthsAlong)
    (medium, &altitude_km, &s, 0, distances_km.data(), static_cast<int>(distances_km.size()),
     optical_depth);
}

}  // namespace skybake
#endif  // HWY_ONCE
