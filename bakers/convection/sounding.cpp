#include "bakers/convection/sounding.h"

#include <algorithm>

#include "bakers/convection/moist_air.h"
#include "bakers/math/transcendental.h"

namespace skybake::convection {
namespace {

double power(double base, double exponent) { return exponential(exponent * logarithm(base)); }

double exner_of(double pressure_pa) { return power(pressure_pa / 1e5, kGasOverHeat); }

// Saturation mixing ratio of vapour over water, g/kg (Bolton 1980, "The computation of equivalent potential
// temperature", equation 10).
double saturation_water(double temperature_k, double pressure_pa) {
    const double vapour =
        611.2 * exponential(17.67 * (temperature_k - 273.15) / (temperature_k - 29.65));
    return 1e3 * kVapourRatio * vapour / (pressure_pa - (1 - kVapourRatio) * vapour);
}

// The cooling of rising cloudy air, K/m (American Meteorological Society, Glossary of Meteorology,
// "moist-adiabatic lapse rate").
double moist_lapse(double temperature_k, double pressure_pa) {
    const double water = 1e-3 * saturation_water(temperature_k, pressure_pa);
    const double warm = kLatentHeat * water / (kGasConstant * temperature_k);
    const double latent = kLatentHeat * warm / (kHeatCapacity * temperature_k) * kVapourRatio;
    return kGravity / kHeatCapacity * (1 + warm) / (1 + latent);
}

// A column that is climbed from the base in short steps.
struct Climb {
    double height_m = 0;
    double temperature_k = 0;
    double pressure_pa = 0;

    void step(double rise_m, double lapse) {
        const double middle_k = temperature_k - 0.5 * lapse * rise_m;
        pressure_pa *= exponential(-kGravity * rise_m / (kGasConstant * middle_k));
        temperature_k -= lapse * rise_m;
        height_m += rise_m;
    }
};

constexpr double kInversionWarming = 0.010;  // K/m of potential temperature above the inversion

double lapse_of(const Specification& wanted, const Climb& at) {
    constexpr double kDry = kGravity / kHeatCapacity;
    if (at.height_m < 0) return kDry;
    if (at.height_m < wanted.inversion_m) {
        return moist_lapse(at.temperature_k, at.pressure_pa) + 1e-3 * wanted.instability_k_per_km;
    }
    return kDry - kInversionWarming * exner_of(at.pressure_pa);
}

// The share of saturation above the base. The mixed layer has one amount of water, which saturates it at the base:
// wherever its air rises, cloud begins at the same height.
double humidity_at(const Specification& wanted, double height_m) {
    constexpr double kBlend = 150;  // m over which the humidity of the mixed layer fades
    const double share = std::clamp(height_m / kBlend, 0.0, 1.0);
    return 1 + (wanted.humidity - 1) * share;
}

Climb base_of(const Specification& wanted) {
    const double pressure = 101325 * power(1 - 2.25577e-5 * wanted.base_altitude_m, 5.25588);
    return {0, wanted.base_temperature_k, pressure};
}

// Climbs or descends to a height.
Climb climbed(const Specification& wanted, double height_m) {
    Climb at = base_of(wanted);
    constexpr double kStep = 5;
    while (at.height_m != height_m) {
        const double left = height_m - at.height_m;
        const double rise = std::clamp(left, -kStep, kStep);
        // Below the base the lapse is the dry one all the way.
        Climb below = at;
        below.height_m += rise < 0 ? rise : 0;
        at.step(rise, lapse_of(wanted, below));
        if (std::clamp(left, -kStep, kStep) == left) at.height_m = height_m;
    }
    return at;
}

}  // namespace

Sounding make_sounding(const Specification& wanted) {
    Sounding sounding;
    const Climb base = base_of(wanted);
    const double saturated = saturation_water(base.temperature_k, base.pressure_pa);
    for (int z = 0; z < wanted.grid.cells[2]; ++z) {
        const double height = (z - wanted.mixed_levels + 0.5) * double{wanted.grid.edge_m[2]};
        const Climb at = climbed(wanted, height);
        Level level;
        level.pressure_pa = static_cast<float>(at.pressure_pa);
        const double exner = exner_of(at.pressure_pa);
        level.exner = static_cast<float>(exner);
        level.heat = static_cast<float>(at.temperature_k / exner - kReference);
        const double humid = humidity_at(wanted, height);
        const double water =
            height < 0 ? saturated : humid * saturation_water(at.temperature_k, at.pressure_pa);
        level.water = static_cast<float>(water);
        const double share = std::clamp(height / wanted.inversion_m, 0.0, 1.0) - 0.5;
        for (std::size_t i = 0; i < 2; ++i) {
            level.wind_m_per_s[i] =
                static_cast<float>(share * (wanted.wind_top_m_per_s[i] - wanted.wind_m_per_s[i]));
        }
        sounding.levels.push_back(level);
    }
    const double exner = exner_of(base.pressure_pa);
    sounding.patch_heat =
        static_cast<float>(base.temperature_k / exner + wanted.patch_warmth_k - kReference);
    sounding.patch_water = static_cast<float>(
        saturation_water(base.temperature_k + wanted.patch_warmth_k * exner, base.pressure_pa));
    Climb parcel = base;
    while (parcel.height_m < wanted.inversion_m) {
        parcel.step(5, moist_lapse(parcel.temperature_k, parcel.pressure_pa));
    }
    sounding.adiabatic_water =
        static_cast<float>(saturated - saturation_water(parcel.temperature_k, parcel.pressure_pa));
    return sounding;
}

}  // namespace skybake::convection
