// Scattering by the molecules of air, without absorption.
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

double rayleigh_depolarization(Length wavelength) {
    // F = (6 + 3 rho) / (6 - 7 rho), solved for rho.
    const double king = king_factor(wavelength);
    return 6 * (king - 1) / (3 + 7 * king);
}

double rayleigh_second_moment(double depolarization) {
    return (1 - depolarization) / (2 + depolarization) / 5;
}

}  // namespace skybake::config
