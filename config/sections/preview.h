// This header declares [preview] and [preview.camera], which say how pictures show the recipe. No
// asset is made from them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/text/quantity.h"

namespace skybake::config {

// How scene-linear light with an exposure becomes display-linear light in [0, 1].
enum class ToneCurve {
    // A toe, a straight part and a shoulder for the greatest channel, which the others follow, so that
    // hues stay; what is far brighter than white turns white (bakers/render/tone_curve.h).
    film,
    // 1 - exp(-light), of each channel.
    exponential,
    // The fit by Stephen Hill to the Reference Rendering Transform and Output Device Transform of
    // the Academy Color Encoding System, for sRGB screens. Bright colours turn white.
    aces,
    // The base look of AgX by Troy Sobotka: logarithms of light from 2^-12.47393 to 2^4.026069 in
    // desaturated primaries, with the polynomial of degree 6 by Benjamin Wrensch for its sigmoid.
    // Bright colours turn white later and with fewer shifts of hue.
    agx,
};

// The light of the sun's disc that a lens or an eye scatters around it in pictures of the sky.
enum class Glare { none, camera, eye };

// The camera of pictures of clouds. Settings that are not given are chosen. Angles are in radians.
struct PreviewCamera {
    std::optional<std::array<double, 3>> position;  // metres: x, y from the tile's corner, altitude
    std::optional<double> heading;                  // from +x towards +y
    std::optional<double> pitch;                    // above the horizontal
    std::optional<double> fov;                      // across the picture
};

struct Preview {
    PreviewCamera camera;
    std::optional<std::array<int, 2>> size;  // width and height of pictures of clouds, in pixels
    bool single = false;                     // one tile of a cloud alone
    std::optional<double> altitude;          // metres, of the camera of skies
    std::vector<Angle> sun_elevation;
    std::optional<double> sun_azimuth;  // radians, from +x towards +y
    std::optional<std::string> at;      // as parse_moment reads it (config/text/moment.h)
    std::optional<double> latitude;     // radians, positive in the north
    std::optional<double> longitude;    // radians, positive in the east
    std::optional<double> exposure;     // in stops
    ToneCurve tone_curve = ToneCurve::film;
    Glare glare = Glare::none;
};

// The pictures of light that a preview has.
struct PicturesOfLight {
    bool sky = false;     // of a transmittance and a multiple_scattering table
    bool clouds = false;  // of a cloud volume
};

// Says why no picture uses a key of [preview], or the option of the same name. Returns an empty text
// if a picture uses it.
std::string_view why_unused(std::string_view key, const PicturesOfLight& pictures);

}  // namespace skybake::config
