// Constants of moist air. Water in air is in g/kg.
#pragma once

namespace skybake::convection {

constexpr double kGravity = 9.81;        // m/s2
constexpr double kHeatCapacity = 1004;   // of dry air at constant pressure, J/(kg K)
constexpr double kGasConstant = 287.04;  // of dry air, J/(kg K)
constexpr double kGasOverHeat = kGasConstant / kHeatCapacity;
constexpr double kLatentHeat = 2.5e6;     // of vaporization, J/kg
constexpr double kVapourRatio = 0.622;    // molar masses of water and of dry air

}  // namespace skybake::convection
