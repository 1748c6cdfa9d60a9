// This header declares the asset "transmittance": the share of light that arrives from the top of
// the atmosphere.
#pragma once

#include <array>
#include <optional>

#include "config/sections/files.h"

namespace skybake::config {

enum class TransmittanceContent { transmittance, optical_depth };
enum class TransmittanceMapping { bruneton, ue };

struct TransmittanceBake : LightFiles {
    std::array<int, 2> size{};        // texels along the zenith angle and along altitude
    std::optional<double> max_error;  // instead of size: bound on the maximum lookup error
    TransmittanceContent content = TransmittanceContent::transmittance;
    TransmittanceMapping mapping = TransmittanceMapping::bruneton;
};

}  // namespace skybake::config
