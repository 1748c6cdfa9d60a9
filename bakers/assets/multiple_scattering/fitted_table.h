// The table of content = "fitted" as bakers see it.
#pragma once

#include <array>
#include <optional>

#include "bakers/assets/multiple_scattering/fitted_radiance.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sun_columns.h"

namespace skybake {

// Fitted to the cameras and suns of the scene; without one to FitScene's.
Image2<double> fitted_texels(const SkyMedium& medium, const SolvedLight& light,
                             const std::optional<config::Scene>& scene, const SunColumns& columns,
                             std::array<int, 2> size, int threads);

// A table whose texels are given: there is nothing between them but what lookups make of them.
// `texels` must outlive it.
TableModel fitted_model(const Image2<double>& texels);

}  // namespace skybake
