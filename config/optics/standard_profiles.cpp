#include "config/optics/standard_profiles.h"

#include <cassert>

#include "config/optics/interpolated_table.h"

namespace skybake::config {

namespace {

// US Standard Atmosphere 1976 up to 86 km, and AFGL-TR-86-0110 above. 1 is the density at the
// ground.
constexpr ProfilePoint kAirProfile[] = {
    {0, 0.99505},        {3000, 0.73857},     {6000, 0.5362},      {9000, 0.37939},
    {13000, 0.21547},    {15500, 0.14553},    {18000, 0.09832},    {20500, 0.066483},
    {22500, 0.048262},   {24500, 0.035142},   {26500, 0.025667},   {28500, 0.018803},
    {30500, 0.013814},   {33000, 0.0093771},  {35000, 0.0068574},  {37000, 0.0050522},
    {39000, 0.0037487},  {41500, 0.0025997},  {44000, 0.0018301},  {47000, 0.0011942},
    {51500, 0.00068065}, {57000, 0.0003569},  {62000, 0.00019196}, {67000, 9.963e-05},
    {72000, 4.9629e-05}, {76500, 2.5223e-05}, {81000, 1.242e-05},  {86000, 5.403e-06},
    {92000, 1.767e-06},  {100000, 0}};

// AFGL-TR-86-0110 (Anderson et al. 1986), US standard: mixing ratios times air. 1 is its greatest
// density, 4.91e18 per m^3 at 22 km, with which the column is 346 DU.
constexpr ProfilePoint kOzoneProfile[] = {
    {0, 0.13848},      {1500, 0.13741},   {5250, 0.11417},   {8000, 0.13012},  {10000, 0.23473},
    {11750, 0.39639},  {13750, 0.46985},  {15500, 0.57124},  {18250, 0.83892}, {20000, 0.97432},
    {22500, 0.99342},  {24500, 0.90009},  {29000, 0.56377},  {33250, 0.34278}, {39000, 0.14592},
    {42750, 0.067045}, {47750, 0.020633}, {55500, 0.003131}, {70000, 0}};

// AFGL-TR-86-0110, US standard. 1 is the density at the ground, 1.97e23 per m^3, with which the
// column is 14.2 kg/m^2.
constexpr ProfilePoint kWaterVaporProfile[] = {
    {0, 0.99108},     {1250, 0.64235},  {2750, 0.34085},   {3500, 0.23618},     {4500, 0.14045},
    {5250, 0.093725}, {6750, 0.039472}, {9000, 0.0062383}, {12250, 0.00052343}, {20000, 0}};

// AFGL-TR-86-0110. 1 is its greatest density, 3.12e15 per m^3 at 25 km, with which the column is
// 5.5e19 per m^2.
constexpr ProfilePoint kNitrogenDioxideProfile[] = {
    {0, 0.18281},      {8250, 0.074182},  {12250, 0.064458}, {14000, 0.11062}, {14750, 0.18444},
    {18500, 0.68703},  {21000, 0.89937},  {25000, 0.99255},  {29500, 0.77808}, {38750, 0.16008},
    {40750, 0.078643}, {42000, 0.047741}, {50000, 0}};

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
        case Gas::nitrogen:
        case Gas::carbon_dioxide:
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
