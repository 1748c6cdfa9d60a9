// The two tables of an atmosphere, as a runtime has them: textures with a clamped, bilinear
// sampler.
#pragma once

#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/render/screen_color.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A baked asset in memory, for a preview. It holds what the file holds, not what the baker
// calculated.
struct PreviewAsset {
    ManifestAsset entry;
    Image2<float> table;  // of a table; row 0 is v = 0
    std::vector<float>
        voxels;  // level 0 of a volume: x fastest, then y, then z; channels interleaved
};

// A texture and the mapping of coordinates x in [0, 1] to it: texel position = x * scale + offset,
// counted from the first texel's centre. This is u * size - 1/2 for either convention
// (bakers/field/image.h).
struct LookupTable {
    int width = 0;
    int height = 0;
    int channels = 0;
    // Channels are interleaved, and those of a moment stand together. The last column and the last
    // row are repeated, so that a lookup always has a right and an upper neighbour.
    int texels_per_row = 0;
    std::vector<float> texels;
    float scale_x = 0, offset_x = 0;
    float scale_y = 0, offset_y = 0;
};

// The largest degree of a table's moments.
inline constexpr int kMostMomentDegree = 8;

struct SkyTables {
    LookupTable transmittance;           // x_mu, x_r of bakers/air/transmittance_mapping.h
    bool holds_optical_depth = false;    // transmittance is exp(-value)
    LookupTable multiple_scattering;     // sun's coordinate, altitude / thickness
    int degree = 0;                      // of its moments; 0: it holds the mean radiance alone
    bool twilight = false;               // the mapping of the sun's coordinate is "twilight"
    std::vector<double> wavelengths_nm;  // of each channel, where the file states them
    ScreenColor screen;                  // how the light of the channels is shown
};

// Makes the tables from two assets of the same atmosphere; without the second no light is scattered
// again. The manifest tells what an asset's mapping and parameters are. E0304 if an asset is of another
// kind, its mapping is unknown, its parameters are no recipe, or the numbers of channels differ.
Outcome<SkyTables> make_sky_tables(const PreviewAsset& transmittance,
                                   const PreviewAsset* multiple_scattering);

// Returns the transmittance from an altitude towards the sun at r mu_s = `sun_s_km`, one value per
// channel; 0 if the planet hides the sun.
Spectrum look_up_sunlight(const SkyTables& tables, const Shell& shell, double altitude_km,
                          double sun_s_km);

}  // namespace skybake
