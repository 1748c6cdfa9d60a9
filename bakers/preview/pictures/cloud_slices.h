// Slices and columns of cloud volumes and occupancy grids as pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/cloud_medium.h"
#include "bakers/render/preview_asset.h"
#include "config/assets/occupancy.h"
#include "config/sections/cloud.h"

namespace skybake {

// Extinction integrated over each column, row 0 at y = 0.
Image2<float> column_optical_depth(const CloudMedium& medium, int threads);

// Where there is most to see: x and y of the column of the greatest optical depth, and the height
// at which most voxels are something (the middle of an empty volume).
std::array<int, 3> telling_voxel(const CloudMedium& medium, const Image2<float>& optical_depth);

PreviewPicture optical_depth_picture(const CloudMedium& medium, const std::string& name,
                                     const Image2<float>& optical_depth);

// The plane of the volume's first channel where axis (0 x, 1 y, 2 z) has the index `at`.
PreviewPicture slice_picture(const CloudMedium& medium, const PreviewAsset& volume, int axis,
                             int at);

// The same plane with the cells of a grid over it: occupied ones framed, empty ones the bluer the
// farther a ray may leap. `leaps` are in cells, one per cell of size `cell`.
PreviewPicture cells_picture(const CloudMedium& medium, const PreviewAsset& volume,
                             const std::string& grid_name, int cell,
                             const std::vector<float>& leaps, int axis, int at);

// Each channel of a grid (of a draft the first), in a plane from the side and one from above, where
// the sum of the first channel is greatest (of leaps, least). `bake`, which may be null, says what
// channels hold; axes are in cells where the cloud is not known.
std::vector<PreviewPicture> grid_pictures(const PreviewAsset& grid,
                                          const config::OccupancyBake* bake,
                                          const config::Cloud* cloud, bool draft);

}  // namespace skybake
