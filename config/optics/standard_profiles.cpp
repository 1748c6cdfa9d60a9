#include "config/optics/standard_profiles.h"

#include <cassert>

#include "config/optics/interpolated_table.h"

namespace skybake::config {

namespace {

// US Standard Atmosphere 1976 up to 86 km, and AFGL-TR-86-0110 above. 1 is the density at the ground.
constexpr ProfilePoint kAirProfile[] = {
    {0, 0.9925},        {3500, 0.6995},     {7500, 0.4503},     {12000, 0.2521},
    {14500, 0.1702},    {16500, 0.1244},    {19000, 0.08405},   {21500, 0.05662},
    {23500, 0.04116},   {25500, 0.03002},   {27500, 0.0219},    {30000, 0.01488},
    {32500, 0.01015},   {34500, 0.00741},   {36500, 0.005449},  {38500, 0.004036},
    {41000, 0.002793},  {43500, 0.001963},  {46500, 0.001278},  {51000, 0.0007235},
    {56500, 0.000379},  {62000, 0.0001919}, {67000, 9.961e-05}, {72000, 4.962e-05},
    {76500, 2.522e-05}, {81000, 1.242e-05}, {86000, 5.402e-06}, {92000, 1.767e-06},
    {100000, 0}};

// AFGL-TR-86-0110 (Anderson et al. 1986), US standard: mixing ratios times air. 1 is its greatest
// density, 4.91e18 per m^3 at 22 km, with which the column is 346 DU.
constexpr ProfilePoint kOzoneProfile[] = {
    {0, 0.1385},      {1500, 0.1374},   {5250, 0.1142},    {8000, 0.1301},  {10000, 0.2347},
    {11750, 0.3964},  {13750, 0.4698},  {15500, 0.5712},   {18250, 0.8389}, {20000, 0.9743},
    {22500, 0.9935},  {24750, 0.8814},  {29000, 0.5637},   {33250, 0.3428}, {39000, 0.1459},
    {42750, 0.06704}, {47750, 0.02063}, {55500, 0.003131}, {70000, 0}};

// AFGL-TR-86-0110, US standard. 1 is the density at the ground, 1.97e23 per m^3, with which the column
// is 14.2 kg/m^2.
constexpr ProfilePoint kWaterVaporProfile[] = {
    {0, 0.991},      {1250, 0.6423},  {2750, 0.3408},   {3500, 0.2362},     {4500, 0.1404},
    {5250, 0.09372}, {6750, 0.03947}, {9000, 0.006238}, {12250, 0.0005234}, {20000, 0}};

// AFGL-TR-86-0110. 1 is its greatest density, 3.12e15 per m^3 at 25 km, with which the column is 5.5e19
// per m^2.
constexpr ProfilePoint kNitrogenDioxideProfile[] = {
    {0, 0.1828},      {8250, 0.07418},  {12250, 0.06445}, {14000, 0.1106}, {14750, 0.1844},
    {18500, 0.6871},  {21000, 0.8994},  {25000, 0.9925},  {29500, 0.7781}, {38750, 0.1601},
    {40750, 0.07864}, {42000, 0.04774}, {50000, 0}};

}  // namespace

std::span<const ProfilePoint> standard_profile(Gas gas) {
    switch (gas) {
        case Gas::ozone:
            return kOzoneProfile;
        case Gas::nitrogen_dioxide:
            return kNitrogenDioxideProfile;
        case Gas::water_vapor:
            return kWaterVaporProfile;
        case Gas::air:
        case Gas::oxygen:
            break;
    }
    return kAirProfile;
}

double profile_depth_m(std::span<const ProfilePoint> profile) {
    double depth = 0;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const double thickness = profile[i].altitude_m - profile[i - 1].altitude_m;
        depth += thickness * (profile[i].relative_density + profile[i - 1].relative_density) / 2;
    }
    return depth;
}

double profile_at(std::span<const ProfilePoint> profile, double altitude_m) {
    assert(altitude_m >= 0);
    return interpolate(profile, &ProfilePoint::altitude_m, &ProfilePoint::relative_density,
                       altitude_m);
}

}  // namespace skybake::config
