// Pictures of cloud volumes and of occupancy grids.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/plot/drawing.h"
#include "bakers/render/cloud_framing.h"
#include "bakers/render/cloud_medium.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/sky_tables.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/sections/atmosphere.h"
#include "config/sections/cloud.h"

namespace skybake {

// Below it a sample's grain is as large as what there is to see, and four samples are soon marched.
inline constexpr int kSmallPixels = 640 * 400;

// Any pointer but `cloud` may be null.
struct CloudPreviewInput {
    const config::Cloud* cloud = nullptr;                  // that the volume is of
    const config::CloudVolumeBake* volume_bake = nullptr;  // what made it
    const PreviewAsset* volume = nullptr;
    const PreviewAsset* occupancy = nullptr;  // of that volume
    const config::OccupancyBake* occupancy_bake = nullptr;
    // The recipe's atmosphere with its two tables; without all three those of preset "earth".
    const config::Atmosphere* atmosphere = nullptr;
    const PreviewAsset* transmittance = nullptr;
    const PreviewAsset* multiple_scattering = nullptr;
    std::vector<SunDirection> suns = {
        {20, 105}};                        // a lit picture for each; the view's azimuth is 63
    std::optional<double> exposure_stops;  // the exposure is 2 to this; none: chosen
    CameraRequest camera;
    bool single = false;  // one tile alone, not the layer that it repeats to
    int width = 960;      // of lit pictures
    int height = 540;
    bool draft = false;  // half that size, steps twice as long, the most telling pictures alone
    Progress* progress = nullptr;  // is told of lit pictures
};

// Of a volume: the lit picture for each sun, the column's optical depth from above, and slices,
// with the cells of the occupancy grid over them if there is one. Of a grid alone: its slices.
// Slices go through where there is most to see. No lit pictures where make_sky_tables
// (sky_tables.h) refuses the tables. Fewer pictures: the user has interrupted.
// Lit pictures of at most kSmallPixels have four samples per pixel.
//
// The march leaps by the grid where that is sure to lose nothing: the exact rule for this volume's
// first channel, at this size, and a filter as wide as the march's trilinear one. Else by cells
// made from the volume.
std::vector<PreviewPicture> cloud_pictures(const CloudPreviewInput& input, int threads);

// --- Slices and columns ------------------------------------------------------------------------

// Extinction integrated over each column, row 0 at y = 0.
Image2<float> column_optical_depth(const CloudMedium& medium, int threads);

// Where there is most to see: x and y of the column of the greatest optical depth, and the height
// at which most voxels are something (the middle of an empty volume).
std::array<int, 3> slice_voxel(const CloudMedium& medium, const Image2<float>& optical_depth);

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
