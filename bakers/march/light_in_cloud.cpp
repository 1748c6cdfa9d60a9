#include "bakers/march/light_in_cloud.h"

#include <algorithm>
#include <cmath>

#include "bakers/march/forward_mapping.h"
#include "bakers/math/harmonics.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

using CellLight = std::array<float, LightInCloud::kAll>;

// Two neighbours along an axis and the weight of the second.
struct Pair {
    std::size_t first = 0;
    float weight = 0;
};

Pair padded_pair(float share, int cells) {
    const float at = share * static_cast<float>(cells) + 0.5F;  // the padding comes first
    const float below = std::clamp(std::floor(at), 0.0F, static_cast<float>(cells));
    return {static_cast<std::size_t>(below), std::min(at - below, 1.0F)};
}

// Calls add(cell, weight) for the eight padded cells around a place.
template <class Add>
void for_cells_around(const LightInCloud& light, const std::array<float, 3>& place,
                      const Add& add) {
    std::array<Pair, 3> at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = padded_pair(place[a], light.cells[a]);
    const std::size_t row = static_cast<std::size_t>(light.cells[0]) + 2;
    const std::size_t plane = row * (static_cast<std::size_t>(light.cells[1]) + 2);
    const std::size_t first = at[2].first * plane + at[1].first * row + at[0].first;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::array<bool, 3> next = {(corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0};
        float weight = 1;
        for (std::size_t a = 0; a < 3; ++a) weight *= next[a] ? at[a].weight : 1 - at[a].weight;
        const std::size_t cell = first + next[2] * plane + next[1] * row + next[0];
        add(cell, weight);
    }
}

CellLight coefficients_at(const LightInCloud& light, const std::array<float, 3>& place) {
    CellLight sum{};
    for_cells_around(light, place, [&](std::size_t cell, float weight) {
        const float* values = light.values.data() + cell * LightInCloud::kAll;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * values[c];
    });
    return sum;
}

// A sum of few harmonics can fall below 0, where no light does.
float sum_of_harmonics(const float* coefficients, const LitRay& ray, std::size_t count) {
    float sum = 0;
    for (std::size_t c = 0; c < count; ++c) sum += coefficients[c] * ray.harmonics[c];
    return std::max(sum, 0.0F);
}

// The integral of F over depths from 0.
double forward_integral(const Image2<float>& table, double column, double tau) {
    const double row = forward_scattering::depth_coordinate(tau) * (table.height - 1);
    const int x = std::min(static_cast<int>(column), table.width - 2);
    const int y = std::min(static_cast<int>(row), table.height - 2);
    const double s = column - x;
    const double t = row - y;
    const float* low = table.texel(x, y);
    const float* high = table.texel(x, y + 1);
    return (double{low[0]} * (1 - s) + double{low[1]} * s) * (1 - t) +
           (double{high[0]} * (1 - s) + double{high[1]} * s) * t;
}

double mean_forward_factor(const Image2<float>& table, double column, double tau, double fall) {
    // Below this F is even, and a difference would be rounding.
    constexpr double kLeastFall = 1e-2;
    const double half = std::max(fall, kLeastFall) / 2;
    const double from = std::max(tau - half, 0.0);
    const double to = tau + half;
    return (forward_integral(table, column, to) - forward_integral(table, column, from)) /
           (to - from);
}

// The first term over E.
double sunlight_once(const LightInCloud& light, const LitRay& ray, const LitPoint& point) {
    const double tau = point.tau;
    const double width = point.width;
    const double depth = light.share * width;
    const double even = 1 - ray.forward;
    return ray.once * exponential(-light.share * tau - depth / 2 * ray.forward) *
           mean_of_exponential(even * depth, exponential(-even * depth)) /
           mean_of_exponential(depth, exponential(-depth)) *
           mean_forward_factor(light.forward, ray.column, tau, ray.forward * width);
}

}  // namespace

float sun_depth_at(const LightInCloud& light, std::array<float, 3> place) {
    if (!(place[2] < 1) || place[2] < 0) return 0;
    for (std::size_t a = 0; a < 2; ++a) place[a] -= std::floor(place[a]);
    float depth = 0;
    for_cells_around(light, place,
                     [&](std::size_t cell, float weight) { depth += weight * light.depths[cell]; });
    return depth;
}

LitRay lit_ray(const LightInCloud& light, const glm::dvec3& look, double offset) {
    LitRay ray;
    const Harmonics values = harmonics(-look);
    std::ranges::transform(values, ray.harmonics.begin(),
                           [](double value) { return static_cast<float>(value); });
    ray.once = phase_value(light.phase, offset) / light.share;
    ray.forward = std::max(1 - offset, 0.0);
    ray.column = forward_scattering::angle_coordinate_of_offset(offset) * (light.forward.width - 1);
    return ray;
}

PointLight light_of(const LightInCloud& light, const LitRay& ray, const LitPoint& point) {
    const CellLight values = coefficients_at(light, point.place);
    const double passed = 2 / (2 + light.backwards * double{point.beyond});
    const float* sky = values.data() + LightInCloud::kSun;
    PointLight found;
    found.sun = static_cast<float>(
        sunlight_once(light, ray, point) +
        passed * double{sum_of_harmonics(values.data(), ray, LightInCloud::kSun)});
    found.sky = sum_of_harmonics(sky, ray, LightInCloud::kHemisphere);
    found.ground =
        sum_of_harmonics(sky + LightInCloud::kHemisphere, ray, LightInCloud::kHemisphere);
    return found;
}

}  // namespace skybake
