#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/convection/saturation.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/convection/moist_air.h"
#include "bakers/convection/saturation.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::convection::HWY_NAMESPACE {
namespace {

constexpr float kHottest = 340;  // K; the exponential wants arguments below 0
constexpr float kSaturationSlope = 17.67F;
constexpr float kSaturationPole = 29.65F;  // K
constexpr float kHottestExponent =
    kSaturationSlope * (kHottest - 273.15F) / (kHottest - kSaturationPole);

// Constants of a level for its cells.
struct LevelNumbers {
    float heat_of_water = 0;  // potential temperature that condensing 1 g/kg adds, K
    float exner = 1;
    float pressure = 0;
    float hottest_vapour = 0;  // saturation pressure at kHottest, Pa
};

LevelNumbers numbers_of(const Level& level) {
    constexpr float kPerGram = static_cast<float>(1e-3 * kLatentHeat / kHeatCapacity);
    return {kPerGram / level.exner, level.exner, level.pressure_pa,
            static_cast<float>(611.2 * 44.9770667)};
}

HWY_INLINE float root_of(float heat, float water, const LevelNumbers& level) {
    constexpr float kReferenceHeat = static_cast<float>(kReference);
    constexpr float kRatio = static_cast<float>(kVapourRatio);
    float root = 0;
    for (int i = 0; i < 4; ++i) {
        const float temperature =
            (kReferenceHeat + (heat + level.heat_of_water * root)) * level.exner;
        const float above_pole = temperature - kSaturationPole;
        const float exponent =
            kSaturationSlope * (temperature - 273.15F) / above_pole - kHottestExponent;
        const float vapour =
            level.hottest_vapour * skybake::HWY_NAMESPACE::exponential_of_negative(exponent);
        const float dry = level.pressure - (1.0F - kRatio) * vapour;
        const float saturated = 1e3F * kRatio * vapour / dry;
        const float slope = saturated * (level.pressure / dry) * (kSaturationSlope * 243.5F) /
                            (above_pole * above_pole);
        root =
            root + (water - root - saturated) / (1.0F + slope * level.heat_of_water * level.exner);
    }
    return root;
}

HWY_INLINE float virtual_heat_of(float heat, float water, const LevelNumbers& level) {
    constexpr float kReferenceHeat = static_cast<float>(kReference);
    const float root = root_of(heat, water, level);
    const float liquid = root > 0.0F ? root : 0.0F;
    const float warm = heat + level.heat_of_water * liquid;
    return warm + (kReferenceHeat + warm) * (1e-3F * (0.608F * (water - liquid) - liquid));
}

}  // namespace

void Condensed(const AirRow& air, const Level& level, float* __restrict root) {
    const LevelNumbers numbers = numbers_of(level);
    const float* __restrict heat = air.heat;
    const float* __restrict water = air.water;
    for (int i = 0; i < air.count; ++i) root[i] = root_of(heat[i], water[i], numbers);
}

void Buoyancies(const AirRow& air, const Level& level, float own, float* __restrict out) {
    constexpr float kScale = static_cast<float>(kGravity / kReference);
    const LevelNumbers numbers = numbers_of(level);
    const float* __restrict heat = air.heat;
    const float* __restrict water = air.water;
    for (int i = 0; i < air.count; ++i) {
        out[i] = kScale * (virtual_heat_of(heat[i], water[i], numbers) - own);
    }
}

float VirtualHeat(const Level& level) {
    return virtual_heat_of(level.heat, level.water, numbers_of(level));
}

}  // namespace skybake::convection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::convection {

HWY_EXPORT(Condensed);
HWY_EXPORT(Buoyancies);
HWY_EXPORT(VirtualHeat);

void condensed(const AirRow& air, const Level& level, float* root) {
    HWY_DYNAMIC_DISPATCH(Condensed)(air, level, root);
}

void buoyancies(const AirRow& air, const Level& level, float own, float* out) {
    HWY_DYNAMIC_DISPATCH(Buoyancies)(air, level, own, out);
}

float virtual_heat(const Level& level) { return HWY_DYNAMIC_DISPATCH(VirtualHeat)(level); }

}  // namespace skybake::convection
#endif  // HWY_ONCE
