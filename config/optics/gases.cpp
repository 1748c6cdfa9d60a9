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

// Gorshelev, Serdyuchenko et al. 2014 (Atmos. Meas. Tech. 7, 609 and 625, CC BY 3.0; spectra of the
// University of Bremen). The 293-K column is that of the spectrum every 1 nm, thinned to the rows
// which hold it by linear interpolation within 0.8 % plus a depth of 1.2e-5 at 300 DU (4e-5 below
// 400 nm). The 233-K column is the 293-K one times a ratio, piecewise linear in wavelength, that
// gives the means of the 233-K spectrum over each 10 nm from 360 to 780 nm; from 438 to 443 nm, from
// 549 to 551 nm and at 680 nm it is the 233-K spectrum itself, whose 0.01-nm values at 440, 550 and
// 680 nm it holds within 0.02 %. Below 400 nm only the means over 10 nm are held, not the Huggins
// bands.
constexpr OzoneRow kOzoneAbsorption[] = {
    {360, 0.0268, 0.07867},    {361, 0.02212, 0.06495},  {362, 0.0133, 0.03906},
    {364, 0.009168, 0.02692},  {365, 0.01669, 0.049},    {368, 0.004388, 0.01529},
    {382, 0.001728, 0.004086}, {400, 0.009173, 0.01089}, {403, 0.0132, 0.01535},
    {405, 0.0127, 0.01456},    {409, 0.02252, 0.02571},  {411, 0.02498, 0.02845},
    {414, 0.02257, 0.02564},   {418, 0.03486, 0.03869},  {421, 0.03541, 0.03846},
    {425, 0.06516, 0.06882},   {426, 0.06727, 0.07119},  {427, 0.06749, 0.07158},
    {429, 0.05965, 0.06352},   {430, 0.05947, 0.06345},  {433, 0.07945, 0.08529},
    {436, 0.07977, 0.08595},   {437, 0.08271, 0.08907},  {438, 0.0946, 0.09902},
    {439, 0.1132, 0.1149},     {440, 0.13248, 0.1355},   {441, 0.15226, 0.1568},
    {442, 0.1687, 0.175},      {443, 0.1755, 0.1818},    {444, 0.1683, 0.1806},
    {446, 0.1466, 0.1565},     {447, 0.1422, 0.1511},    {448, 0.1492, 0.1578},
    {450, 0.1821, 0.1909},     {452, 0.1924, 0.1998},    {454, 0.1896, 0.1951},
    {455, 0.2014, 0.2064},     {456, 0.2228, 0.2289},    {457, 0.2501, 0.2577},
    {460, 0.3599, 0.3737},     {461, 0.3874, 0.4034},    {462, 0.3954, 0.4129},
    {463, 0.3893, 0.4076},     {465, 0.3445, 0.3627},    {466, 0.3336, 0.3505},
    {467, 0.3328, 0.3488},     {470, 0.4049, 0.4218},    {473, 0.4135, 0.428},
    {474, 0.4222, 0.436},      {475, 0.4469, 0.4606},    {476, 0.4767, 0.4914},
    {478, 0.5917, 0.6106},     {480, 0.7276, 0.7515},    {481, 0.7821, 0.8082},
    {482, 0.8165, 0.8441},     {484, 0.813, 0.8413},     {487, 0.7357, 0.761},
    {488, 0.733, 0.7579},      {492, 0.8322, 0.859},     {494, 0.8458, 0.8722},
    {496, 0.8812, 0.9071},     {497, 0.926, 0.9518},     {498, 0.9888, 1.015},
    {500, 1.156, 1.183},       {503, 1.447, 1.475},      {505, 1.581, 1.606},
    {507, 1.598, 1.628},       {511, 1.499, 1.534},      {513, 1.525, 1.565},
    {521, 1.808, 1.841},       {524, 2.027, 2.053},      {529, 2.503, 2.538},
    {532, 2.722, 2.766},       {534, 2.778, 2.827},      {539, 2.804, 2.846},
    {545, 3.116, 3.145},       {549, 3.2562, 3.2898},    {550, 3.2844, 3.3191},
    {551, 3.3145, 3.3503},     {555, 3.463, 3.504},      {558, 3.669, 3.707},
    {564, 4.225, 4.255},       {571, 4.638, 4.662},      {575, 4.736, 4.757},
    {585, 4.361, 4.402},       {589, 4.353, 4.379},      {592, 4.456, 4.472},
    {599, 5.024, 5.029},       {602, 5.148, 5.154},      {604, 5.126, 5.132},
    {607, 4.961, 4.972},       {614, 4.36, 4.388},       {619, 4.03, 4.055},
    {633, 3.333, 3.361},       {642, 2.805, 2.847},      {647, 2.562, 2.609},
    {674, 1.5, 1.552},         {680, 1.3185, 1.368},     {686, 1.194, 1.242},
    {694, 0.9655, 1.012},      {699, 0.8416, 0.8849},    {703, 0.7668, 0.8082},
    {707, 0.7179, 0.755},      {711, 0.6826, 0.7128},    {715, 0.6683, 0.6929},
    {717, 0.6487, 0.6744},     {723, 0.5347, 0.5604},    {731, 0.4337, 0.4564},
    {735, 0.4089, 0.4307},     {741, 0.4058, 0.4177},    {746, 0.4349, 0.4417},
    {748, 0.4336, 0.442},      {750, 0.4123, 0.4219},    {754, 0.3318, 0.3419},
    {757, 0.2884, 0.2992},     {759, 0.2708, 0.2822},    {762, 0.2535, 0.266},
    {766, 0.2376, 0.2498},     {771, 0.244, 0.2502},     {774, 0.2695, 0.2723},
    {777, 0.3037, 0.3052},     {779, 0.3134, 0.3151},    {780, 0.3115, 0.3131}};

struct AbsorptionRow {
    double nm, cross_section;  // the unit is that of the table
};

// Vandaele et al. 1998 (J. Quant. Spectrosc. Radiat. Transfer 59, 171), 294 K, means over 5 nm
// around each row as recommended by NASA's JPL Publication 06-2 (a work of the US government).
// 1e-23 m^2. The bands within 5 nm, and how they sharpen in the cold of the stratosphere, are not
// told. The recommendation ends at 662.5 nm; from there absorption is taken to fall to 0 at 680 nm.
constexpr AbsorptionRow kNitrogenDioxideAbsorption[] = {
    {360, 5.09},   {365, 5.49},  {370, 5.61},  {375, 5.90},  {380, 5.93},  {385, 6.01},
    {390, 6.30},   {395, 5.97},  {400, 6.44},  {405, 5.82},  {410, 6.24},  {415, 5.91},
    {420, 5.99},   {425, 5.70},  {430, 5.44},  {435, 5.59},  {440, 4.88},  {445, 4.88},
    {450, 4.98},   {455, 4.16},  {460, 4.36},  {465, 4.14},  {470, 3.37},  {475, 3.87},
    {480, 3.37},   {485, 2.54},  {490, 3.08},  {495, 2.94},  {500, 1.82},  {505, 2.43},
    {510, 2.31},   {515, 1.60},  {520, 1.61},  {525, 1.79},  {530, 1.53},  {535, 1.06},
    {540, 1.08},   {545, 1.27},  {550, 1.10},  {555, 0.797}, {560, 0.605}, {565, 0.870},
    {570, 0.848},  {575, 0.471}, {580, 0.447}, {585, 0.469}, {590, 0.539}, {595, 0.408},
    {600, 0.395},  {605, 0.185}, {610, 0.254}, {615, 0.353}, {620, 0.257}, {625, 0.196},
    {630, 0.121},  {635, 0.133}, {640, 0.153}, {645, 0.192}, {650, 0.135}, {655, 0.0873},
    {660, 0.0566}, {670, 0.028}, {680, 0},     {830, 0}};

// The A band (759 to 771 nm), B band (687 to 695 nm) and gamma band (627 to 634 nm), as the mean
// transmittance of the zenith column over the 5 nm around each row: absorption coefficients per 1
// nm of Gueymard's SMARTS 2.9.5 (2005, from HITRAN; O2, per atm-cm), whose depths are linear in the
// column within 1 nm. 1e-30 m^2.
constexpr AbsorptionRow kOxygenAbsorption[] = {
    {360, 0},      {600, 0},        {605, 0}, {610, 0}, {615, 0},      {620, 0},     {625, 0},
    {630, 0.3103}, {635, 0.006107}, {640, 0}, {645, 0}, {650, 0},      {655, 0},     {660, 0},
    {665, 0},      {670, 0},        {675, 0}, {680, 0}, {685, 0.9353}, {690, 2.183}, {695, 0.1494},
    {700, 0},      {705, 0},        {710, 0}, {715, 0}, {720, 0},      {725, 0},     {730, 0},
    {735, 0},      {740, 0},        {745, 0}, {750, 0}, {755, 0},      {760, 9.025}, {765, 8.262},
    {770, 0.4203}, {775, 0.01225},  {780, 0}, {785, 0}, {790, 0},      {795, 0},     {800, 0},
    {805, 0},      {830, 0}};

// Bird & Riordan 1986 (J. Climate Appl. Meteorol. 25, 87; SERI/TR-215-2436, a work of the US
// government), their eq. 8 at 1.42 cm of water in the zenith: bands of about 10 nm. Weak bands at
// 505, 545, 570, 630 and 650 nm, all of depths below 0.01, are not in their table and not in this.
// 1e-30 m^2.
constexpr AbsorptionRow kWaterVaporAbsorption[] = {
    {360, 0},          {550, 0},          {570, 0},      {593, 31.99},   {610, 0},
    {630, 0},          {656, 0},          {667.6, 0},    {690, 9.64},    {710, 7.776},
    {718, 216.4},      {724.4, 259.9},    {740, 27.66},  {752.5, 0.565}, {757.5, 0.07126},
    {762.5, 0.007134}, {767.5, 0.007134}, {780, 0.4248}, {800, 18.69},   {816, 202.6}};

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

}  // namespace

std::span<const Gas> all_gases() {
    static constexpr std::array kAll = {Gas::air,           Gas::ozone,       Gas::nitrogen_dioxide,
                                        Gas::oxygen,        Gas::water_vapor, Gas::nitrogen,
                                        Gas::carbon_dioxide};
    return kAll;
}

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

namespace {

constexpr double kAvogadro_per_mol = 6.02214076e23;
constexpr double kAirMolarMass_kg = 28.9644e-3;  // US Standard Atmosphere 1976

}  // namespace

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
