// Makes the page that shows assets: chooses and draws all pictures.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/math/intermediates.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/page.h"
#include "bakers/preview/picture_light.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/preview/preview_files.h"
#include "bakers/render/cloud_framing.h"
#include "bakers/render/stage_progress.h"
#include "bakers/render/sun_disc.h"
#include "bakers/render/sun_position.h"
#include "bakers/render/tone_curve.h"
#include "config/diagnostics/diagnostic.h"
#include "config/text/moment.h"

namespace skybake {

// The pictures of light that a preview will have.
struct LitPictures {
    bool sky = false;     // of a transmittance and a multiple_scattering table
    bool clouds = false;  // of a cloud volume
    bool sweep =
        false;  // a contact sheet, whose pictures show clouds if there are any, else the sky
};

struct PreviewOptions {
    std::vector<double> sun_elevations_deg;  // of skies and lit clouds; empty: a chosen few
    std::optional<double> exposure_stops;    // 0: an exposure of 1; none: chosen for each picture
    std::optional<ToneCurve> tone_curve;     // of skies and lit clouds; none: film
    std::optional<Glare> glare;              // of the sun in skies; none: no glare
    std::optional<double> altitude_m;        // of the camera that looks at the sky
    std::optional<double> sun_azimuth_deg;   // of lit clouds, from +x towards +y; none:
                                             // kSunBesideView from the heading
    std::optional<config::Moment> at;        // places the sun, together with `place`
    std::optional<EarthPlace> place;
    std::optional<CameraRequest> camera;             // of lit clouds
    std::optional<std::array<int, 2>> picture_size;  // width, height of lit clouds
    bool single = false;     // shows one tile of a cloud alone, completely in the picture
    bool table_sky = false;  // clouds are lit as by a runtime with tables
    int turntable = 0;       // pictures of one tile from all around; 0: none
    std::string note = {};   // for the page, on the light; empty: none
    bool draft = false;      // few pictures, small and fast
    bool live = false;       // a page that renders the assets (live/live_scene.h)
    int threads = 0;         // 0: as many as the machine has
    StageProgress* progress = nullptr;
    int stages_before = 0;          // stages already reported, of the same preview
    PictureMemo* memory = nullptr;  // of earlier previews with the same options
    // Is called with the page as soon as it has the pictures of lit clouds, if there are any, and no
    // others; with a live page, before its still pictures are made. Null: not called.
    std::function<void(const PreviewPage&)> early_page = nullptr;
    Intermediates* intermediates = nullptr;  // of the assets' bake; null: none
    // The light of clouds, of earlier previews; null: made for this one.
    std::shared_ptr<PictureLight> light = nullptr;
};

// Returns whether the preview has pictures of all clouds in one sky: it has a sky and a cloud volume,
// and options do not ask for a single tile.
bool has_scene(const LitPictures& lit, const PreviewOptions& options);

// Returns the number of stages for the pictures of such assets: one for each asset, one for the sky,
// and one for all clouds in it.
int picture_stages(std::size_t assets, const LitPictures& lit, const PreviewOptions& options);

// Returns what pictures of a recipe's assets are made from besides the assets.
std::vector<Need> needs_of_pictures(const Recipe& recipe);

// Makes all pictures of the assets. Clouds without an atmosphere of their own are lit by the sky of
// the preset "earth". What `options` leave open is taken from the recipe's [preview]
// (check_options.h). Diagnostics are those of unused_options and camera_above_air
// (check_options.h), of completed() and of png_bytes. If the user interrupts, there is neither a value nor a
// diagnostic.
Outcome<PreviewPage> make_preview(const PreviewAssets& assets, const PreviewOptions& options);

}  // namespace skybake
