#include "bakers/light/solver/solved_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace skybake {

LevelPlace SolvedLight::level_at(double altitude_km) const {
    const auto above = std::upper_bound(altitudes_km.begin(), altitudes_km.end(), altitude_km);
    const int last = static_cast<int>(altitudes_km.size()) - 2;
    const int level = std::clamp(static_cast<int>(above - altitudes_km.begin()) - 1, 0, last);
    const auto i = static_cast<std::size_t>(level);
    return {level, (altitude_km - altitudes_km[i]) / (altitudes_km[i + 1] - altitudes_km[i])};
}

SunStencil SolvedLight::stencil(double sun_cos_zenith) const {
    const SunStencil cubic = sun_stencil(suns, sun_cos_zenith);
    if (steep[static_cast<std::size_t>(cubic.column)] > 0) {
        return linear_stencil(suns, sun_cos_zenith, cubic.column);
    }
    return cubic;
}

void SolvedLight::moments_at(double altitude_km, double sun_cos_zenith, Spectrum* values) const {
    const LevelPlace place = level_at(altitude_km);
    const SunStencil around = stencil(sun_cos_zenith);
    const double sine = std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith));
    const auto count = static_cast<std::size_t>(moment_count(light.degree));
    std::fill_n(values, count, Spectrum(0.0));
    for (int side = 0; side < 2; ++side) {
        const double share = side == 0 ? 1 - place.fraction : place.fraction;
        if (share == 0) continue;
        for (int j = 0; j < 4; ++j) {
            const double weight = share * around.weights[j];
            const double* from = light.at(place.level + side, around.column + j);
            for (std::size_t lm = 0; lm < count; ++lm) {
                values[lm] += weight * packet_at(from + lm * kChannelSlots);
            }
        }
    }
    double power = 1;
    for (int m = 0; m <= light.degree; ++m) {
        for (int l = m; l <= light.degree; ++l) {
            values[moment_index(l, m)] *= power;
        }
        power *= sine;
    }
}

Spectrum SolvedLight::mean_radiance_at(double altitude_km, double sun_cos_zenith) const {
    const LevelPlace place = level_at(altitude_km);
    const SunStencil around = stencil(sun_cos_zenith);
    Spectrum mean{};
    for (int j = 0; j < 4; ++j) {
        const Spectrum low = packet_at(light.at(place.level, around.column + j));
        const Spectrum high = packet_at(light.at(place.level + 1, around.column + j));
        mean += around.weights[j] * ((1 - place.fraction) * low + place.fraction * high);
    }
    return mean * (0.5 / std::sqrt(std::numbers::pi));
}

Spectrum SolvedLight::sky_irradiance_at(double sun_cos_zenith) const {
    const SunStencil around = stencil(sun_cos_zenith);
    Spectrum sum{};
    for (int j = 0; j < 4; ++j) {
        const double* from = light.sky_irradiance.data() +
                             static_cast<std::size_t>(around.column + j) * kChannelSlots;
        sum += around.weights[j] * packet_at(from);
    }
    return sum;
}

}  // namespace skybake
