// Pictures of single assets, the words that their captions share, and slices of volumes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plot/drawing.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/tone_curve.h"

namespace skybake {

// Returns the pictures for the asset's kind. A volume of a kind without its own pictures is shown
// by slices; a table of such a kind has no pictures.
std::vector<PreviewPicture> asset_pictures(const PreviewAsset& asset);

// --- Kinds of assets ---------------------------------------------------------------------------

// Shows tables of transmittance and multiple scattering: lookups over zenith angle and altitude,
// tone-mapped and in false colours for each channel; profiles along the ground and along altitude;
// and the texels as they are in the file. If this release cannot read a table's parameters, only
// the texels are shown.
std::vector<PreviewPicture> table_pictures(const PreviewAsset& asset);

// Shows a sky view: the texels of each sun over azimuth and angle above the horizon, tone-mapped
// with an exposure of their own. Returns nothing if the asset is not a sky view or does not say how
// many suns it has.
std::vector<PreviewPicture> sky_view_pictures(const PreviewAsset& asset);

// Shows an irradiance: its texels, tone-mapped.
std::vector<PreviewPicture> irradiance_pictures(const PreviewAsset& asset);

// Shows an environment: the file upright, tone-mapped.
std::vector<PreviewPicture> environment_pictures(const PreviewAsset& asset);

// Shows an aerial perspective: slices at several distances. Light is tone-mapped with one exposure,
// transmittance is shown as grey or colour.
std::vector<PreviewPicture> aerial_pictures(const PreviewAsset& asset);

// Shows phase functions and inverse cumulative distributions: curves of the texels as the file
// holds them, one line per channel. A phase function is shown over the scattering angle, and over
// the angle's logarithm for the forward peak; an inverse distribution is shown as the angle over
// the share.
std::vector<PreviewPicture> phase_pictures(const PreviewAsset& asset);

// Shows a table of forward scattering: the factor over the scattering angle at several optical depths.
std::vector<PreviewPicture> forward_pictures(const PreviewAsset& asset);

// Shows Bruneton's tables: the texels in colour, with v upwards. Tables of scattering are shown at
// four altitudes, with their channel A, which holds the Mie layers, beside the colours.
std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset);

// Shows noise volumes: three slices through the middle, two by two tiles that would show a seam, a
// histogram and a spectrum, each with all channels. Returns nothing if the asset is not a volume or
// does not have as many voxels as its size says.
std::vector<PreviewPicture> noise_pictures(const PreviewAsset& asset);

// Shows a weather map: its channels, two by two tiles, and their histograms.
std::vector<PreviewPicture> weather_map_pictures(const PreviewAsset& asset);

// Shows blue noise: a frame, a row of pixels over time and the pixels of the lowest ranks; the
// spectrum of frames as a picture; and the spectra of frames and over time as curves.
std::vector<PreviewPicture> blue_noise_pictures(const PreviewAsset& asset);

// Shows a flipbook: some frames side by side, all frames as one picture that plays, and how much changes
// from each frame to the next.
std::vector<PreviewPicture> flipbook_pictures(const PreviewAsset& asset);

// Shows distances to cloud: slices in metres through the middle, across y and z, and across y of each
// further channel.
std::vector<PreviewPicture> distance_pictures(const PreviewAsset& asset);

// --- Captions ----------------------------------------------------------------------------------
//
// The wording of suns and exposures in captions and file names, the same for all pictures.

// Returns "exposure 5.13 (+2.4 stops)": radiance was multiplied by 5.13, which --exposure 2.4 asks
// for.
std::string exposure_text(double exposure);

// Returns the same with the tone curve (tone_curve.h).
std::string tone_text(double exposure, ToneCurve curve = ToneCurve::film);

// Returns "sun 20 degrees above the horizon", "sun 4 degrees below the horizon" or "sun on the
// horizon".
std::string sun_text(double elevation_degrees);

// Returns a text for file names: "sun_20", "sun_minus_4", "sun_0_5".
std::string sun_stem(double elevation_degrees);

// The voxels of a volume in memory: x fastest, then y, then z, channels interleaved.
struct VoxelView {
    std::array<int, 3> size{};
    int channels = 0;
    const std::vector<float>* voxels = nullptr;
};

// Returns the voxels of an asset with three axes.
VoxelView view_of(const PreviewAsset& asset);

// Whether the asset has three axes, and as many voxels as its size says.
bool has_all_texels(const PreviewAsset& asset);

// Returns channels first ... first + count - 1 of plane z, with the rows as they are in the volume.
Image2<float> slice_of(const PreviewAsset& asset, int z, int first, int count);

// Returns rows of an image upside down, as views have row 0 at the top and texels at the bottom.
Image2<float> upwards(const Image2<float>& image, int first_row, int rows);

// Returns one channel of an image.
Image2<float> channel_of(const Image2<float>& image, std::size_t channel);

// Returns one channel of the plane where `axis` (0 x, 1 y, 2 z) has the index `at`. For x, the
// image has y across and z up; for y, x across and z up; for z, x across and y up. Row 0 is the
// lowest index.
Image2<float> slice(const VoxelView& volume, int channel, int axis, int at);

// The values that are shown as black and white.
struct GreyScale {
    double black = 0;
    double white = 1;
};

// Draws a field in grey, with sRGB numbers in proportion to the values and row 0 at the bottom. Its
// longer edge has at least `smallest_edge` and at most `longest_edge` pixels.
Picture grey(const Image2<float>& field, const GreyScale& scale = {}, int smallest_edge = 256,
             int longest_edge = 512);

// Says in a sentence which values are black and white.
std::string scale_words(const GreyScale& scale);

// Returns a picture of an asset, with whose name its own name and its title begin.
PreviewPicture picture_of(const ManifestAsset& entry, const std::string& stem,
                          const std::string& title, std::string caption, Picture picture);

// Returns the colour of a channel's curves: red, green, blue or dark.
std::array<std::uint8_t, 3> noise_line_colour(const std::string& channel);

// Returns two by two copies of a tile, as a repeating sampler shows them.
Image2<float> tiled_twice(const Image2<float>& tile);

}  // namespace skybake
