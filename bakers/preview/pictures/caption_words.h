// What captions and file names say of suns and exposures, in one way for all pictures.
#pragma once

#include <string>

namespace skybake {

// "exposure 5.13 (+2.4 stops)": radiance was multiplied by 5.13, which --exposure 2.4 asks for.
std::string exposure_text(double exposure);

// The same with the tone curve (tone_curve.h).
std::string tone_text(double exposure);

// "sun 20 degrees above the horizon", "sun 4 degrees below the horizon", "sun on the horizon".
std::string sun_text(double elevation_degrees);

// For file names: "sun_20", "sun_minus_4", "sun_0_5".
std::string sun_stem(double elevation_degrees);

}  // namespace skybake
