#include "bakers/assets/bruneton/lookup_fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "bakers/light/ray_pieces.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Beyond this, texels are too far apart for the light between them to be known from them alone.
constexpr double kMostScaling = 0.25;
// Positive numbers below it are not normal ones, of which there is no logarithm.
constexpr double kLeastLight = 1e-37;
// Below this share of a line's brightest texel, light is what is left of rays where they are given up:
// how much, or whether it is 0, depends on the wavelengths that are baked together.
const double kLeastShare = exponential(-ray_pieces::kLastLight);

// Light half way between texels i and i + 1 over their mean; 1 where it is not known.
double middle_share(const std::vector<double>& logarithms, const std::vector<bool>& is_lit,
                    const std::vector<double>& line, std::size_t i) {
    const std::size_t last = line.size() - 1;
    if (!is_lit[i] || !is_lit[i + 1]) return 1;
    const bool before = i > 0 && is_lit[i - 1];
    const bool after = i + 1 < last && is_lit[i + 2];
    const double near = logarithms[i];
    const double next = logarithms[i + 1];
    double middle = 0;
    if (before && after) {
        middle = (9 * (near + next) - logarithms[i - 1] - logarithms[i + 2]) / 16;
    } else if (before) {
        middle = (6 * near + 3 * next - logarithms[i - 1]) / 8;
    } else if (after) {
        middle = (3 * near + 6 * next - logarithms[i + 2]) / 8;
    } else {
        middle = (near + next) / 2;
    }
    // Light that rises and falls again within two texels is not that of a smooth line.
    middle = std::clamp(middle, std::min(near, next), std::max(near, next));
    return exponential(middle) / (0.5 * (line[i] + line[i + 1]));
}

}  // namespace

std::vector<double> lookup_scales(const std::vector<double>& line) {
    assert(std::ranges::all_of(line, [](double value) { return value >= 0; }));
    const std::size_t count = line.size();
    std::vector<double> scales(count, 1.0);
    std::vector<double> logarithms(count);
    std::vector<bool> is_lit(count);
    const double brightest = *std::ranges::max_element(line);
    const double least = std::max(kLeastLight, kLeastShare * brightest);
    for (std::size_t i = 0; i < count; ++i) {
        is_lit[i] = line[i] > least;
        if (is_lit[i]) logarithms[i] = logarithm(line[i]);
    }
    // A system of three diagonals, diagonally dominant, eliminated downwards and solved upwards.
    std::vector<double> diagonal(count, 1.0);
    std::vector<double> upper(count, 0.0);
    std::vector<double> right(count, 1.0);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double sum = line[i] + line[i + 1];
        if (!is_lit[i] || !is_lit[i + 1]) continue;
        const double a = line[i] / sum;
        const double b = line[i + 1] / sum;
        const double t = middle_share(logarithms, is_lit, line, i);
        diagonal[i] += a * a;
        diagonal[i + 1] += b * b;
        upper[i] = a * b;
        right[i] += a * t;
        right[i + 1] += b * t;
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double factor = upper[i] / diagonal[i];
        diagonal[i + 1] -= factor * upper[i];
        right[i + 1] -= factor * right[i];
    }
    for (std::size_t i = count; i-- > 0;) {
        const double next = i + 1 < count ? upper[i] * scales[i + 1] : 0;
        scales[i] = (right[i] - next) / diagonal[i];
    }
    for (double& scale : scales) scale = std::clamp(scale, 1 - kMostScaling, 1 + kMostScaling);
    return scales;
}

void fit_lookups(const ScatteringMapping& mapping, std::size_t channels, const BakeOptions& options,
                 VoxelArray& table) {
    const std::array<int, 3>& size = mapping.size();
    const auto suns = static_cast<std::size_t>(mapping.sun_size());
    const auto width = static_cast<std::size_t>(size[0]);
    for (std::size_t c = 0; c < channels; ++c) {
        const std::vector<float> exact = table.channel(c);
        std::vector<float>& fitted = table.channel(c);
        const auto fit = [&](std::size_t first, std::size_t stride, int count) {
            std::vector<double> line(static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < line.size(); ++i) line[i] = exact[first + i * stride];
            const std::vector<double> scales = lookup_scales(line);
            for (std::size_t i = 0; i < line.size(); ++i) {
                float& texel = fitted[first + i * stride];
                texel = static_cast<float>(double{texel} * scales[i]);
            }
        };
        for_each_tile(size[1] * size[2], options, "fit", [&](int tile) {
            const std::size_t row = static_cast<std::size_t>(tile) * width;
            for (int nu = 0; nu < mapping.nu_size(); ++nu) {
                fit(row + static_cast<std::size_t>(nu) * suns, 1, mapping.sun_size());
            }
            for (std::size_t sun = 0; sun < suns; ++sun) fit(row + sun, suns, mapping.nu_size());
        });
    }
}

}  // namespace skybake
