#include "bakers/air/optical_depth.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/air/optical_depth.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/optical_depth-inl.h"
#include "bakers/air/ray.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

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
        for (int c = 0; c < medium.channels; ++c) {
            double values[kLanes];
            tau[c].store(values);
            for (int i = 0; i < used; ++i) optical_depth[c * count + first + i] = values[i];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(OpticalDepthRow);

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
    // Gain of altitude over a stretch x of a ray with s: (x (x + 2 s)) / (r' + r).
    const auto gain = [](double r_from, double s_from, double x) {
        const double q = x * (x + 2 * s_from);
        return gain_of_square_km(r_from, q);
    };
    const auto climb = [&](double altitude, double r_low, double s_low, double length) {
        const double c = gain(r_low, s_low, length);
        kernel::add_climb(medium, kernel::ClimbStart<double>{altitude, r_low, s_low},
                          c > 0 ? c : 0.0, data(tau));
    };
    if (s >= 0) {
        climb(altitude_km, r, s, distance_km);
    } else if (s + distance_km <= 0) {
        const double drop = -gain(r, s, distance_km);
        climb(altitude_km - drop, r - drop, -(s + distance_km), distance_km);
    } else {
        const double drop = drop_to_nearest_km(shell_of(medium), altitude_km, s);
        climb(altitude_km - drop, r - drop, 0, -s);
        climb(altitude_km - drop, r - drop, 0, s + distance_km);
    }
    return tau;
}

}  // namespace skybake
#endif  // HWY_ONCE
