// This header declares the asset "optical_depth": tables for up to four kinds of particles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class OpticalDepthTable { to_top, between, density, phase };
enum class BetweenCoordinates { altitudes, distance };
enum class DepthSampling { exact, equal_attenuation, uniform };

// The table holds column densities, densities or phase functions of up to four kinds of particles,
// one kind per channel, after Ai et al. 2014.
struct OpticalDepthBake : LightFiles {
    OpticalDepthTable table = OpticalDepthTable::to_top;
    std::array<int, 3> size{};       // to_top: angle, altitude, 1; between: three; else n, 1, 1
    std::vector<std::string> kinds;  // layers of the atmosphere
    BetweenCoordinates coordinates = BetweenCoordinates::altitudes;
    DepthSampling sampling = DepthSampling::exact;
    int shells = 0;       // equal_attenuation, uniform
    Length max_altitude;  // equal_attenuation, uniform: the air above it is left out
};

}  // namespace skybake::config
