// Pictures of cloud volumes and of occupancy grids: lit pictures, optical depths and slices.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/march/cloud_medium.h"
#include "bakers/plot/drawing.h"
#include "bakers/render/cloud_framing.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/tone_curve.h"
#include "config/recipe/recipe.h"

namespace skybake::config {
struct Cloud;
struct CloudVolumeBake;
struct OccupancyBake;
}  // namespace skybake::config

namespace skybake {

class PictureLight;

// Pictures of at most this many pixels get four samples in each pixel and not only in thin parts: in
// small pictures the grain of one sample is as large as the details, and four samples take little
// time.
inline constexpr int kSmallPixels = 640 * 400;

// Where the sun stands unless somebody says so, in degrees to the left of the view: beside it and a
// little behind, so that clouds show lit and shaded sides before a blue sky. A second picture is against the
// light, and shows their silver linings.
inline constexpr double kSunBesideView = 112;
inline constexpr double kSunAgainstView = 30;

// The place of a cloud volume in a sequence.
struct SequenceFrame {
    std::string sequence;   // its name
    int index = 0;          // of the frame, counted from 0
    int count = 0;          // of all frames that are shown
    double per_second = 0;  // frames that play
};

// The input for the pictures. All pointers except `cloud` may be null.
struct CloudPreviewInput {
    const Cloud* cloud = nullptr;                          // the cloud that the volume shows
    const config::CloudVolumeBake* volume_bake = nullptr;  // the section that made it
    const PreviewAsset* volume = nullptr;
    const PreviewAsset* occupancy = nullptr;  // of that volume
    const config::OccupancyBake* occupancy_bake = nullptr;
    // The recipe of the atmosphere, and its two tables. If one of the three is missing, those of the
    // preset "earth" are used.
    const Recipe* air = nullptr;
    const PreviewAsset* transmittance = nullptr;
    const PreviewAsset* multiple_scattering = nullptr;
    std::vector<SunDirection> suns = {{20, kHeading + kSunBesideView}};  // one lit picture for each
    bool last_is_against = false;          // the last sun is the first again, before the camera
    std::optional<double> exposure_stops;  // the exposure is 2 to this power; none: chosen
    std::vector<double> exposures;  // of each sun, as an earlier frame had them; empty: chosen
    ToneCurve tone_curve = ToneCurve::film;
    CameraRequest camera;
    std::optional<SequenceFrame>
        frame;               // of volumes whose lit pictures are parts of one that plays
    bool single = false;     // one tile alone, not the layer that it repeats to
    bool table_sky = false;  // the light is that of a runtime with tables
    int turntable = 0;  // pictures of that tile from all around, under each sun; 0: one picture
    int width = 960;    // of lit pictures
    int height = 540;
    std::shared_ptr<PictureLight> light;  // shared by pictures; null: made for these
    bool draft = false;                   // half that size, only the most important pictures
    Progress* progress = nullptr;         // reports lit pictures
};

// Makes the pictures. For a volume, they are a lit picture for each sun, or a turntable of pictures
// of one exposure, numbered from 000 on (those of frames are numbered by their frame), and the optical depth of
// columns seen from above, and slices, with the cells of the occupancy grid over them if there is
// one. For a grid alone, they are its slices. Slices go through the places with the most cloud.
// There are no lit pictures if make_sky_tables (sky_tables.h) refuses the tables, and fewer
// pictures if the user interrupts.
//
// The march uses the grid for leaps if that is certain to lose nothing: the grid was made by the
// exact rule for this volume's first channel, at this size, and for a filter as wide as the march's
// trilinear one. Otherwise it uses cells made from the volume.
std::vector<PreviewPicture> cloud_pictures(const CloudPreviewInput& input, int threads);

// --- Slices and columns ------------------------------------------------------------------------

// Returns the extinction integrated over each column, with row 0 at y = 0.
Image2<float> column_optical_depth(const CloudMedium& medium, int threads);

// Returns a voxel for slices: x and y of the column with the greatest optical depth, and the height
// at which the most voxels hold cloud (the middle of an empty volume).
std::array<int, 3> slice_voxel(const CloudMedium& medium, const Image2<float>& optical_depth);

PreviewPicture optical_depth_picture(const CloudMedium& medium, const std::string& name,
                                     const Image2<float>& optical_depth);

// Shows the plane of the volume's first channel where `axis` (0 x, 1 y, 2 z) has the index `at`.
PreviewPicture slice_picture(const CloudMedium& medium, const PreviewAsset& volume, int axis,
                             int at);

// Shows the same plane with the cells of a grid over it. Occupied cells are framed; an empty cell
// is the bluer the farther a ray may leap from it. `leaps` are in cells, one per cell of size
// `cell`.
PreviewPicture cells_picture(const CloudMedium& medium, const PreviewAsset& volume,
                             const std::string& grid_name, int cell,
                             const std::vector<float>& leaps, int axis, int at);

// Shows each channel of a grid (in a draft only the first), in a plane seen from the side and one
// seen from above, where the sum of the first channel is greatest (for leaps, least). `bake` says
// what the channels hold and may be null. If the cloud is not known, axes are in cells.
std::vector<PreviewPicture> grid_pictures(const PreviewAsset& grid,
                                          const config::OccupancyBake* bake, const Cloud* cloud,
                                          bool draft);

}  // namespace skybake
