// Optical depth in 113-bit arithmetic, straight from the definition: the referee of all kernels.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include "bakers/air/medium.h"

namespace skybake::test {

using Quad = boost::multiprecision::cpp_bin_float_quad;

inline Quad density(const PiecewiseLayer& layer, const Quad& h) {
    for (const LinearPiece& piece : layer.pieces) {
        const Quad bottom = piece.bottom_km;
        const Quad top = piece.top_km;
        if (h >= bottom && h <= top) {
            const Quad low = piece.density_at_bottom;
            const Quad high = piece.density_at_top;
            return low + (high - low) * (h - bottom) / (top - bottom);
        }
    }
    return 0;
}

// Along a ray that starts at `altitude_km` with s = r mu, over `length_km`, per channel.
inline std::array<Quad, kMaxChannels> referee_optical_depth(const Medium& medium, Quad altitude_km,
                                                            Quad s_km, Quad length_km) {
    const Quad ground = medium.ground_radius_km;
    const Quad r0 = ground + altitude_km;
    const Quad p2 = (r0 - s_km) * (r0 + s_km);
    // Every break: kinks, steps of a scale height from both ends, the lowest point.
    std::vector<Quad> altitudes;
    for (const double h : kink_altitudes_km(medium)) altitudes.emplace_back(h);
    std::vector<Quad> breaks = {0, length_km};
    for (const Quad& h : altitudes) {
        const Quad s2 = (ground + h) * (ground + h) - p2;
        if (s2 < 0) continue;
        const Quad root = sqrt(s2);
        breaks.push_back(root - s_km);
        breaks.push_back(-root - s_km);
    }
    breaks.push_back(-s_km);
    // Where the ray bends away from the ground, and where densities fall from its ends and middle.
    const Quad p = sqrt(p2);
    const Quad far = length_km + abs(s_km);
    for (Quad distance = p > far * 1e-6 ? p / 64 : far; distance < far; distance *= 4) {
        breaks.push_back(distance - s_km);
        breaks.push_back(-distance - s_km);
    }
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        std::vector<Quad> starts = {altitude_km};
        if (s_km < 0) starts.push_back(p - ground);
        for (const Quad& start : starts) {
            for (int i = 1; i <= 60; i += i < 8 ? 1 : 4) {
                const Quad r = ground + start + Quad(layer.scale_height_km) * i;
                if (r * r < p2) continue;
                breaks.push_back(sqrt(r * r - p2) - s_km);
                breaks.push_back(-sqrt(r * r - p2) - s_km);
            }
        }
    }
    breaks.erase(std::remove_if(breaks.begin(), breaks.end(),
                                [&](const Quad& x) { return x < 0 || x > length_km; }),
                 breaks.end());
    std::sort(breaks.begin(), breaks.end());
    std::array<Quad, kMaxChannels> sum{};
    const auto integrate = [&](const auto& layer, const auto& profile) {
        Quad column = 0;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            if (breaks[i + 1] - breaks[i] <= 0) continue;
            column += boost::math::quadrature::gauss<Quad, 20>::integrate(
                [&](const Quad& x) {
                    const Quad s = s_km + x;
                    return profile(sqrt(p2 + s * s) - ground);
                },
                breaks[i], breaks[i + 1]);
        }
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += column * layer.extinction_per_km[c];
    };
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        integrate(layer,
                  [&](const Quad& h) -> Quad { return exp(-h / Quad(layer.scale_height_km)); });
    }
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        integrate(layer, [&](const Quad& h) { return density(layer, h); });
    }
    return sum;
}

// To the top of the shell.
inline std::array<Quad, kMaxChannels> referee_optical_depth_to_top(const Medium& medium,
                                                                   double altitude_km,
                                                                   double s_km) {
    const Quad r = Quad(medium.ground_radius_km) + altitude_km;
    const Quad top = Quad(medium.ground_radius_km) + medium.thickness_km;
    const Quad length = sqrt(Quad(s_km) * s_km + (top - r) * (top + r)) - s_km;
    return referee_optical_depth(medium, altitude_km, s_km, length);
}

// The largest of |a - b| / b over channels; depths below 1e-15 count as that much: 113 bits leave
// 1e-34 of the planet's radius at the edges of thin layers.
inline double relative_difference(const Spectrum& a, const std::array<Quad, kMaxChannels>& b) {
    double largest = 0;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const Quad size = b[c] > 1e-15 ? b[c] : Quad(1e-15);
        largest = std::max(largest, static_cast<double>(abs((Quad(a[c]) - b[c]) / size)));
    }
    return largest;
}

}  // namespace skybake::test
