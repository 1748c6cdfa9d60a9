#include "bakers/render/white_balance.h"

namespace skybake {

ScreenColor daylight_screen(const Atmosphere& atmosphere, int threads) {
    const GroundIrradiance ground = ground_irradiance(atmosphere, {kDaylightElevation, 0}, threads);
    Image2<float> light(1, 1, atmosphere.medium.air.channels);
    for (int c = 0; c < light.channels; ++c) {
        const auto i = static_cast<std::size_t>(c);
        light.texels[i] = static_cast<float>(ground.sun[i] + ground.sky[i]);
    }
    return atmosphere.tables.screen.with_white(
        light, "the light of sun and sky on level ground under a sun of 30 degrees");
}

}  // namespace skybake
