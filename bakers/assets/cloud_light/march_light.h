// Solves for the light within a layer that pictures march (march/light_in_cloud.h).
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/description/estimate.h"
#include "bakers/march/cloud_medium.h"
#include "bakers/march/layer_march.h"
#include "bakers/march/light_in_cloud.h"
#include "bakers/math/bake_options.h"

namespace skybake::cloud_light {

// Rays to a sun that is nearer to the horizon cross so many tiles of a layer that repeats that its light is that of
// this elevation, in the ratio of the sines, as is the sunlight through the layer's face. A tile that stands alone is
// solved for under each sun.
inline constexpr double kLowestSolvedSun_deg = 1;

// The most cells for which light is solved: those of pictures, and of drafts.
inline constexpr double kCellsOfPicture = 5 << 18;
inline constexpr double kCellsOfDraft = 1 << 14;

// What the light of a layer of so many voxels takes, for pictures under one sun.
Estimate march_light_estimate(double voxels);

// The light of a layer under any sun; what does not depend on the sun is solved for once.
class MarchLight {
  public:
    // Cells are boxes of at most 2, 3, 4 ... voxels along each edge, the smallest of which there are at most
    // `most_cells`. A tile that does not repeat has an empty margin of half of its edge on each side.
    MarchLight(const CloudMedium& medium, double most_cells, const BakeOptions& options);

    // Sunlight comes from below where the sun is below the horizon of a layer that is above it. Returns nothing
    // after an interruption.
    std::optional<LightInCloud> under(const SunDirection& sun, const BakeOptions& options) const;

  private:
    std::unique_ptr<const CloudLayer> layer_;  // to which the solver refers
    std::unique_ptr<const RadianceSolver> solver_;
    std::array<int, 3> margin_{};  // in places; 0 where the tile repeats
    PlaceGrid places_;
    LightInCloud without_sun_;
};

}  // namespace skybake::cloud_light
