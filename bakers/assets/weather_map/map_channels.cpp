#include "bakers/assets/weather_map/map_channels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/math/wrapped.h"

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

// The way behind a place ends after so many lengths, where less than 1/2980 is left.
constexpr double kLengths = 8;

// The share of a texel at some distance, in texels, in the streaked one.
struct Tap {
    int x = 0;
    int y = 0;
    double weight = 0;
};

// The weights of the four texels around a place, the first one to the left of its left neighbour.
// Keys 1981, Cubic Convolution Interpolation for Digital Image Processing; exact for parabolas.
std::array<double, 4> cubic_weights(double t) {
    const double rest = 1 - t;
    return {-0.5 * t * rest * rest, 1 + t * t * (1.5 * t - 2.5),
            1 + rest * rest * (1.5 * rest - 2.5), -0.5 * rest * t * t};
}

// The taps of all steps; those at the same texel are one.
std::vector<Tap> taps_of(const Streaks& streaks, int width, int height) {
    const double step_x = -streaks.length * streaks.direction[0] * width;
    const double step_y = -streaks.length * streaks.direction[1] * height;
    const double texels = kLengths * std::max(std::fabs(step_x), std::fabs(step_y));
    const int steps = std::max(static_cast<int>(std::ceil(2 * texels)), 512);
    std::map<std::pair<int, int>, double> weights;  // by y, then x
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double s = kLengths * (i + 0.5) / steps;
        const double weight = exponential(-s);
        const double left = std::floor(s * step_x);
        const double lower = std::floor(s * step_y);
        const std::array<double, 4> across = cubic_weights(s * step_x - left);
        const std::array<double, 4> up = cubic_weights(s * step_y - lower);
        for (std::size_t y = 0; y < 4; ++y) {
            for (std::size_t x = 0; x < 4; ++x) {
                const std::pair place = {static_cast<int>(lower) - 1 + static_cast<int>(y),
                                         static_cast<int>(left) - 1 + static_cast<int>(x)};
                weights[place] += weight * up[y] * across[x];
            }
        }
        sum += weight;
    }
    std::vector<Tap> taps;
    for (const auto& [place, weight] : weights) {
        if (weight != 0) taps.push_back({place.second, place.first, weight / sum});
    }
    return taps;
}

// Adds a row that begins `shift` texels farther on, around the tile.
void add_row(const float* row, int width, int shift, double weight, std::vector<double>& sums) {
    const int first = wrapped(shift, width);
    const auto rest = static_cast<std::size_t>(width - first);
    for (std::size_t i = 0; i < rest; ++i)
        sums[i] += weight * double{row[first + std::ptrdiff_t(i)]};
    for (std::size_t i = rest; i < sums.size(); ++i) sums[i] += weight * double{row[i - rest]};
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

std::array<double, 2> wind_direction(double angle) {
    const SineCosine turned = sine_and_cosine(angle);
    return {turned.cosine, turned.sine};
}

Image2<float> streaked(const Image2<float>& noise, const Streaks& streaks,
                       const BakeOptions& options) {
    if (streaks.length == 0) return noise;
    const std::vector<Tap> taps = taps_of(streaks, noise.width, noise.height);
    Image2<float> result(noise.width, noise.height, 1);
    for_each_tile(noise.height, options, "streaks", [&](int y) {
        std::vector<double> sums(static_cast<std::size_t>(noise.width));
        for (const Tap& tap : taps) {
            const float* row = noise.texel(0, wrapped(y + tap.y, noise.height));
            add_row(row, noise.width, tap.x, tap.weight, sums);
        }
        std::ranges::transform(sums, result.texel(0, y),
                               [](double sum) { return static_cast<float>(sum); });
    });
    return result;
}

double streaked_reference(const std::function<double(double x, double y)>& noise,
                          const Streaks& streaks, double x, double y) {
    if (streaks.length == 0) return noise(x, y);
    constexpr int kIntervals = 1024;
    double sum = 0;
    double weights = 0;
    for (int i = 0; i <= kIntervals; ++i) {
        const double s = kLengths * i / kIntervals;
        const double rule = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
        const double weight = rule * exponential(-s);
        sum += weight * noise(x - s * streaks.length * streaks.direction[0],
                              y - s * streaks.length * streaks.direction[1]);
        weights += weight;
    }
    return sum / weights;
}

}  // namespace skybake
