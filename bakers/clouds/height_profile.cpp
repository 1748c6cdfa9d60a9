#include "bakers/clouds/height_profile.h"

#include <algorithm>
#include <cstddef>

#include "bakers/math/transcendental.h"

namespace skybake::cloud {

namespace {

using config::HeightPoint;
using config::HeightProfileType;

// Heights at which a type begins, is full, begins to thin, ends.
struct Heights {
    double begin, full, thin, end;
};
constexpr std::array<Heights, 3> kClassicHeights = {
    {{0.02, 0.05, 0.09, 0.11}, {0.02, 0.2, 0.48, 0.625}, {0.01, 0.0625, 0.78, 1.0}}};

double smooth_ramp(double from, double to, double h) {
    const double x = std::clamp((h - from) / (to - from), 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

double classic_profile(const Heights& heights, double h) {
    return smooth_ramp(heights.begin, heights.full, h) *
           (1 - smooth_ramp(heights.thin, heights.end, h));
}

// 1 - e^-x for x >= 0, without cancellation: e^-x = u is off by a rounding, and so is ln u, alike
// (Kahan's device; Higham 2002, Accuracy and Stability of Numerical Algorithms, section 1.14.1).
double one_minus_exponential(double x) {
    const double u = exponential(-x);
    if (u == 1) return x;
    if (u < 0.5) return 1 - u;
    return (1 - u) * x / -logarithm(u);
}

double tabulated(const std::vector<HeightPoint>& table, double h) {
    const auto above = std::upper_bound(
        table.begin(), table.end(), h,
        [](double height, const HeightPoint& point) { return height < point.height; });
    if (above == table.begin()) return table.front().value;
    if (above == table.end()) return table.back().value;
    const HeightPoint& low = *(above - 1);
    const double t = (h - low.height) / (above->height - low.height);
    return low.value * (1 - t) + above->value * t;
}

}  // namespace

std::array<double, 3> classic_profiles(double h) {
    std::array<double, 3> values;
    for (std::size_t i = 0; i < 3; ++i) values[i] = classic_profile(kClassicHeights[i], h);
    return values;
}

std::array<double, 3> type_weights(double cloud_type) {
    const double to_second = std::min(2 * cloud_type, 1.0);
    const double to_third = std::max(2 * cloud_type - 1, 0.0);
    return {1 - to_second, to_second - to_third, to_third};
}

double height_profile(const config::HeightProfile& profile, double h) {
    const auto classic = [&](std::size_t type) { return classic_profiles(h)[type]; };
    switch (profile.type) {
        case HeightProfileType::thesis:
            return one_minus_exponential(profile.bottom_sharpness * h) *
                   exponential(-profile.top_falloff * h);
        case HeightProfileType::stratus:
            return classic(0);
        case HeightProfileType::stratocumulus:
            return classic(1);
        case HeightProfileType::cumulus:
            return classic(2);
        case HeightProfileType::tabulated:
            return tabulated(profile.table, h);
        case HeightProfileType::blended:
            break;
    }
    const std::array<double, 3> values = classic_profiles(h);
    const std::array<double, 3> weights = type_weights(profile.cloud_type);
    return values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2];
}

}  // namespace skybake::cloud
