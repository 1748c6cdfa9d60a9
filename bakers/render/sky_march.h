// Marches a row of rays through the air, as sky_view.h describes.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/math/vectors.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// A layer of the atmosphere.
struct MarchLayer {
    float scale_height_km = 0;        // 0: `pieces` give the density
    std::vector<LinearPiece> pieces;  // each includes its bottom but not its top
    // Times the phase function's Legendre moment of degree 0, 1, and so on.
    std::vector<std::array<float, kMaxChannels>> scattering_per_km;
    std::array<float, kMaxChannels> extinction_per_km{};
    bool scatters = false;
};

// The values that all rays share.
struct SkyMarch {
    int channels = 0;
    int degree = 0;  // of the moments in the table of light that is scattered again
    float ground_radius_km = 0;
    float thickness_km = 0;
    float top_horizon_km = 0;  // distance from the top to the horizon, H of transmittance_mapping.h
    std::array<float, kMaxChannels> ground_albedo{};
    std::vector<MarchLayer> layers;
    const SkyTables* tables = nullptr;
    int steps = 0;
};

// The rays that are marched together. `count` is a multiple of kMarchPadding.
inline constexpr int kMarchPadding = 16;
struct MarchRays {
    std::vector<float> altitude_km;  // where they begin, as are the next two
    std::vector<float> s_km;         // r mu
    std::vector<float> sun_s_km;     // r mu_s
    std::vector<float> cosine_to_sun;
    std::vector<float> reach_km;  // the march ends there, if the air does not before
    // The phase function of each layer in each channel, for the angle between ray and sun: that of ray
    // i stands at (layer * channels + channel) * count + i.
    std::vector<float> phases;
    int count = 0;
};

// Writes channel c of ray i to radiance[c * rays.count + i]. The bits are the same for any vector
// width.
void march_rays(const SkyMarch& sky, const MarchRays& rays, float* radiance);

}  // namespace skybake
