// Scattering by the molecules of air, nitrogen and carbon dioxide.
#include <numbers>

#include "config/optics/elementary.h"
#include "config/optics/gases.h"

namespace skybake::config {

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

namespace {

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
