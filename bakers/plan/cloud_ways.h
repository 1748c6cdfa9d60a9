// The ways in which a runtime may draw a cloud: how finely its densities are stored and marched, how rays
// leap over empty cells, and where the sunlight within the cloud comes from.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bakers/plan/choose_way.h"

namespace skybake {

// Sunlight is scattered once or as in sun_scattering (march/cloud_light.h), which needs the optical depth
// to the sun: by a march of its own, from a texture for each sun, or from harmonics for any sun. Or it is
// solved: radiance for each sun.
enum class CloudLighting { march, depth, harmonics, radiance };

struct CloudWay : Way {
    std::string drawing;  // all but its cells, which change what it costs and not what it shows
    CloudLighting lighting = CloudLighting::march;
    bool single = false;      // light is scattered once
    int stride = 1;           // voxels between samples, along the voxels' shortest edge
    int cell = 0;             // of the occupancy grid, which is asset 1; 0: none
    int sun_samples = 0;      // of a march towards the sun
    int degree = 0;           // of radiance
    std::size_t first = 0;    // the first asset of light; of radiance the table of small angles
    std::size_t per_sun = 0;  // how many of the assets after it belong to each sun
};

// All ways have this in common.
struct CloudSubject {
    std::string cloud;          // NAME of the [clouds.NAME]
    std::array<int, 3> size{};  // the finest voxels
    std::string cover;          // that of the recipe's volume as TOML; or empty
    // Elevations as TOML, at azimuth 0, if they are the only suns. Light of a sun is compared for one to
    // kMostLitSuns of them.
    std::vector<std::string> suns;
};
inline constexpr std::size_t kMostLitSuns = 4;

std::vector<CloudWay> cloud_ways(const CloudSubject& subject);

// Returns the asset that paths of light go through: the finest voxels as floats.
Way traced_cloud(const CloudSubject& subject);

}  // namespace skybake
