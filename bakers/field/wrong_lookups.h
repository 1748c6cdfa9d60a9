// Lookups that a runtime makes of a texture: the right one, and the wrong ones that it makes of a
// file whose axes are reversed, swapped or shifted, or that was never filled.
//
// A wrong file gives plausible pictures. Probes (choose_probes.h) are useful only if each of these
// lookups differs from the right one at some of them.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/interpolation.h"

namespace skybake {

// How a texture is filtered. A table is a texture of one slice.
struct TextureUse {
    std::array<int, 3> size{1, 1, 1};
    std::array<bool, 3> repeats{};  // other axes are clamped
    bool nearest = false;           // instead of linear
};

// Returns the texels of a lookup at texture coordinates, with their weights. In a nearest lookup,
// all eight taps are the same texel and the first has the weight 1.
std::array<VoxelTap, 8> lookup_taps(const TextureUse& use, const std::array<double, 3>& uvw);

// Writes the values of eight texels, as a file holds them, to values[tap * channels + channel]. Any
// thread may call it.
using TexelReader = std::function<void(const std::array<VoxelTap, 8>& taps, float* values)>;

// A texture whose texels can be read.
struct ReadableTexture {
    TextureUse use;
    std::size_t channels = 0;
    TexelReader read;
};

// Adds the lookup at texture coordinates, times `share`, to `sum`, one value per channel.
void add_lookup(const ReadableTexture& texture, const TextureUse& use,
                const std::array<double, 3>& uvw, double share, std::vector<double>& sum);

// A filtered lookup, and its weight if a value is blended from several lookups.
struct ProbeLookup {
    std::array<double, 3> uvw{};
    double share = 1;
};

// Returns the result of the right lookups, one value per channel.
std::vector<double> look_up(const ReadableTexture& texture,
                            const std::vector<ProbeLookup>& lookups);

// A way in which a lookup goes wrong. Manifests list them by these names:
//
//   zeros            every texel is 0
//   flip_u, ...      the axis is reversed
//   swap_uv, ...     two axes are exchanged
//   shift_u, ...     shifted by half a texel, once to each side: two entries of this name
//   wrap_u, ...      clamped where it should repeat, or repeated where it should be clamped
//   ends_u, ...      0 and 1 taken for the edges of the texture in place of the centres of the
//                    outer texels
//   filter           the nearest texel in place of a linear lookup, or the other way about
struct WrongLookup {
    std::string name;
    bool zeros = false;
    TextureUse use;
    std::function<std::array<double, 3>(const std::array<double, 3>& uvw)> place;
};

// Returns the wrong lookups that are possible for a texture of two or three dimensions.
std::vector<WrongLookup> wrong_lookups(const TextureUse& use, int dimensions);

// Probes are said to catch a wrong lookup if it shows at this many of them or more.
inline constexpr int kSeveralProbes = 3;

// Returns the result of a wrong lookup that is made in place of the right ones.
std::vector<double> look_up_wrongly(const ReadableTexture& texture,
                                    const std::vector<ProbeLookup>& lookups,
                                    const WrongLookup& wrong);

}  // namespace skybake
