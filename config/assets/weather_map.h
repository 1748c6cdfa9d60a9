// This header declares the asset "weather_map": where clouds are, in a plane of noise.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class WeatherContent { amounts, directions };
enum class CoverEdge { linear, smooth };

// The vectors have an item for each channel of the noise.
struct WeatherMapBake : VolumeFrames {
    std::string noise;          // NAME of a [noise.NAME]
    std::array<int, 2> size{};  // texels along x and y
    WeatherContent content = WeatherContent::amounts;
    std::vector<double> covered;  // share of texels above 0
    std::vector<double> full;     // share of texels that are 1
    CoverEdge edge = CoverEdge::linear;
    std::vector<std::string> yields_to;  // the channel that is taken away first; empty: none
    std::vector<double> streaks;         // e-folding length in tiles; 0: none
    Angle wind;                          // where streaks lead to, from +x towards +y
};

}  // namespace skybake::config
