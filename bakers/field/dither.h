// Rounds texels of smooth gradients so that they show no bands: neighbours are rounded up and down in
// the shares that keep their mean.
#pragma once

#include <array>

#include "config/sections/pixel_types.h"

namespace skybake::config {
struct AssetFiles;
}  // namespace skybake::config

namespace skybake {

// How the texels of a table are rounded.
struct TexelRounding {
    config::PixelType type;
    bool dithers = false;

    TexelRounding(config::PixelType of) : type(of) {}
    TexelRounding(const config::AssetFiles& files);
};

// Returns the value of a channel of texel (x, y) as a file holds it. With dither, unorm types round a
// value up in that share of texels by which it lies above the step below it: it is off by less than a
// step, where rounding to nearest is off by at most half of one. 0, 1 and every other step stay as they
// are. Otherwise, and beyond [0, 1], it is round_to_pixel_type(value).
//
// Which texels are rounded up follows from x, y and the channel alone, by interleaved gradient noise
// (Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare"), in integers. A
// Gaussian of 1.5 texels leaves an error of 0.03, 0.02 and 0.02 of a step (RMS) in gradients of 1/8, 1/20
// and 1/64 step per texel, no more than with a mask of blue noise, and 0.11, 0.22 and 0.26 without dither.
float round_texel(double value, TexelRounding rounding, std::array<int, 2> texel, int channel);

}  // namespace skybake
