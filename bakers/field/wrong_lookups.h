// The lookups that a runtime makes of a texture: the right one, and those that it makes of a file
// with its axes turned round, swapped or shifted, or of one that was never filled.
//
// A wrong file gives plausible pictures. Probes (choose_probes.h) are worth something only where
// each of these lookups differs from the right one.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/field/interpolation.h"

namespace skybake {

// How a texture is filtered. A table is a texture of one slice.
struct TextureUse {
    std::array<int, 3> size{1, 1, 1};
    std::array<bool, 3> repeats{};  // axes that do not are clamped
    bool nearest = false;           // in place of linear
};

// The texels of a lookup at texture coordinates, and their weights. All eight taps are the same
// texel where the nearest one is taken, the first with the weight 1.
std::array<VoxelTap, 8> lookup_taps(const TextureUse& use, const std::array<double, 3>& uvw);

// Writes the values of eight texels as a file holds them to values[tap * channels + channel]. Any
// thread may ask.
using TexelReader = std::function<void(const std::array<VoxelTap, 8>& taps, float* values)>;

// A texture whose texels can be asked for.
struct ReadableTexture {
    TextureUse use;
    std::size_t channels = 0;
    TexelReader read;
};

// The texels of an image, which must outlive it; its axes are clamped.
ReadableTexture readable_texture(const Image2<float>& image);

// Adds `share` of the values at texture coordinates to `sum`, one per channel.
void add_lookup(const ReadableTexture& texture, const TextureUse& use,
                const std::array<double, 3>& uvw, double share, std::vector<double>& sum);

// A filtered lookup, and its share where a value is blended from several.
struct ProbeLookup {
    std::array<double, 3> uvw{};
    double share = 1;
};

// What the right lookups find, one value per channel.
std::vector<double> look_up(const ReadableTexture& texture,
                            const std::vector<ProbeLookup>& lookups);

// A way in which a lookup goes wrong. In a manifest's list:
//
//   zeros            every texel is 0
//   flip_u, ...      the axis runs backwards
//   swap_uv, ...     two axes are exchanged
//   shift_u, ...     half a texel off, to one side or the other: two entries of this name
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

// Those that a texture of two or three dimensions can suffer.
std::vector<WrongLookup> wrong_lookups(const TextureUse& use, int dimensions);

// At how many probes or more a wrong lookup shows that they are said to catch.
inline constexpr int kSeveralProbes = 3;

// What a wrong lookup finds in place of the right ones.
std::vector<double> look_up_wrongly(const ReadableTexture& texture,
                                    const std::vector<ProbeLookup>& lookups,
                                    const WrongLookup& wrong);

}  // namespace skybake
