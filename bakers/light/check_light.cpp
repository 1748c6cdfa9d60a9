#include "bakers/light/check_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace skybake {

namespace {

// What goes in and what comes out may differ by this share: ten times what Earth's do.
constexpr double kEnergyTolerance = 0.03;
constexpr double kMostLeftOut = 0.01;

config::Diagnostic failure(std::string message) {
    config::Diagnostic diagnostic;
    diagnostic.code = "E0405";
    diagnostic.message = std::move(message);
    return diagnostic;
}

}  // namespace

std::optional<config::Diagnostic> check_light(const EnergyBalance& balance,
                                              const SolvedLight& light, const std::string& name) {
    if (!(light.left_out <= kMostLeftOut)) {
        return failure(fmt::format(
            "`{}`: after {} orders of scattering {:.2g} of the light is still missing, more than "
            "{:.2g}: air this dense, or a phase function this sharp, is beyond the solver",
            name, light.applications + 1, light.left_out, kMostLeftOut));
    }
    if (!(balance.largest_error() <= kEnergyTolerance)) {
        return failure(fmt::format(
            "`{}`: a share of {:.3g} of the light that enters is not accounted for, more than "
            "{:.3g}: air this dense, or a phase function this sharp, is beyond the solver",
            name, balance.largest_error(), kEnergyTolerance));
    }
    for (int level = 0; level < light.light.levels; ++level) {
        for (int sun = 0; sun < light.light.suns; ++sun) {
            const double* mean = light.light.at(level, sun);
            if (*std::min_element(mean, mean + kMaxChannels) >= 0) continue;
            return failure(
                fmt::format("`{}`: light at altitude_km {:.6g}, sun_cos_zenith {:.6g} is negative",
                            name, light.altitudes_km[static_cast<std::size_t>(level)],
                            light.suns.cosines[static_cast<std::size_t>(sun)]));
        }
    }
    return std::nullopt;
}

}  // namespace skybake
