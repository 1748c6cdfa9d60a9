// The error of a table of scattering, measured: its texels, and the lookups that a runtime makes.
#pragma once

#include <functional>
#include <vector>

#include "bakers/assets/bruneton/held_voxels.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_reference.h"
#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// The channels of a texel as they are exactly, of directions that there are.
using ExactTexel =
    std::function<Texel(const ScatteringView& view, double sun_cos_zenith, double nu)>;

// Both must outlive it.
ExactTexel exact_texel(const ScatteringContent& content, const ScatteringReference& reference);

// Of each channel of a table: what its errors are shares of where there is next to no light.
std::vector<double> largest_values(const HeldVoxels& table);

// How many points a certificate takes.
int scattering_points(Certification certification);

// At points spread evenly over x_mu_s, x_mu of both halves and x_r, and over the nu that there are.
// Texels are those next to the points whose own nu there is.
Certificate measure_scattering(const HeldVoxels& table, const ScatteringMapping& mapping,
                               const ExactTexel& exact, const std::vector<double>& largest,
                               config::PixelType type, int points, const BakeOptions& options);

}  // namespace skybake
