// Pictures of the tables and volumes that hold the sky as cameras see it.
#pragma once

#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/render/preview_asset.h"

namespace skybake {

// Of a sky view: the texels of each sun, tone-mapped with an exposure of its own, over azimuth and
// angle above the horizon. None where the asset is none, or does not say how many suns it has.
std::vector<PreviewPicture> sky_view_pictures(const PreviewAsset& asset);

// Of an irradiance: its texels, tone-mapped.
std::vector<PreviewPicture> irradiance_pictures(const PreviewAsset& asset);

// Of an environment: the file upright, tone-mapped.
std::vector<PreviewPicture> environment_pictures(const PreviewAsset& asset);

// Of an aerial perspective: slices at several distances, light tone-mapped with one exposure and
// transmittance as grey or colour.
std::vector<PreviewPicture> aerial_pictures(const PreviewAsset& asset);

}  // namespace skybake
