// Absorption by ozone, nitrogen dioxide, oxygen and water vapour. Numbers below are facts of the
// publications that each table names.
// How many molecules of each gas stand above a square metre.
// Scattering by the molecules of air, nitrogen and carbon dioxide.
#include "config/optics/gases.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "config/optics/elementary.h"
#include "config/optics/interpolated_table.h"

namespace skybake::config {
namespace {

struct OzoneRow {
    double nm, at_233_K, at_293_K;  // 1e-25 m^2
};

constexpr OzoneRow kOzoneAbsorption[] = {
#include "config/optics/tables/ozone_absorption.inc"
};

struct AbsorptionRow {
    double nm, cross_section;  // the unit is that of the table
};

constexpr AbsorptionRow kNitrogenDioxideAbsorption[] = {
#include "config/optics/tables/nitrogen_dioxide_absorption.inc"
};

constexpr AbsorptionRow kOxygenAbsorption[] = {
#include "config/optics/tables/oxygen_absorption.inc"
};

constexpr AbsorptionRow kWaterVaporAbsorption[] = {
#include "config/optics/tables/water_vapor_absorption.inc"
};

// The gases that only absorb, but for ozone, which heeds the temperature.
struct Absorber {
    Gas gas;
    std::span<const AbsorptionRow> rows;
    double unit_m2;
};
constexpr Absorber kAbsorbers[] = {{Gas::nitrogen_dioxide, kNitrogenDioxideAbsorption, 1e-23},
                                   {Gas::oxygen, kOxygenAbsorption, 1e-30},
                                   {Gas::water_vapor, kWaterVaporAbsorption, 1e-30}};

const Absorber* absorber_of(Gas gas) {
    const auto found = std::ranges::find(kAbsorbers, gas, &Absorber::gas);
    return found == std::end(kAbsorbers) ? nullptr : found;
}

double ozone_m2(double nm, double temperature_K) {
    const std::span<const OzoneRow> rows = kOzoneAbsorption;
    const double cold = interpolate(rows, &OzoneRow::nm, &OzoneRow::at_233_K, nm);
    const double warm = interpolate(rows, &OzoneRow::nm, &OzoneRow::at_293_K, nm);
    // The line through the two temperatures is continued to 193 K, the coldest that was measured.
    const double part = (std::clamp(temperature_K, 193.0, 293.0) - 233) / 60;
    return std::max(0.0, cold + (warm - cold) * part) * 1e-25;
}

template <class Row>
WavelengthRange range_of_rows(std::span<const Row> rows) {
    return {{rows.front().nm / 1e9}, {rows.back().nm / 1e9}};
}

constexpr double kAvogadro_per_mol = 6.02214076e23;
constexpr double kAirMolarMass_kg = 28.9644e-3;  // US Standard Atmosphere 1976

// F = (6 + 3 rho) / (6 - 7 rho), solved for rho.
double depolarization_of(double king) { return 6 * (king - 1) / (3 + 7 * king); }

// Returns the optics of a gas whose refractive index at 15 C and 1013.25 hPa is 1 + refractivity:
//
//   sigma = 24 pi^3 nu^4 / N^2 ((n^2 - 1) / (n^2 + 2))^2 F
GasOptics optics_of(double per_cm, double refractivity, double king) {
    constexpr double kPerCubicCm = 2.546899e19;  // N
    const double square = (1 + refractivity) * (1 + refractivity);
    const double ratio = per_cm * per_cm / kPerCubicCm * (square - 1) / (square + 2);
    constexpr double kCubeOfPi = std::numbers::pi * std::numbers::pi * std::numbers::pi;
    return {.scattering_m2 = 24 * kCubeOfPi * ratio * ratio * king * 1e-4,
            .depolarization = depolarization_of(king)};
}

double wave_number_per_cm(Length wavelength) { return 0.01 / wavelength.meters; }

}  // namespace

WavelengthRange range_of(Gas gas) {
    if (gas == Gas::ozone) return range_of_rows(std::span<const OzoneRow>(kOzoneAbsorption));
    if (const Absorber* absorber = absorber_of(gas)) return range_of_rows(absorber->rows);
    if (gas == Gas::air)
        return {{200e-9}, {1000e-9}};  // of Bucholtz' fits, as checked against his table
    return {{254e-9}, {1000e-9}};      // of the fits to refractive indices
}

GasOptics gas_optics(Gas gas, Length wavelength, double temperature_K) {
    const double nm = wavelength.meters * 1e9;
    if (gas == Gas::ozone) return {.absorption_m2 = ozone_m2(nm, temperature_K)};
    if (const Absorber* absorber = absorber_of(gas)) {
        return {.absorption_m2 = interpolate(absorber->rows, &AbsorptionRow::nm,
                                             &AbsorptionRow::cross_section, nm) *
                                 absorber->unit_m2};
    }
    if (gas == Gas::nitrogen) return nitrogen_optics(wavelength);
    if (gas == Gas::carbon_dioxide) return carbon_dioxide_optics(wavelength);
    return {.scattering_m2 = rayleigh_cross_section_m2(wavelength),
            .depolarization = rayleigh_depolarization(wavelength)};
}

double air_column_per_m2(double pressure_Pa, double gravity_m_per_s2) {
    return pressure_Pa / (gravity_m_per_s2 * kAirMolarMass_kg / kAvogadro_per_mol);
}

// Bucholtz 1995, eq. 8 with the coefficients of table 3, for standard air (15 C, 1013.25 hPa, 360
// ppm of carbon dioxide). The two fits meet at 0.5 um within 0.11 %. Wavelengths are in um.
double rayleigh_cross_section_m2(Length wavelength) {
    const double um = wavelength.meters * 1e6;
    struct Fit {
        double a_cm2, b, c, d;
    };
    constexpr Fit kShort = {3.01577e-28, 3.55212, 1.35579, 0.11563};
    constexpr Fit kLong = {4.01061e-28, 3.99668, 1.10298e-3, 2.71393e-2};
    const Fit& fit = um <= 0.5 ? kShort : kLong;
    return fit.a_cm2 * 1e-4 * power(um, -(fit.b + fit.c * um + fit.d / um));
}

// Bates 1984 (Planet. Space Sci. 32, 785) for nitrogen, oxygen, argon and carbon dioxide, weighted
// with their shares in percent of the volume (Bodhaine et al. 1999, J. Atmos. Oceanic Technol. 16,
// 1854, eqs. 5, 6 and 23).
double king_factor(Length wavelength) {
    const double um = wavelength.meters * 1e6;
    const double inverse_square = 1 / (um * um);
    const double nitrogen = 1.034 + 3.17e-4 * inverse_square;
    const double oxygen =
        1.096 + 1.385e-3 * inverse_square + 1.448e-4 * inverse_square * inverse_square;
    constexpr double kNitrogen = 78.084, kOxygen = 20.946, kArgon = 0.934, kCarbonDioxide = 0.036;
    return (kNitrogen * nitrogen + kOxygen * oxygen + kArgon * 1.0 + kCarbonDioxide * 1.15) /
           (kNitrogen + kOxygen + kArgon + kCarbonDioxide);
}

// Sneep & Ubachs 2005, eqs. 10 and 11 (Bates 1984, in two ranges that meet at 468 nm).
GasOptics nitrogen_optics(Length wavelength) {
    const double nu = wave_number_per_cm(wavelength);
    const double square = nu * nu;
    const double refractivity = nu > 21360 ? 5677.465 + 318.81874e12 / (14.4e9 - square)
                                           : 6498.2 + 307.4335e12 / (14.4e9 - square);
    return optics_of(nu, refractivity * 1e-8, 1.034 + 3.17e-12 * square);
}

// Sneep & Ubachs 2005, eq. 13, whose factor must be 1e3 and not 1e6 (Bideau-Mehu et al. 1973).
GasOptics carbon_dioxide_optics(Length wavelength) {
    const double nu = wave_number_per_cm(wavelength);
    const double square = nu * nu;
    struct Resonance {
        double strength, per_cm;
    };
    constexpr Resonance kResonances[] = {{5799.25, 128908.9},
                                         {120.05, 89223.8},
                                         {5.3334, 75037.5},
                                         {4.3244, 67837.7},
                                         {0.1218145e-4, 2418.136}};
    double sum = 0;
    for (const auto& [strength, per_cm] : kResonances) {
        sum += strength / (per_cm * per_cm - square);
    }
    return optics_of(nu, 1.1427e3 * sum, 1.1364 + 25.3e-12 * square);
}

double rayleigh_depolarization(Length wavelength) {
    return depolarization_of(king_factor(wavelength));
}

}  // namespace skybake::config
