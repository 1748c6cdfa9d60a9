// View rays of a camera anywhere above the ground.
#pragma once

#include "bakers/air/ray.h"
#include "bakers/light/sky_direction.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

struct CameraRay {
    SkyRay in_air;           // of length 0 where it misses the air
    double distance_km = 0;  // from the camera to where it enters the air: 0 for cameras in it
};

CameraRay camera_ray(const Shell& shell, double altitude_km, const SunZenith& sun,
                     const SkyDirection& direction);

}  // namespace skybake
