#include "bakers/light/solver/reading_levels.h"

#include <algorithm>
#include <cstddef>

#include "bakers/light/solver/solution_levels.h"

namespace skybake {
namespace {

constexpr int kPerGap = 4;  // of the altitudes, in abrupt layers
// Abrupt layers of less depth are dimmed so little that light is linear between levels.
constexpr double kThin = 0.02;

// Returns Lagrange's weights of `count` values at `from` for a place between them.
std::array<double, 4> lagrange_weights(const double* from, int count, double at) {
    std::array<double, 4> weights{};
    for (int i = 0; i < count; ++i) {
        double weight = 1;
        for (int j = 0; j < count; ++j) {
            if (j != i) weight *= (at - from[j]) / (from[i] - from[j]);
        }
        weights[static_cast<std::size_t>(i)] = weight;
    }
    return weights;
}

}  // namespace

ReadingLevels::ReadingLevels(const Medium& medium, const std::vector<double>& levels_km) {
    const std::vector<AltitudeRange> abrupt = abrupt_layers_km(medium, kThin);
    for (std::size_t i = 0; i < levels_km.size(); ++i) {
        const auto level = static_cast<int>(i);
        index_of_level_.push_back(static_cast<int>(altitudes_km_.size()));
        altitudes_km_.push_back(levels_km[i]);
        stencils_.push_back({level, {1, 0, 0, 0}, level, 0});
        const auto layer = std::ranges::find_if(abrupt, [&](AltitudeRange range) {
            return levels_km[i] >= range.bottom_km && levels_km[i] < range.top_km;
        });
        if (layer == abrupt.end()) continue;
        const auto at = [&](double altitude_km) {
            return static_cast<int>(std::ranges::lower_bound(levels_km, altitude_km) -
                                    levels_km.begin());
        };
        const int bottom = at(layer->bottom_km);
        const int top = at(layer->top_km);
        const int count = std::min(4, top - bottom + 1);
        const int first = std::clamp(level - 1, bottom, top - count + 1);
        for (int k = 1; k < kPerGap; ++k) {
            altitudes_km_.push_back(levels_km[i] + (levels_km[i + 1] - levels_km[i]) * k / kPerGap);
            stencils_.push_back(
                {first, lagrange_weights(levels_km.data() + first, count, altitudes_km_.back()),
                 level, static_cast<double>(k) / kPerGap});
        }
    }
}

LightField ReadingLevels::read(const LightField& field) const {
    LightField read(static_cast<int>(stencils_.size()), field.suns, field.degree);
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        double* to = read.at(static_cast<int>(i), 0);
        for (int k = 0; k < 4; ++k) {
            const double weight = stencils_[i].weights[static_cast<std::size_t>(k)];
            if (weight == 0) continue;
            const double* from = field.at(stencils_[i].first + k, 0);
            for (std::size_t j = 0; j < field.level_size(); ++j) to[j] += weight * from[j];
        }
    }
    read.sky_irradiance = field.sky_irradiance;
    return read;
}

LightField ReadingLevels::read_light(const LightField& light) const {
    LightField found = read(light);
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        const auto [first, weights, below, share] = stencils_[i];
        if (share == 0) continue;
        for (int sun = 0; sun < light.suns; ++sun) {
            double* to = found.at(static_cast<int>(i), sun);
            const double* low = light.at(below, sun);
            const double* high = light.at(below + 1, sun);
            for (std::size_t c = 0; c < kChannelSlots; ++c) {
                if (to[c] >= 0) continue;
                for (std::size_t k = c; k < light.sun_size(); k += kChannelSlots) {
                    to[k] = low[k] + share * (high[k] - low[k]);
                }
            }
        }
    }
    return found;
}

}  // namespace skybake
