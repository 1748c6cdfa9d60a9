// From assets to the page that shows them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/page.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/preview_files.h"
#include "bakers/render/cloud_framing.h"
#include "bakers/render/stage_progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Which pictures of light there will be.
struct LitPictures {
    bool sky = false;     // of a transmittance and a multiple_scattering table
    bool clouds = false;  // of a cloud volume
    bool sweep =
        false;  // a contact sheet, whose pictures show clouds if there are any, else the sky
};

struct PreviewOptions {
    std::vector<double> sun_elevations_deg;  // of skies and lit clouds; empty: a few telling ones
    std::optional<double> exposure_stops;    // 0: an exposure of 1; none: chosen for each picture
    std::optional<double> altitude_m;        // of the camera that looks at the sky
    std::optional<double> sun_azimuth_deg;   // of lit clouds, from +x towards +y
    std::optional<CameraRequest> camera;     // of lit clouds
    std::optional<std::array<int, 2>> picture_size;  // width, height of lit clouds
    bool single = false;  // one tile of a cloud stands alone, and all of it is in the picture
    bool draft = false;   // few pictures, small and quick
    int threads = 0;      // 0: as many as the machine has
    StageProgress* progress = nullptr;
    int stages_before = 0;          // that progress was told of, of the same preview
    PictureMemo* memory = nullptr;  // of previews with the same options
};

// Stages of the pictures of such assets: one for each, and one for the sky.
int picture_stages(std::size_t assets, const LitPictures& lit);

// All pictures of the assets. Clouds without an atmosphere of their own are lit by the sky of
// preset "earth". Diagnostics of unused_options, of camera_above_air (check_options.h) and of
// png_bytes. No value and no diagnostics: the user has interrupted.
config::Outcome<PreviewPage> make_preview(const PreviewAssets& assets,
                                          const PreviewOptions& options);

// What the pictures of a cloud take, gathered from the assets of a preview.

// Of a cloud volume: with the first occupancy grid of it, and the sky. Of an occupancy grid: by
// itself. `cloud` is null where the recipe is not known or does not say what the asset is of.
CloudPreviewInput cloud_input(const PreviewAssets& assets, const PreviewAsset& asset,
                              const PreviewOptions& options);

}  // namespace skybake
