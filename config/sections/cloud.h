// Clouds: [clouds.NAME] and the tables within.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/noise.h"
#include "config/text/quantity.h"

namespace skybake::config {

// How full a cloud is by height h, 0 at its base and 1 at its top.
enum class HeightProfileType { thesis, cumulus, stratus, stratocumulus, blended, tabulated };

struct HeightProfile {
    HeightProfileType type = HeightProfileType::cumulus;
    double bottom_sharpness = 50;    // thesis: (1 - exp(-bottom_sharpness h)) exp(-top_falloff h)
    double top_falloff = 4;          // thesis
    double cloud_type = 1;           // blended: 0 stratus, 0.5 stratocumulus, 1 cumulus
    std::vector<HeightPoint> table;  // tabulated: linear between, its end values beyond
};

enum class MapWrap { repeat, clamp };
enum class MapFilter { nearest, linear };
enum class MapColorSpace { linear, srgb };

// A picture laid over a cloud's extent, x to the right and y downwards from its first row.
struct CloudMap {
    std::string file;            // as the recipe has it; empty: none
    std::filesystem::path path;  // where it is: `file` in the folder of the recipe that names it
    std::string channel;         // "R", "Y", "coverage"; empty: the first
    MapWrap wrap = MapWrap::repeat;
    MapFilter filter = MapFilter::linear;
    MapColorSpace color_space = MapColorSpace::linear;
    SourceRange file_place;     // of `file` in the recipe
    SourceRange channel_place;  // of `channel`; of `file` where the recipe names no channel
};

// A Gaussian of height `amplitude` over the ground plan, in tiles; its periodic images are summed.
struct Tower {
    std::array<double, 2> center{};  // x, y
    std::array<double, 2> sigma{};   // along its own axes
    Angle rotation;                  // of its axes against x, y, counterclockwise
    double correlation = 0;          // between its axes, in (-1, 1)
    double amplitude = 0;
    std::string name = {};  // what the recipe calls it: "0", "1" ... in a list
};

// Towers at random places: each value is uniform in its range, sigma in its logarithm.
struct TowerScatter {
    int count = 0;
    std::uint64_t seed = 0;
    std::array<double, 2> sigma{};      // of the smaller axis
    std::array<double, 2> aspect{};     // the greater axis over the smaller, from 1 on
    std::array<double, 2> amplitude{};  // rotations are uniform
};

enum class ThresholdAt { bake, runtime };
enum class CloudChannels { density, noise };

// One [clouds.NAME].
struct Cloud {
    std::string name;
    std::string noise;                        // NAME of the base's [noise.NAME]
    std::array<int, 3> noise_scale{1, 1, 1};  // multiplies its frequencies along x, y, z
    std::string detail;                       // NAME of the [noise.NAME] that erodes; empty: none
    std::array<int, 3> detail_scale{1, 1, 1};
    std::array<double, 2> erosion{};  // strength at the base and at the top
    double wisp_height = 0;           // up to here the erosion turns from wisps to billows
    std::array<Length, 3> extent;     // x, y, height
    Length base_altitude;
    HeightProfile height_profile;
    double coverage = 1;    // 1: as the noise and the profile have it, 0: none
    CloudMap coverage_map;  // multiplies coverage
    CloudMap type_map;      // in place of cloud_type
    double threshold = 0;
    double edge_softness = 0;
    ThresholdAt threshold_at = ThresholdAt::bake;
    std::optional<double> full_at;  // the value whose density is 1; threshold_at = bake
    CloudChannels channels = CloudChannels::density;
    InverseLength extinction_scale;  // extinction of density 1
    std::vector<Tower> towers;       // in the order of the recipe
    TowerScatter scatter;
};

// Which channels of its noises a cloud is made of, and what a cloud volume calls its own.

// Those of the noise that are computed: all of one that packs or of channels = "noise", else the
// first.
std::span<const NoiseChannel> used_channels(const Noise& noise, CloudChannels channels);

// {"Y"} of one channel, else the names of the noise's.
std::vector<std::string> cloud_channel_names(const Noise& noise, CloudChannels channels);

}  // namespace skybake::config
