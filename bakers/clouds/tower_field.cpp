#include "bakers/clouds/tower_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "bakers/math/transcendental.h"

namespace skybake::cloud {
namespace {

using config::Tower;
using config::TowerLife;

// The time since a frame of the loop, in [0, 1) loops.
double loops_since(double born, const Cloud& cloud) {
    const int frame = (cloud.time % cloud.period + cloud.period) % cloud.period;
    const double since = double{1} * frame / cloud.period - born;
    const double loops = since - std::floor(since);
    return loops < 1 ? loops : 0;  // a difference of -1e-17 is rounded to 1
}

double fade(double x) { return x * x * (3 - 2 * x); }

void grow(const TowerLife& tower, double age, TowerState& state) {
    const auto [grows, stays, dissolves] = tower.life;
    const double fading = age - (grows + stays);
    if (age < grows) state.height = fade(age / grows);
    if (fading >= 0) state.amplitude = fading < dissolves ? 1 - fade(fading / dissolves) : 0;
    if (state.height == 0) state.amplitude = 0;
    state.width = tower.grows_from + (1 - tower.grows_from) * state.height;
}

void move(const Cloud& cloud, double loops, TowerState& state) {
    for (std::size_t i = 0; i < 2; ++i) state.moved[i] = cloud.drift[i] * loops;
}

Tower alive(Tower tower, const Cloud& cloud) {
    const TowerState state = tower_state(tower, tower.born, cloud);
    tower.amplitude *= state.height * state.amplitude;
    for (std::size_t i = 0; i < 2; ++i) {
        tower.sigma[i] *= state.width;
        tower.center[i] += state.moved[i];
    }
    return tower;
}

}  // namespace

TowerState tower_state(const TowerLife& tower, double born, const Cloud& cloud) {
    TowerState state;
    if (cloud.period == 0) return state;
    if (!tower.lives()) {
        move(cloud, loops_since(0, cloud), state);
        return state;
    }
    const double age = loops_since(born, cloud);
    grow(tower, age, state);
    move(cloud, age, state);
    return state;
}

std::vector<Tower> living_towers(const Cloud& cloud) {
    std::vector<Tower> towers = cloud.towers;
    for (Tower& tower : towers) tower = alive(std::move(tower), cloud);
    std::erase_if(towers, [](const Tower& tower) { return tower.amplitude == 0; });
    return towers;
}

namespace {

using std::numbers::pi;

// Terms are kept up to exp(-kLargestExponent) of the greatest.
constexpr double kLargestExponent = 25;

// Adds amplitude * exp(exponent(x[i])) to sums[i].
template <class Exponent>
void add_exponentials(std::span<const double> x, const Exponent& exponent, double amplitude,
                      double* sums) {
    constexpr std::size_t kPiece = 256;
    std::array<double, kPiece> values;
    for (std::size_t from = 0; from < x.size(); from += kPiece) {
        const std::size_t count = std::min(kPiece, x.size() - from);
        for (std::size_t i = 0; i < count; ++i) values[i] = exponent(x[from + i]);
        exponentials(values.data(), static_cast<int>(count));
        for (std::size_t i = 0; i < count; ++i) sums[from + i] += amplitude * values[i];
    }
}

}  // namespace

TowerField::Covariance TowerField::covariance_of(const Tower& tower) {
    const auto [s, t] = tower.sigma;
    const double turns = tower.rotation.radians / (2 * pi);
    const double c = cosine_of_turns(turns);
    const double n = cosine_of_turns(turns - 0.25);
    const double shared = tower.correlation * s * t;
    Covariance result;
    result.xx = c * c * s * s - 2 * c * n * shared + n * n * t * t;
    result.yy = n * n * s * s + 2 * c * n * shared + c * c * t * t;
    result.xy = c * n * (s * s - t * t) + (c * c - n * n) * shared;
    // A rotation leaves it as it is; from xx yy - xy^2 a thin tower's would cancel.
    result.determinant = s * s * t * t * (1 - tower.correlation) * (1 + tower.correlation);
    return result;
}

TowerField::Waves TowerField::waves_of(const Tower& tower, const Covariance& c) {
    Waves waves{tower.center, {}};
    const double scale = 2 * pi * std::sqrt(c.determinant) * tower.amplitude;
    // k^T C k = (xx)(kx + (xy/xx) ky)^2 + (det/xx) ky^2 <= limit
    const double limit = kLargestExponent / (2 * pi * pi);
    const auto last_y = static_cast<int>(std::floor(std::sqrt(limit * c.xx / c.determinant)));
    for (int ky = 0; ky <= last_y; ++ky) {
        const double left = limit - c.determinant / c.xx * ky * ky;
        const double middle = -c.xy / c.xx * ky;
        const double reach = std::sqrt(std::max(0.0, left) / c.xx);
        const auto first_x = static_cast<int>(std::ceil(middle - reach));
        const auto last_x = static_cast<int>(std::floor(middle + reach));
        for (int kx = ky == 0 ? 0 : first_x; kx <= last_x; ++kx) {
            const double across = kx - middle;
            const double square = c.xx * across * across + c.determinant / c.xx * ky * ky;
            const double pair = kx == 0 && ky == 0 ? 1 : 2;
            waves.waves.push_back({{kx, ky}, pair * scale * exponential(-2 * pi * pi * square)});
        }
    }
    return waves;
}

TowerField::TowerField(std::span<const Tower> towers) {
    for (const Tower& tower : towers) {
        if (tower.amplitude == 0) continue;
        const Covariance c = covariance_of(tower);
        // Images fill an area of 50 pi sqrt(det), waves one of 25 / (2 pi sqrt(det)).
        if (std::sqrt(c.determinant) <= 1 / (2 * pi)) {
            narrow_.push_back(
                {tower.center, tower.amplitude, c.yy, c.determinant / c.yy, c.xy / c.yy});
            continue;
        }
        wide_.push_back(waves_of(tower, c));
    }
}

void TowerField::add_images(const Images& tower, double y, std::span<const double> x,
                            double* sums) const {
    constexpr double kLargest = 2 * kLargestExponent;  // of q
    const double reach_y = std::sqrt(kLargest * tower.variance_y);
    const double from = tower.center[1] - y;
    // Image j lies at center + j.
    for (double j = std::ceil(-reach_y - from); j <= std::floor(reach_y - from); ++j) {
        const double dy = y - (tower.center[1] + j);
        const double q_y = dy * dy / tower.variance_y;
        const double left = kLargest - q_y;
        if (left < 0) continue;
        const double reach_x = std::sqrt(left * tower.variance_x_given_y);
        const double middle = tower.center[0] + tower.slope * dy;
        for (double i = std::ceil(x.front() - reach_x - middle);
             i <= std::floor(x.back() + reach_x - middle); ++i) {
            const double image = middle + i;
            const auto first =
                static_cast<std::size_t>(std::ranges::lower_bound(x, image - reach_x) - x.begin());
            const auto last =
                static_cast<std::size_t>(std::ranges::upper_bound(x, image + reach_x) - x.begin());
            const auto exponent = [&](double place) {
                const double dx = place - image;
                return -0.5 * (q_y + dx * dx / tower.variance_x_given_y);
            };
            add_exponentials(x.subspan(first, last - first), exponent, tower.amplitude,
                             sums + first);
        }
    }
}

void TowerField::add_waves(const Waves& tower, double y, std::span<const double> x,
                           double* sums) const {
    for (const Wave& term : tower.waves) {
        const double turns_y = term.k[1] * (y - tower.center[1]);
        for (std::size_t at = 0; at < x.size(); ++at) {
            sums[at] +=
                term.amplitude * cosine_of_turns(term.k[0] * (x[at] - tower.center[0]) + turns_y);
        }
    }
}

void TowerField::add_row(double y, std::span<const double> x, double* sums) const {
    assert(std::ranges::is_sorted(x));
    if (x.empty()) return;
    for (const Images& tower : narrow_) add_images(tower, y, x, sums);
    for (const Waves& tower : wide_) add_waves(tower, y, x, sums);
}

}  // namespace skybake::cloud
