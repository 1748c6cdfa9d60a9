// How many molecules of each gas stand above a square metre.
#include "config/optics/gases.h"

namespace skybake::config {

namespace {

constexpr double kAvogadro_per_mol = 6.02214076e23;
constexpr double kAirMolarMass_kg = 28.9644e-3;  // US Standard Atmosphere 1976
constexpr double kWaterMolarMass_kg = 18.01528e-3;
// US Standard Atmosphere 1976.
constexpr double kOxygenShare = 0.209476;
constexpr double kNitrogenShare = 0.78084;
constexpr double kCarbonDioxideShare = 0.000314;

}  // namespace

double air_column_per_m2(double pressure_Pa, double gravity_m_per_s2) {
    return pressure_Pa / (gravity_m_per_s2 * kAirMolarMass_kg / kAvogadro_per_mol);
}

double oxygen_column_per_m2(double pressure_Pa, double gravity_m_per_s2) {
    return kOxygenShare * air_column_per_m2(pressure_Pa, gravity_m_per_s2);
}

double water_vapor_column_per_m2(double kilograms_per_m2) {
    return kilograms_per_m2 / (kWaterMolarMass_kg / kAvogadro_per_mol);
}

double standard_column_per_m2(Gas gas) {
    switch (gas) {
        case Gas::ozone:
            return ozone_column_per_m2(kStandardOzone_DU);
        case Gas::nitrogen_dioxide:
            return kStandardNitrogenDioxide_per_m2;
        case Gas::oxygen:
            return oxygen_column_per_m2();
        case Gas::water_vapor:
            return water_vapor_column_per_m2(kStandardWaterVapor_kg_per_m2);
        case Gas::nitrogen:
            return kNitrogenShare * air_column_per_m2();
        case Gas::carbon_dioxide:
            return kCarbonDioxideShare * air_column_per_m2();
        case Gas::air:
            break;
    }
    return air_column_per_m2();
}

}  // namespace skybake::config
