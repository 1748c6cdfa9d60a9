// The sky of a recipe as pictures: from its tables as a runtime shows it, as solved, and what lies
// between (sky_reference.h).
#pragma once

#include <optional>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/plot/drawing.h"
#include "bakers/render/sky_tables.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct SkyPreviewOptions {
    std::vector<double> sun_elevations_degrees = {60, 10, 0, -4};
    // The exposure is 2 to this; none: chosen for each picture (tone_curve.h).
    std::optional<double> exposure_stops;
    // In a shell that is thinner: at its top.
    double camera_altitude_km = 0.2;
    int dome_pixels = 512;
    int solved_pixels = 128;     // of the dome of the solved sky; 0: none, and no difference
    int panorama_pixels = 1080;  // its width; 0: none
    Progress* progress = nullptr;
};

// Small pictures and no solved sky: a tenth of a second for all.
SkyPreviewOptions draft_sky_preview();

// One picture with the panoramas of all elevations; then for each elevation one with the dome from
// the tables and, where it is asked for, that of the solved sky and the relative difference.
// Captions state what was chosen. `transmittance` and `multiple_scattering` are of this
// atmosphere. No pictures where make_sky_tables (sky_tables.h) refuses them.
std::vector<PreviewPicture> sky_pictures(const config::Atmosphere& atmosphere,
                                         const PreviewAsset& transmittance,
                                         const PreviewAsset& multiple_scattering,
                                         const SkyPreviewOptions& options, int threads);

}  // namespace skybake
