// Which pictures show an asset by itself, and the words that their captions have in common.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plot/drawing.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// By the asset's kind; of a volume that has no row of its own, its slices, and of such a table
// nothing.
std::vector<PreviewPicture> asset_pictures(const PreviewAsset& asset);

// --- Kinds of assets ---------------------------------------------------------------------------

// Of tables of transmittance and multiple scattering: what lookups of the table return over zenith
// angle and altitude, tone-mapped and in false colours for each channel; profiles along the ground
// and along altitude; and the texels as they lie in the file. Of a table whose parameters this
// release cannot read, the texels alone.
std::vector<PreviewPicture> table_pictures(const PreviewAsset& asset);

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

// Of phase functions and of their inverse cumulative distributions: curves of the texels as the
// file holds them, one line for each channel: over the scattering angle, and over the angle's
// logarithm for the forward peak; of an inverse distribution, the angle over the share.
std::vector<PreviewPicture> phase_pictures(const PreviewAsset& asset);

// Of Bruneton's tables: the texels in colour, v upwards: of tables of scattering at four altitudes,
// and of A, where the Mie layers are, beside them.
std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset);

// Of noise volumes: three slices through the middle, two by two tiles that would show a seam,
// histogram and spectrum, each with all channels. Nothing of an asset that is no volume, or whose
// voxels are not as many as its size says.
std::vector<PreviewPicture> noise_pictures(const PreviewAsset& asset);

// --- Captions ----------------------------------------------------------------------------------
//
// What captions and file names say of suns and exposures, in one way for all pictures.

// "exposure 5.13 (+2.4 stops)": radiance was multiplied by 5.13, which --exposure 2.4 asks for.
std::string exposure_text(double exposure);

// The same with the tone curve (tone_curve.h).
std::string tone_text(double exposure);

// "sun 20 degrees above the horizon", "sun 4 degrees below the horizon", "sun on the horizon".
std::string sun_text(double elevation_degrees);

// For file names: "sun_20", "sun_minus_4", "sun_0_5".
std::string sun_stem(double elevation_degrees);

// Planes of a volume in memory.

// A volume's voxels: x fastest, then y, then z, channels interleaved.
struct VoxelView {
    std::array<int, 3> size{};
    int channels = 0;
    const std::vector<float>* voxels = nullptr;
};

// One channel of the plane where `axis` (0 x, 1 y, 2 z) has the index `at`. Of x the picture is y
// across and z up, of y it is x across and z up, of z it is x across and y up; row 0 is the lowest
// index.
Image2<float> slice(const VoxelView& volume, int channel, int axis, int at);

// Two by two copies side by side, as a repeating sampler shows them.
Image2<float> tiled_twice(const Image2<float>& tile);

}  // namespace skybake
