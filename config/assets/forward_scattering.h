// This header declares the asset "forward_scattering": how much more or less sunlight a cloud sends
// on at an angle than light that is scattered once, by the optical depth to the sun.
#pragma once

#include <array>
#include <optional>

#include "config/sections/files.h"
#include "config/sections/forward.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct ForwardScatteringBake : AssetFiles {
    std::array<int, 2> size{};        // texels along the angle and along the optical depth
    std::optional<double> max_error;  // instead of size: bound on the maximum lookup error
    int degree = 3;                   // of the harmonics that hold the other light
    CloudParticles particles{};
    Length droplet_diameter{12e-6};  // chooses the phase function of droplets
    double single_scattering_albedo = 1;
};

}  // namespace skybake::config
