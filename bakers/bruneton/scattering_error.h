// The error of a table of scattering, measured: its texels, and the lookups that a runtime makes.
#pragma once

#include <functional>

#include "bakers/bruneton/held_voxels.h"
#include "bakers/bruneton/scattering_content.h"
#include "bakers/bruneton/scattering_mapping.h"
#include "bakers/bruneton/scattering_reference.h"
#include "bakers/core/bake_options.h"

namespace skybake {

// At points spread evenly over x_mu_s, x_mu of both halves and x_r, and over the nu that there are.
// Texels are those next to the points whose own nu there is.
Certificate measure_scattering(const HeldVoxels& table, const ScatteringMapping& mapping,
                               const ScatteringContent& content,
                               const ScatteringReference& reference, config::PixelType type,
                               const BakeOptions& options);

}  // namespace skybake
