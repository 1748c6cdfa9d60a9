#include "bakers/air/optical_depth.h"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/air/optical_depth.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/optical_depth-inl.h"
#include "bakers/air/ray.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// Stores what one vector of rays has, of which `used` are asked for, in the columns from `first` on.
HWY_INLINE void store_depths(const Lanes* tau, int channels, int count, int first, int used,
                             double* optical_depth) {
    for (int c = 0; c < channels; ++c) {
        double values[Lanes::kCount];
        tau[c].store(values);
        for (int i = 0; i < used; ++i) optical_depth[c * count + first + i] = values[i];
    }
}

// Altitude i is altitudes_km[i * stride].
void OpticalDepthRow(const Medium& medium, const double* altitudes_km, int stride,
                     const double* s_km, int count, double* optical_depth) {
    constexpr int kLanes = static_cast<int>(Lanes::kCount);
    for (int first = 0; first < count; first += kLanes) {
        const int used = count - first < kLanes ? count - first : kLanes;
        double s[kLanes];  // lanes beyond the last ray repeat it
        double altitudes[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const int ray = first + (i < used ? i : used - 1);
            s[i] = s_km[ray];
            altitudes[i] = altitudes_km[ray * stride];
        }
        Lanes tau[kMaxChannels];
        optical_depth_to_top(medium, Lanes::load(altitudes), Lanes::load(s), tau);
        store_depths(tau, medium.channels, count, first, used, optical_depth);
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
HWY_INLINE void add_stretch(const Medium& medium, const ClimbStart<double>& from, Real x_km,
                            Real* tau) {
    ClimbStart<Real> start{Real(from.altitude_km), Real(from.r_km), Real(from.s_km)};
    if (from.s_km < 0) {
        const Real gain = gain_over(start.r_km, start.s_km, x_km);
        start = {start.altitude_km + gain, start.r_km + gain, -(start.s_km + x_km)};
    }
    const Real climbed = gain_over(start.r_km, start.s_km, x_km);
    add_climb(medium, start, maximum(climbed, Real(0.0)), tau);
}

// Computes the depths of rays that rise, or of stretches that fall all along.
void OpticalDepthsAlong(const Medium& medium, double altitude_km, double s_km,
                        const double* distances_km, int count, double* optical_depth) {
    const ClimbStart<double> from = {altitude_km, medium.ground_radius_km + altitude_km, s_km};
    constexpr int kLanes = static_cast<int>(Lanes::kCount);
    for (int first = 0; first < count; first += kLanes) {
        const int used = count - first < kLanes ? count - first : kLanes;
        double distances[kLanes];  // lanes beyond the last one repeat it
        for (int i = 0; i < kLanes; ++i) {
            distances[i] = distances_km[first + (i < used ? i : used - 1)];
        }
        Lanes tau[kMaxChannels];
        for (Lanes& of_channel : tau) of_channel = Lanes(0.0);
        add_stretch(medium, from, Lanes::load(distances), tau);
        store_depths(tau, medium.channels, count, first, used, optical_depth);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
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
    namespace kernel = HWY_NAMESPACE;
    Spectrum tau{};
    const double r = medium.ground_radius_km + altitude_km;
    const double s = r * cos_zenith;
    if (s >= 0 || s + distance_km <= 0) {
        kernel::add_stretch(medium, {altitude_km, r, s}, distance_km, data(tau));
        return tau;
    }
    const double drop = drop_to_nearest_km(shell_of(medium), altitude_km, s);
    kernel::add_stretch(medium, {altitude_km - drop, r - drop, 0}, -s, data(tau));
    kernel::add_stretch(medium, {altitude_km - drop, r - drop, 0}, s + distance_km, data(tau));
    return tau;
}

void optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                         std::span<const double> distances_km, double* optical_depth) {
    const auto count = static_cast<int>(distances_km.size());
    const double s = (medium.ground_radius_km + altitude_km) * cos_zenith;
    const bool turns =
        s < 0 && std::ranges::any_of(distances_km, [s](double x) { return s + x > 0; });
    if (!turns) {
        HWY_DYNAMIC_DISPATCH(OpticalDepthsAlong)
        (medium, altitude_km, s, distances_km.data(), count, optical_depth);
        return;
    }
    for (int i = 0; i < count; ++i) {
        const Spectrum depth = optical_depth_along(medium, altitude_km, cos_zenith,
                                                   distances_km[static_cast<std::size_t>(i)]);
        for (int c = 0; c < medium.channels; ++c) optical_depth[c * count + i] = data(depth)[c];
    }
}

}  // namespace skybake
#endif  // HWY_ONCE
