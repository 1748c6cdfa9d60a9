// This header declares the asset "phase": how particles or a layer scatter light, by angle.
#pragma once

#include <optional>
#include <string>

#include "config/sections/files.h"

namespace skybake::config {

enum class PhaseContent { phase, inverse_cumulative };
enum class PhaseSpacing { best, angle, cosine, peaks, cosine_from_back };

struct PhaseBake : LightFiles {
    std::string particles;            // NAME of a [particles.NAME]; empty: `layer` is given
    std::string layer;                // NAME of a layer of the atmosphere
    int size = 0;                     // texels
    std::optional<double> max_error;  // instead of size: bound on the maximum lookup error
    PhaseContent content = PhaseContent::phase;
    PhaseSpacing spacing = PhaseSpacing::best;  // for content phase
    int degree = 0;  // highest degree of the Legendre moments in the manifest
};

}  // namespace skybake::config
