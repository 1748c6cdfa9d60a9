// The air in which a cloud grows, by height: a mixed layer, a conditionally unstable one above its base, and
// an inversion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/convection/grid.h"

namespace skybake::convection {

// Heat is stored less this, in kelvin, so that floats keep its differences.
constexpr double kReference = 300;

// All that the growth of a cloud depends on.
struct Specification {
    Grid grid;
    int mixed_levels = 0;           // levels below the condensation level, the cloud's base
    int sponge_levels = 3;          // below the lid, in which what arrives is calmed
    double base_altitude_m = 1000;  // gives the pressure, by the standard atmosphere
    double base_temperature_k = 288;
    double instability_k_per_km = 1.5;     // by which the air cools faster than what rises in cloud
    double inversion_m = 1500;             // its height above the base
    double humidity = 0.7;                 // relative, above the base
    std::array<double, 2> wind_m_per_s{};  // up to the base
    std::array<double, 2> wind_top_m_per_s{};  // at the inversion
    int patches = 8;                           // of warm ground
    std::array<double, 2> patch_width_m = {400, 1200};
    double patch_warmth_k = 0.6;
    std::uint64_t seed = 1;
    double growth_s = 1200;
    double loop_s = 0;  // for which the flow goes on, and returns; 0: it ends with the growth
    bool keeps_velocity = false;

    bool operator==(const Specification&) const = default;
};

// Numbers of a level's air.
struct Level {
    float pressure_pa = 0;
    float exner = 1;                      // temperature over potential temperature
    float heat = 0;                       // potential temperature less kReference, K
    float water = 0;                      // g/kg
    std::array<float, 2> wind_m_per_s{};  // less that at the middle of the cloudy layer
};

struct Sounding {
    std::vector<Level> levels;
    float patch_heat = 0;  // of the air above patches: it condenses at the base
    float patch_water = 0;
    // The water that a parcel from the base has condensed at the inversion without mixing, g/kg.
    float adiabatic_water = 0;
};

Sounding make_sounding(const Specification& wanted);

}  // namespace skybake::convection
