// Marches a row of rays through the air, as sky_view.h describes.
#pragma once

#include <array>
#include <vector>

#include "bakers/math/vectors.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// A density that is linear between two altitudes. The piece includes its bottom but not its top.
struct MarchPiece {
    float bottom_km = 0;
    float top_km = 0;
    float density_at_bottom = 0;
    float density_per_km = 0;
};

// A layer of the atmosphere, in floats.
struct MarchLayer {
    float scale_height_km = 0;  // 0: `pieces` give the density
    std::vector<MarchPiece> pieces;
    std::array<float, kMaxChannels> scattering_per_km{};
    std::array<float, kMaxChannels> extinction_per_km{};
    bool scatters = false;
};

// The values that all rays of a picture share.
struct SkyMarch {
    int channels = 0;
    float ground_radius_km = 0;
    float thickness_km = 0;
    float top_horizon_km = 0;  // distance from the top to the horizon, H of transmittance_mapping.h
    float camera_altitude_km = 0;
    float sun_s_km = 0;  // r mu_s at the camera
    std::array<float, kMaxChannels> ground_albedo{};
    std::vector<MarchLayer> layers;
    const SkyTables* tables = nullptr;
    int steps = 0;
};

// The rays of a row. `count` is a multiple of kMarchPadding.
inline constexpr int kMarchPadding = 16;
struct MarchRays {
    std::vector<float> mu;
    std::vector<float> cosine_to_sun;
    // The phase function of each layer in each channel, for the angle between ray and sun: that of ray
    // i stands at (layer * channels + channel) * count + i.
    std::vector<float> phases;
    int count = 0;
};

// Writes channel c of ray i to radiance[c * rays.count + i]. The bits are the same for any vector
// width.
void march_rays(const SkyMarch& sky, const MarchRays& rays, float* radiance);

// Does the same without vectors. It is the specification of march_rays.
void march_rays_scalar(const SkyMarch& sky, const MarchRays& rays, float* radiance);

}  // namespace skybake
