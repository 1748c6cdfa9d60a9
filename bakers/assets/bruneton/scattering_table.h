// A table of scattering in memory, and the lookup that a runtime makes of it.
//
// Texels whose nu no view and sun have (nu outside mu mu_s -+ sin sin_s) still count in lookups
// next to the edge of those that have one: there they hold the smooth continuation of the light in
// nu, up to kMostBeyond past the edge; texels farther away hold what is there.
#pragma once

#include <vector>

#include "bakers/assets/bruneton/held_voxels.h"
#include "bakers/assets/bruneton/parts_memory.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

// One step of nu in a table of 8: no lookup in it goes farther. Polynomials of the 8th degree, as
// which higher orders are continued, grow by no more than half over it.
inline constexpr double kMostBeyond = 2.0 / 7;

// The cosine to the sun that a texel is made for.
double continued_nu(const ScatteringView& view, const Shell& shell, double sun_cos_zenith,
                    double nu);

// All texels' parts of a view ray, in the order of u.
std::vector<ScatteringParts> parts_of_row(const ScatteringRows& rows,
                                          const ScatteringContent& content,
                                          const ScatteringMapping& mapping,
                                          const ScatteringView& view);

// The texels of a content's table, as they are exactly. Of either kind of parts there may be none.
HeldVoxels scattering_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                             const TableParts& parts);

// Linear in each of the four coordinates between texels of one half. `channels` of them.
Texel look_up(const HeldVoxels& table, const ScatteringMapping& mapping,
              const ScatteringCoordinates& x, config::PixelType type);

}  // namespace skybake
