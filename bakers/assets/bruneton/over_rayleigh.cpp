#include "bakers/assets/bruneton/over_rayleigh.h"

#include <algorithm>
#include <cstddef>

namespace skybake {

HigherOrderParts over_rayleigh(const std::vector<Spectrum>& light,
                               const ScatteringMapping& mapping) {
    HigherOrderParts parts(light.size());
    const auto width = static_cast<std::size_t>(mapping.size()[0]);
    const auto height = static_cast<std::size_t>(mapping.size()[1]);
    for (std::size_t i = 0; i < light.size(); ++i) {
        const auto u = static_cast<int>(i % width);
        const ScatteringView view = mapping.view_of_texel(static_cast<int>(i / width % height),
                                                          static_cast<int>(i / width / height));
        const double mu = std::clamp(
            view.s_km / (mapping.shell().ground_radius_km + view.altitude_km), -1.0, 1.0);
        const FeasibleCosines feasible = feasible_cosines(mu, mapping.sun_of_texel(u));
        const double nu = std::clamp(mapping.nu_of_texel(u), feasible.low, feasible.high);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            parts[i][c] = static_cast<float>(light[i][c] / rayleigh_phase(nu));
        }
    }
    return parts;
}

}  // namespace skybake
