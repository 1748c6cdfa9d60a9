// How gases of the air, of the Earth and of other planets, scatter and absorb light of one wavelength.
//
// All cross-sections are square metres per molecule. What a gas does along a path is its
// cross-section times the molecules on that path per square metre (its column):
//
//     zenith optical depth = (scattering + absorption) * column
//
//   air      scatters after Rayleigh: Bucholtz 1995 (Appl. Opt. 34, 2765), eq. 8 and table 3, in
//            standard air, with King's factor of Bates 1984. It does not absorb: ozone, oxygen
//            and the rest are gases of their own.
//   nitrogen, carbon dioxide   scatter after Rayleigh in air that is not the Earth's: by their
//            refractive indices and King's factors (Sneep & Ubachs 2005, J. Quant. Spectrosc. Radiat.
//            Transfer 92, 293). They do not absorb visible light.
//   others   absorb, and scatter nothing of their own, since they are a part of air.
//
// gas_absorption.cpp names the source of each table and its spacing. Oxygen and water vapour absorb
// in lines far narrower than the tables. Theirs are band means over 5 and 10 nm, which hold for the
// depth of the standard zenith column. Lines saturate: on a path m times as long the depth of a
// band grows like a power of m between 0.5 and 1 where lines are strong, not like m. So band means
// absorb too much of a low sun's light in the A band of oxygen (759 to 771 nm) and in the bands of
// water vapour (at 590, 720 and above 780 nm). At most wavelengths of the visible they are 0.
#pragma once

#include <span>

#include "config/text/quantity.h"

namespace skybake::config {

enum class Gas { air, ozone, nitrogen_dioxide, oxygen, water_vapor, nitrogen, carbon_dioxide };

// Whether the gas scatters, which it does by Rayleigh's phase function.
constexpr bool scatters(Gas gas) {
    return gas == Gas::air || gas == Gas::nitrogen || gas == Gas::carbon_dioxide;
}

// Both ends belong to it, however a unit's factor has rounded them.
struct WavelengthRange {
    Length shortest, longest;
    constexpr bool contains(Length wavelength) const {
        constexpr double kRounding = 1e-12;
        return wavelength.meters >= shortest.meters * (1 - kRounding) &&
               wavelength.meters <= longest.meters * (1 + kRounding);
    }
    bool operator==(const WavelengthRange&) const = default;
};

// Returns the wavelengths at which the gas is known. All of them include 380 to 780 nm.
WavelengthRange range_of(Gas gas);

// The cross sections of one molecule, and how the light that it scatters is spread.
struct GasOptics {
    double scattering_m2 = 0;
    double absorption_m2 = 0;
    double depolarization = 0;  // of the light that it scatters
    constexpr double extinction_m2() const { return scattering_m2 + absorption_m2; }
};

// The temperature for which absorption is told where a caller knows none: that of the ozone layer.
constexpr double kOzoneLayerTemperature_K = 233;

// The wavelength must be in range_of(gas). Ozone's absorption is linear in the temperature from 193
// to 293 K, beyond which it stays as it is. The other gases do not heed it.
GasOptics gas_optics(Gas gas, Length wavelength, double temperature_K = kOzoneLayerTemperature_K);

GasOptics nitrogen_optics(Length wavelength);
GasOptics carbon_dioxide_optics(Length wavelength);

// --- Air -----------------------------------------------------------------------------------------

double rayleigh_cross_section_m2(Length wavelength);

// King's factor F = (6 + 3 rho) / (6 - 7 rho), by which depolarisation raises scattering.
double king_factor(Length wavelength);

// The depolarisation rho of unpolarised light scattered by 90 degrees: 0.0295 at 400 nm, 0.0283 at
// 550 nm, 0.0278 at 700 nm.
double rayleigh_depolarization(Length wavelength);

// --- Columns: molecules per square metre from the ground to space --------------------------------

constexpr double kStandardPressure_Pa = 101325;

// Air: pressure / (gravity * mass of a mean molecule). 2.148e29 at 1013.25 hPa. Gravity falls with
// altitude: with its mean over the column, 9.790 m/s^2, the column is 0.17 % more.
constexpr double kStandardGravity_m_per_s2 = 9.80665;
double air_column_per_m2(double pressure_Pa = kStandardPressure_Pa,
                         double gravity_m_per_s2 = kStandardGravity_m_per_s2);

}  // namespace skybake::config
