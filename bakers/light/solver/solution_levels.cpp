#include "bakers/light/solver/solution_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/ray.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Levels per scale height at the ground, and the scale heights over which they thin out by e.
constexpr double kPerScaleHeight = 4;
constexpr double kThinningScaleHeights = 2.5;
// Layers are alike up to this ratio of their scale heights: levels that suit the lowest of them suit
// all.
constexpr double kAlike = 1.25;
constexpr double kOverTheShell = 8;
constexpr double kPerPiece = 3;
constexpr double kPerOpticalDepth = 2;
constexpr double kMostPerOpticalDepth = 80;  // in all
constexpr int kBlockSamples = 64;            // of a block, to place its levels
constexpr std::size_t kLevelsPerSunlightBlock = 3;

// The scale heights of exponential layers, ascending, one for all layers that are alike.
std::vector<double> distinct_scale_heights_km(const Medium& medium) {
    std::vector<double> all;
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        all.push_back(layer.scale_height_km);
    }
    std::sort(all.begin(), all.end());
    std::vector<double> distinct;
    for (const double height : all) {
        if (distinct.empty() || height > kAlike * distinct.back()) distinct.push_back(height);
    }
    return distinct;
}

// What the steepest of the pieces there asks for.
double levels_per_km_of_pieces(const Medium& medium, double altitude_km) {
    double most = 0;
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (const LinearPiece& piece : layer.pieces) {
            if (altitude_km > piece.bottom_km && altitude_km < piece.top_km) {
                most = std::max(most, kPerPiece / (piece.top_km - piece.bottom_km));
            }
        }
    }
    return most;
}

double levels_per_km(const Medium& medium, const std::vector<double>& scale_heights_km,
                     double altitude_km) {
    double density = kOverTheShell / medium.thickness_km;
    for (const double height : scale_heights_km) {
        const double reach = kThinningScaleHeights * height;
        density += kPerScaleHeight / height * exponential(-altitude_km / reach);
    }
    return density + levels_per_km_of_pieces(medium, altitude_km);
}

double largest_extinction(const Medium& medium, double altitude_km) {
    return largest(extinction_at(medium, altitude_km));
}

}  // namespace

std::vector<double> solution_levels_km(const Medium& medium, double scale) {
    std::vector<double> blocks = kink_altitudes_km(medium);
    blocks.push_back(0);
    blocks.push_back(medium.thickness_km);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());

    // Samples are closest at each block's bottom, where exponential air is densest.
    const auto sample = [&](std::size_t block, double i) {
        const double y = i / kBlockSamples;
        return blocks[block] + (blocks[block + 1] - blocks[block]) * y * y;
    };
    double depth = 0;
    for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
        for (int i = 0; i < kBlockSamples; ++i) {
            depth +=
                largest_extinction(medium, sample(b, i + 0.5)) * (sample(b, i + 1) - sample(b, i));
        }
    }
    const double per_depth =
        depth > 0 ? std::min(kPerOpticalDepth, kMostPerOpticalDepth / depth) : 0.0;

    const std::vector<double> scale_heights = distinct_scale_heights_km(medium);
    std::vector<double> levels = {0};
    for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
        std::vector<double> count = {0};  // of levels up to each sample
        for (int i = 0; i < kBlockSamples; ++i) {
            const double middle = sample(b, i + 0.5);
            const double per_km = levels_per_km(medium, scale_heights, middle) +
                                  per_depth * largest_extinction(medium, middle);
            count.push_back(count.back() + scale * per_km * (sample(b, i + 1) - sample(b, i)));
        }
        const int steps = std::max(1, static_cast<int>(std::ceil(count.back())));
        std::size_t at = 0;
        for (int k = 1; k < steps; ++k) {
            const double wanted = count.back() * k / steps;
            while (count[at + 1] < wanted) ++at;
            const double within = (wanted - count[at]) / (count[at + 1] - count[at]);
            levels.push_back(sample(b, static_cast<double>(at) + within));
        }
        levels.push_back(blocks[b + 1]);
    }
    return levels;
}

std::vector<double> sunlight_blocks_km(const Medium& medium, const std::vector<double>& levels_km) {
    const std::vector<double> kinks = kink_altitudes_km(medium);
    std::vector<double> blocks = {levels_km.front()};
    std::size_t since = 0;  // levels since the last block's end
    for (std::size_t i = 1; i < levels_km.size(); ++i) {
        ++since;
        const bool is_kink = std::find(kinks.begin(), kinks.end(), levels_km[i]) != kinks.end();
        if (since < kLevelsPerSunlightBlock && !is_kink && i + 1 < levels_km.size()) continue;
        blocks.push_back(levels_km[i]);
        since = 0;
    }
    return blocks;
}

TransmittanceField tabulated_sunlight(const Medium& medium, const std::vector<double>& levels_km,
                                      TransmittanceField::Size size, int threads) {
    constexpr double kFlat = 32;
    const double way_km = horizon_distance_km(shell_of(medium), medium.thickness_km);
    if (way_km > kFlat * medium.thickness_km) size.columns *= 2;
    return {medium, sunlight_blocks_km(medium, levels_km), size, threads};
}

}  // namespace skybake
