// The white of pictures: the light of sun and sky on level ground, under a sun of 30 degrees in the
// picture's own air. It is the "daylight" that a camera is set to, and stays so in the evening, so that
// a low sun is orange and dusk is blue. Baked files keep their own white (bakers/color/color_space.h),
// in which the sun outside the air is white and clouds in the sun are beige.
//
// Hard cases: one channel, which has no colour, and air that lets no light through stay as they are.
#pragma once

#include "bakers/render/cloud_view.h"

namespace skybake {

inline constexpr double kDaylightElevation = 30;  // degrees

// Returns how the tables' channels are shown, with that white.
ScreenColor daylight_screen(const Atmosphere& atmosphere, int threads);

}  // namespace skybake
