// Assets as textures of CalcMySky, which Stellarium's ShowMySky loads: the sizes as 16-bit numbers, then
// four 32-bit floats per texel, little-endian. Channels that the asset lacks are 0.
//
//   a table, or a volume of one slice   two sizes: width, height
//   a volume with sub-images along u    four sizes: those of v, of the sub-images, of u in each of them
//     (Bruneton's tables of scattering) and of w; texels in that order, v fastest
//   any other volume                    four sizes: width, height, 1, depth
//
// So Bruneton's axes (nu and the sun's cosine, the view's cosine, altitude) become CalcMySky's (the
// view's cosine, nu, the sun's cosine, altitude). Texels are moved and not changed.
//
// Source: CalcMySky 0.3, `saveTexture` and `AtmosphereRenderer::loadTexture4D`.
#pragma once

#include "bakers/io/formats/format.h"

namespace skybake {

Format f32_format();

}  // namespace skybake
