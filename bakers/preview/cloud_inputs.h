// Gathers what pictures of clouds are made from.
//
// Sequences of cloud volumes: the lit pictures of their frames are one picture that plays.
//
// Leaps (empty-space skip distances) for a march, from a baked occupancy grid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/march/cloud_medium.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/page.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/render/sky_tables.h"
#include "config/assets/occupancy.h"

namespace skybake {

// Gathers the lit pictures of the frames of all sequences, which come in their order.
class SequenceScenes {
  public:
    // Has a frame shown with the exposures of its sequence's first one.
    void share_exposures(CloudPreviewInput& input) const;

    // Takes the lit pictures of a frame out of `pictures`.
    void take(const SequenceFrame& frame, std::vector<PagePicture>& pictures);

    // Returns a scene for each sequence.
    std::vector<PageScene> scenes() &&;

  private:
    struct Sequence {
        std::string name;
        PageScene scene;
        std::vector<double> exposures;  // of each sun
    };
    std::vector<Sequence> sequences_;
};

// Gathers the input for the pictures of a cloud from the assets of a preview. For a cloud volume,
// it includes the volume's first occupancy grid and the sky; for an occupancy grid, it is the grid
// alone. `cloud` is null if the recipe is not known or does not say which cloud the asset shows.
CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options);

// Gathers the layers of the pictures of one sky: of each cloud, the volume with the most voxels.
std::vector<CloudPreviewInput> scene_input(const PreviewAssets& assets,
                                           const PreviewOptions& options);

// Returns leaps in cells, one per cell of the grid, from the first of the channels `leap`,
// `occupied` and `maximum` that the grid has. Returns nothing if it has no such channel, or if it
// does not have one value per cell and channel.
std::optional<std::vector<float>> leaps_of_grid(const PreviewAsset& grid, const OccupancyBake& bake,
                                                float threshold);

// Returns leaps for a march through `volume`, if they are certain to lose nothing
// (cloud_pictures.h).
std::optional<LeapGrid> leap_grid_of(const PreviewAsset& volume, const PreviewAsset& grid,
                                     const OccupancyBake& bake, float threshold);

}  // namespace skybake
