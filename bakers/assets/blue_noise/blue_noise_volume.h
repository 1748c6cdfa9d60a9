// The asset blue_noise: the ranks of void and cluster as values between 0 and 1.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bakers/math/bake_options.h"
#include "config/assets/blue_noise.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// Returns the value of rank `rank` of `pixels`. A unorm type with codes 0 to m has the code
// floor((m + 1) rank / pixels), so that each code is as frequent as any other, but for one pixel;
// other types have (rank + 1/2) / pixels.
float mask_value(std::uint32_t rank, std::size_t pixels, PixelType type);

// Fills all of `volume` except its name and parameters. Neither a value nor diagnostics follow an
// interruption. Returns E0407 if the probes of a tiny mask cannot detect a wrong file.
Outcome<Baked> bake_blue_noise(const config::BlueNoiseBake& bake, const BakeOptions& options,
                               Baked volume);

}  // namespace skybake
