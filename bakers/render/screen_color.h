// From the channels of a table of light to linear sRGB, which tone curves take.
//
// A file says in its conventions what its channels are:
//
//   colours                     are carried from their space to linear sRGB; what was white stays
//                               white
//   wavelengths with weights    are summed with the file's weights, then carried as colours are
//   one or three wavelengths    are shown as they are: as grey, or as red, green and blue
//   two or four without weights are taken as a spectrum that is linear between them, under which
//                               the sun outside the air is white (bakers/color/spectral_color.h)
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/image.h"

namespace skybake {

class ScreenColor {
  public:
    // Shows channels as they are.
    ScreenColor() = default;

    // Shows the channels of a file with these conventions.
    ScreenColor(const Conventions& conventions, int channels);

    // Returns linear sRGB, or one channel that is shown as grey. Colours that screens cannot show
    // have negative components. NaN in any channel makes the texel NaN.
    Image2<float> shown(const Image2<float>& light) const;

    // Returns the same with another white: the colour of a texel of light becomes grey, of the same
    // luminance, by Bradford's adaptation. Black and light without colours leave it as it is.
    ScreenColor with_white(const Image2<float>& light, std::string name) const;

    // Returns what captions say of it, as a part of a sentence: "channels are shown as linear sRGB,
    // in which sunlight outside the atmosphere is white".
    std::string words() const;

  private:
    std::vector<glm::dvec3> weights_;  // one for each channel; none: as they are
    std::string from_ = "channels are shown as linear sRGB";
    std::string white_ = "sunlight outside the atmosphere";
};

}  // namespace skybake
