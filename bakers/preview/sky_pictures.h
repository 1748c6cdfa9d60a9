// The sky of a recipe as pictures: from its tables as a runtime shows it, by direct integration,
// and what lies between.
#pragma once

#include <optional>
#include <vector>

#include "bakers/preview/picture.h"
#include "bakers/preview/preview_asset.h"
#include "config/parameters.h"

namespace skybake {

struct SkyPreviewOptions {
    std::vector<double> sun_elevations_degrees = {60, 10, 0, -4};
    // The exposure is 2 to this; none: chosen for each picture (tone_curve.h).
    std::optional<double> exposure_stops;
    // In a shell that is thinner: at its top.
    double camera_altitude_km = 0.2;
    int dome_pixels = 512;
    int direct_pixels = 128;     // of the dome by direct integration; 0: none, and no difference
    int panorama_pixels = 1080;  // its width; 0: none
};

// Small pictures and no direct integration: a tenth of a second for all.
SkyPreviewOptions draft_sky_preview();

// For each elevation one picture with the dome from the tables, and where it is asked for that by
// direct integration and the relative difference; then one picture with the panoramas of all
// elevations. Captions state what was chosen. `transmittance` and `multiple_scattering` are of this
// atmosphere. No pictures where make_sky_tables (sky_tables.h) refuses them.
std::vector<PreviewPicture> sky_pictures(const config::Atmosphere& atmosphere,
                                         const PreviewAsset& transmittance,
                                         const PreviewAsset& multiple_scattering,
                                         const SkyPreviewOptions& options, int threads);

}  // namespace skybake
