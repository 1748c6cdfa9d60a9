// Pictures of a recipe's sky: rendered from its tables as a runtime does, as solved, and the
// difference between the two (sky_reference.h).
#pragma once

#include <optional>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "bakers/plot/drawing.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/sun_disc.h"
#include "bakers/render/tone_curve.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct SkyPreviewOptions {
    std::vector<double> sun_elevations_degrees = {60, 10, 0, -4};
    // The exposure is 2 to this power; none: it is chosen for each picture (tone_curve.h).
    std::optional<double> exposure_stops;
    ToneCurve tone_curve = ToneCurve::film;
    Glare glare = Glare::none;
    // If the shell is thinner than this, the camera is at its top.
    double camera_altitude_km = 0.2;
    int dome_pixels = 512;
    int solved_pixels = 128;     // of the solved dome; 0: no solved sky and no difference
    int panorama_pixels = 1080;  // width of the panorama; 0: none
    Progress* progress = nullptr;
    Intermediates* intermediates = nullptr;  // have the solved light, if somebody made it
};

// Returns the solved light with which the pictures compare the tables.
std::vector<Need> needs_of_sky_pictures(const config::Atmosphere& atmosphere);

// Returns the options of a draft: small pictures and no solved sky, which takes a tenth of a second
// for all.
SkyPreviewOptions draft_sky_preview();

// Makes one picture with the panoramas for all elevations of the sun, then one picture for each
// elevation: the dome from the tables and, if asked for, the dome of the solved sky and the
// relative difference. Captions state what was chosen. `transmittance` and `multiple_scattering`
// must be of this atmosphere. There are no pictures if make_sky_tables (sky_tables.h) refuses the
// tables.
std::vector<PreviewPicture> sky_pictures(const config::Atmosphere& atmosphere,
                                         const PreviewAsset& transmittance,
                                         const PreviewAsset& multiple_scattering,
                                         const SkyPreviewOptions& options, int threads);

}  // namespace skybake
