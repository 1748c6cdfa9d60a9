#include "bakers/preview/camera_altitude.h"

#include <fmt/format.h>

namespace skybake {

std::optional<config::Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                   const PreviewOptions& options) {
    if (!options.altitude_m || !assets.recipe || assets.of_kind("transmittance") == nullptr ||
        assets.of_kind("multiple_scattering") == nullptr) {
        return std::nullopt;
    }
    const config::Atmosphere& atmosphere = assets.recipe->parameters.atmosphere;
    const double top_m = atmosphere.top_radius.meters - atmosphere.ground_radius.meters;
    if (*options.altitude_m <= top_m) return std::nullopt;
    config::Diagnostic diagnostic;
    diagnostic.code = "E0110";
    diagnostic.message =
        fmt::format("--altitude: {:g} km is above the top of the atmosphere, {:g} km",
                    *options.altitude_m / 1000, top_m / 1000);
    return diagnostic;
}

}  // namespace skybake
