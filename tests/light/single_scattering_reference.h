// Light that is scattered once, by plain vectors and Takahasi and Mori's quadrature, whose nodes crowd
// at both ends of an interval: there a low sun fades within millimetres of fog.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace skybake::test {

using Real = long double;
using Point = std::array<Real, 3>;

inline Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Point along(const Point& from, const Point& direction, Real distance) {
    return {from[0] + distance * direction[0], from[1] + distance * direction[1],
            from[2] + distance * direction[2]};
}

// One layer in one colour: exponential, or a slab where the scale height is 0.
struct PlainLayer {
    Real scattering = 0;  // 1/km, at the ground or within the slab; nothing is absorbed
    Real scale_height = 0;
    Real bottom = 0;
    Real top = 0;
    Real g = 0;  // of Henyey and Greenstein's function
    bool rayleigh = false;

    Real phase(Real cosine) const {
        const Real pi = std::numbers::pi_v<Real>;
        if (rayleigh) return 3 / (16 * pi) * (1 + cosine * cosine);
        return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, Real(1.5)));
    }
    Real density(Real altitude) const {
        if (scale_height > 0) return std::exp(-altitude / scale_height);
        return altitude > bottom && altitude < top ? 1 : 0;
    }
};

// The integral of f(x) from `from` to `to`.
template <class Function>
Real integral(Real from, Real to, Real step, const Function& f) {
    Real sum = 0;
    for (Real t = -4; t <= 4; t += step) {
        const Real turn = std::numbers::pi_v<Real> / 2 * std::sinh(t);
        // From the nearer end, where the difference of two distances would be rounding.
        const Real near = 1 / (1 + std::exp(2 * std::fabs(turn)));
        const Real weight =
            std::numbers::pi_v<Real> / 4 * std::cosh(t) / (std::cosh(turn) * std::cosh(turn));
        const Real way = (to - from) * near;
        if (!(way > 0)) continue;
        sum += step * weight * f(t < 0 ? from + way : to - way);
    }
    return (to - from) * sum;
}

class PlainAir {
  public:
    PlainAir(Real radius, Real top, std::vector<PlainLayer> layers)
        : radius_(radius), top_(top), layers_(std::move(layers)) {}

    // From a camera at an altitude, towards a zenith angle, of an azimuth from a sun.
    Real radiance(Real altitude, Real zenith, Real azimuth, Real sun_zenith) const {
        const Point camera = {0, 0, radius_ + altitude};
        const Point view = {std::sin(zenith) * std::cos(azimuth),
                            std::sin(zenith) * std::sin(azimuth), std::cos(zenith)};
        const Point sun = {std::sin(sun_zenith), 0, std::cos(sun_zenith)};
        const Real nu = dot(view, sun);
        std::vector<Real> cuts = cuts_of(camera, view);
        add_edges_of_shadow(camera, view, sun, cuts);
        Real sum = 0;
        Real passed = 0;  // optical depth up to the cut
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            sum += integral(cuts[i], cuts[i + 1], 1 / Real(16), [&](Real x) {
                const Point at = along(camera, view, x);
                if (meets_ground(at, sun)) return Real(0);
                Real sent = 0;
                const Real height = std::sqrt(dot(at, at)) - radius_;
                for (const PlainLayer& layer : layers_) {
                    sent += layer.scattering * layer.density(height) * layer.phase(nu);
                }
                if (sent == 0) return Real(0);
                return sent *
                       std::exp(-passed - depth(camera, view, cuts[i], x) - depth_to_top(at, sun));
            });
            passed += depth(camera, view, cuts[i], cuts[i + 1]);
        }
        return sum;
    }

  private:
    Real perigee(const Point& from, const Point& direction) const { return -dot(from, direction); }
    bool meets_ground(const Point& from, const Point& direction) const {
        const Real way = perigee(from, direction);
        if (way <= 0) return false;
        return dot(from, from) - way * way < radius_ * radius_;
    }
    // Where a ray crosses a sphere, ahead.
    void add_crossings(const Point& from, const Point& direction, Real radius,
                       std::vector<Real>& cuts) const {
        const Real way = perigee(from, direction);
        const Real square = radius * radius - dot(from, from) + way * way;
        if (square <= 0) return;
        for (const Real x : {way - std::sqrt(square), way + std::sqrt(square)}) {
            if (x > 0) cuts.push_back(x);
        }
    }
    // Where the planet's shadow begins and ends, by bisection.
    void add_edges_of_shadow(const Point& from, const Point& direction, const Point& sun,
                             std::vector<Real>& cuts) const {
        constexpr int kSteps = 256;
        const Real whole = cuts.back();
        const auto is_lit = [&](Real x) { return !meets_ground(along(from, direction, x), sun); };
        for (int i = 0; i < kSteps; ++i) {
            Real low = whole * i / kSteps;
            Real high = whole * (i + 1) / kSteps;
            const bool first = is_lit(low);
            if (is_lit(high) == first) continue;
            for (int k = 0; k < 60; ++k) {
                const Real middle = (low + high) / 2;
                (is_lit(middle) == first ? low : high) = middle;
            }
            cuts.push_back(low);
        }
        std::sort(cuts.begin(), cuts.end());
    }
    // From the beginning to the ground or the top.
    std::vector<Real> cuts_of(const Point& from, const Point& direction) const {
        std::vector<Real> end;
        add_crossings(from, direction, meets_ground(from, direction) ? radius_ : top_, end);
        if (end.empty()) return {0};  // at the top, but for rounding
        const Real last = meets_ground(from, direction) ? *std::min_element(end.begin(), end.end())
                                                        : *std::max_element(end.begin(), end.end());
        std::vector<Real> cuts = {0, last};
        if (perigee(from, direction) > 0) cuts.push_back(perigee(from, direction));
        for (const PlainLayer& layer : layers_) {
            if (layer.scale_height > 0) continue;
            for (const Real edge : {layer.bottom, layer.top}) {
                if (edge > 0) add_crossings(from, direction, radius_ + edge, cuts);
            }
        }
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::upper_bound(cuts.begin(), cuts.end(), last), cuts.end());
        return cuts;
    }
    // Between two distances, within which no slab's edge is crossed.
    Real depth(const Point& from, const Point& direction, Real begin, Real end) const {
        Real sum = 0;
        const Point middle = along(from, direction, (begin + end) / 2);
        const Real height = std::sqrt(dot(middle, middle)) - radius_;
        for (const PlainLayer& layer : layers_) {
            if (!(layer.scale_height > 0)) {
                sum += layer.scattering * layer.density(height) * (end - begin);
                continue;
            }
            sum += layer.scattering * integral(begin, end, 1 / Real(12), [&](Real x) {
                       const Point at = along(from, direction, x);
                       return layer.density(std::sqrt(dot(at, at)) - radius_);
                   });
        }
        return sum;
    }
    Real depth_to_top(const Point& from, const Point& direction) const {
        const std::vector<Real> cuts = cuts_of(from, direction);
        Real sum = 0;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            sum += depth(from, direction, cuts[i], cuts[i + 1]);
        }
        return sum;
    }

    Real radius_;
    Real top_;
    std::vector<PlainLayer> layers_;
};

}  // namespace skybake::test
