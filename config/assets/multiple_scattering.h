// This header declares the asset "multiple_scattering": the light scattered twice or more, per unit
// of scattering.
#pragma once

#include <array>
#include <optional>

#include "config/sections/files.h"
#include "config/sections/scene.h"

namespace skybake::config {

enum class MultipleScatteringMethod { converged, solved };
enum class MultipleScatteringContent { hillaire, moments };

struct MultipleScatteringBake : LightFiles {
    std::array<int, 2> size{};        // texels along the sun's cosine and along altitude
    std::optional<double> max_error;  // instead of size: bound on the maximum lookup error
    double max_texel_error = 0;       // quadrature error of a texel; sets the number of points
    MultipleScatteringMapping mapping = MultipleScatteringMapping::twilight;
    MultipleScatteringMethod method = MultipleScatteringMethod::solved;
    MultipleScatteringContent content = MultipleScatteringContent::hillaire;  // method solved
    int degree = 2;                                                           // for content moments
};

}  // namespace skybake::config
