#include "config/optics/standard_profiles.h"

#include <cassert>

#include "config/optics/interpolated_table.h"

namespace skybake::config {
namespace {

// US Standard Atmosphere 1976 up to 86 km, and AFGL-TR-86-0110 above. 1 is the density at the
// ground.
constexpr ProfilePoint kAirProfile[] = {{0, 1},
                                        {2000, 0.81711},
                                        {5250, 0.58185},
                                        {8000, 0.42657},
                                        {10000, 0.3393},
                                        {11750, 0.26333},
                                        {13750, 0.19223},
                                        {15750, 0.14022},
                                        {18000, 0.098533},
                                        {20250, 0.069149},
                                        {22500, 0.048214},
                                        {24750, 0.033758},
                                        {27000, 0.023726},
                                        {29250, 0.016738},
                                        {31500, 0.011833},
                                        {34000, 0.0079979},
                                        {36250, 0.005659},
                                        {38500, 0.0040302},
                                        {41000, 0.0027961},
                                        {43500, 0.0019611},
                                        {46500, 0.0012713},
                                        {51500, 0.00067738},
                                        {57250, 0.00034481},
                                        {62750, 0.00017364},
                                        {68000, 8.6486e-05},
                                        {73250, 4.0987e-05},
                                        {78250, 1.9056e-05},
                                        {83500, 8.2554e-06},
                                        {87750, 3.9673e-06},
                                        {94500, 9.4337e-07},
                                        {100000, 0}};

// AFGL-TR-86-0110 (Anderson et al. 1986), US standard: mixing ratios times air. 1 is its greatest
// density, 4.91e18 per m^3 at 22 km, with which the column is 345 DU. The altitudes are those of air.
constexpr ProfilePoint kOzoneProfile[] = {
    {0, 0.14137},      {2000, 0.13415},  {5250, 0.11329},  {8000, 0.13017},   {10000, 0.23466},
    {11750, 0.39618},  {13750, 0.46799}, {15750, 0.58972}, {18000, 0.82671},  {20250, 0.97956},
    {22500, 0.9868},   {24750, 0.88739}, {27000, 0.70003}, {29250, 0.55157},  {31500, 0.43505},
    {34000, 0.3211},   {36250, 0.2301},  {38500, 0.16066}, {41000, 0.098757}, {43500, 0.058709},
    {46500, 0.029267}, {51500, 0.0077},  {57250, 0.0021},  {62750, 0.0007},   {68000, 0}};

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
    if (gas == Gas::ozone) return kOzoneProfile;
    if (gas == Gas::nitrogen_dioxide) return kNitrogenDioxideProfile;
    if (gas == Gas::water_vapor) return kWaterVaporProfile;
    return kAirProfile;
}

double profile_at(std::span<const ProfilePoint> profile, double altitude_m) {
    assert(altitude_m >= 0);
    return interpolate(profile, &ProfilePoint::altitude_m, &ProfilePoint::relative_density,
                       altitude_m);
}

}  // namespace skybake::config
