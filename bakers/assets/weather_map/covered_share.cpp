#include "bakers/assets/weather_map/covered_share.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace skybake {
namespace {

std::size_t count_of(double share, std::size_t texels) {
    return static_cast<std::size_t>(std::llround(share * static_cast<double>(texels)));
}

// The threshold between the first `count` of the falling values and the rest; `count` is neither 0
// nor all.
double threshold(const std::vector<float>& falling, std::size_t count) {
    return (double{falling[count - 1]} + double{falling[count]}) / 2;
}

// Returns the texels that equal the first one beyond `count`, as a part of all.
TiedTexels equal_texels(const std::vector<float>& falling, std::size_t count) {
    const auto [first, last] =
        std::equal_range(falling.begin(), falling.end(), falling[count], std::greater<>());
    const auto texels = static_cast<double>(falling.size());
    return {double{falling[count]}, static_cast<double>(first - falling.begin()) / texels,
            static_cast<double>(last - falling.begin()) / texels};
}

// Divides the falling values after the first `count`. Returns how many of those that equal the
// threshold lie beyond it.
std::size_t divide(const std::vector<float>& falling, std::size_t count,
                   std::optional<TiedTexels>& tied) {
    if (count == 0 || count == falling.size()) return 0;
    if (falling[count - 1] != falling[count]) return 0;
    const TiedTexels equal = equal_texels(falling, count);
    if (equal.share_with_it - equal.share_above > kMostTied && !tied) tied = equal;
    const double last = equal.share_with_it * static_cast<double>(falling.size());
    return static_cast<std::size_t>(std::llround(last)) - count;
}

}  // namespace

double CoverRamp::operator()(double noise) const {
    if (noise < none_below) return 0;
    if (noise >= full_from) return 1;
    double t = high > low ? std::clamp((noise - low) / (high - low), 0.0, 1.0) : 1.0;
    if (edge == config::CoverEdge::smooth) t = t * t * (3 - 2 * t);
    return (1 + (std::isinf(full_from) ? 254 : 253) * t) / 255;
}

FittedRamp fit_cover_ramp(std::vector<float> noise, double covered, double full,
                          config::CoverEdge edge) {
    std::ranges::sort(noise, std::greater<>());
    const std::size_t above = count_of(covered, noise.size());
    const std::size_t whole = count_of(full, noise.size());
    FittedRamp fitted;
    fitted.left_bare = divide(noise, above, fitted.tied);
    fitted.left_thin = divide(noise, whole, fitted.tied);
    if (above == 0) return fitted;
    CoverRamp& ramp = fitted.ramp;
    ramp.edge = edge;
    ramp.low = double{noise.back()};
    ramp.high = double{noise.front()};
    ramp.none_below = -CoverRamp::kInfinity;
    if (above < noise.size()) ramp.low = ramp.none_below = threshold(noise, above);
    if (whole == noise.size()) ramp.full_from = -CoverRamp::kInfinity;
    if (whole > 0 && whole < noise.size()) ramp.high = ramp.full_from = threshold(noise, whole);
    return fitted;
}

void apply(const FittedRamp& fitted, std::vector<float>& noise) {
    constexpr float kAlmostFull = 254.0F / 255;
    std::size_t bare = fitted.left_bare;
    std::size_t thin = fitted.left_thin;
    for (std::size_t i = noise.size(); i-- > 0;) {
        const double value = double{noise[i]};
        const bool is_bare = bare > 0 && value == fitted.ramp.none_below;
        const bool is_thin = thin > 0 && value == fitted.ramp.full_from;
        if (is_bare) --bare;
        if (is_thin) --thin;
        const float covered = is_thin ? kAlmostFull : static_cast<float>(fitted.ramp(value));
        noise[i] = is_bare ? 0.0F : covered;
    }
}

}  // namespace skybake
