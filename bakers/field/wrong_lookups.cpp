#include "bakers/field/wrong_lookups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skybake {
namespace {

using TextureCoordinates = std::array<double, 3>;

int nearest_texel(double coordinate, int size, bool repeats) {
    // The coordinate is brought into range before it becomes an integer, because a manifest may
    // contain any number.
    const double within = repeats ? coordinate - std::floor(coordinate) : coordinate;
    const double last = size - 1;
    return static_cast<int>(std::clamp(std::floor(within * size), 0.0, last));
}

std::string on_axis(const char* what, std::size_t axis) {
    return fmt::format("{}_{}", what, "uvw"[axis]);
}

TextureCoordinates moved_along(TextureCoordinates uvw, std::size_t axis, double to) {
    uvw[axis] = to;
    return uvw;
}

void add_wrongs_of_axis(const TextureUse& use, std::size_t axis, std::vector<WrongLookup>& wrongs) {
    const double texel = 1.0 / use.size[axis];
    wrongs.push_back({on_axis("flip", axis), false, use, [axis](const TextureCoordinates& uvw) {
                          return moved_along(uvw, axis, 1 - uvw[axis]);
                      }});
    for (const double by : {0.5 * texel, -0.5 * texel}) {
        wrongs.push_back(
            {on_axis("shift", axis), false, use, [axis, by](const TextureCoordinates& uvw) {
                 return moved_along(uvw, axis, uvw[axis] + by);
             }});
    }
    TextureUse wrapped = use;
    wrapped.repeats[axis] = !use.repeats[axis];
    wrongs.push_back(
        {on_axis("wrap", axis), false, wrapped, [](const TextureCoordinates& uvw) { return uvw; }});
    if (use.repeats[axis] || use.size[axis] == 1) return;
    wrongs.push_back(
        {on_axis("ends", axis), false, use, [axis, texel](const TextureCoordinates& uvw) {
             return moved_along(uvw, axis, (uvw[axis] - 0.5 * texel) / (1 - texel));
         }});
}

void add_swap(const TextureUse& use, std::size_t a, std::size_t b,
              std::vector<WrongLookup>& wrongs) {
    wrongs.push_back(
        {fmt::format("swap_{}{}", "uvw"[a], "uvw"[b]), false, use, [a, b](TextureCoordinates uvw) {
             std::swap(uvw[a], uvw[b]);
             return uvw;
         }});
}

}  // namespace

std::array<VoxelTap, 8> lookup_taps(const TextureUse& use, const std::array<double, 3>& uvw) {
    if (!use.nearest) return trilinear_taps(use.size, uvw, use.repeats);
    std::array<VoxelTap, 8> taps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        taps[0].voxel[axis] = nearest_texel(uvw[axis], use.size[axis], use.repeats[axis]);
    }
    taps.fill(taps[0]);
    taps[0].weight = 1;
    return taps;
}

void add_lookup(const ReadableTexture& texture, const TextureUse& use,
                const std::array<double, 3>& uvw, double share, std::vector<double>& sum) {
    const std::array<VoxelTap, 8> taps = lookup_taps(use, uvw);
    std::vector<float> values(8 * texture.channels);
    texture.read(taps, values.data());
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t c = 0; c < texture.channels; ++c) {
            sum[c] += share * taps[i].weight * double{values[i * texture.channels + c]};
        }
    }
}

std::vector<double> look_up(const ReadableTexture& texture,
                            const std::vector<ProbeLookup>& lookups) {
    std::vector<double> sum(texture.channels, 0.0);
    for (const ProbeLookup& lookup : lookups) {
        add_lookup(texture, texture.use, lookup.uvw, lookup.share, sum);
    }
    return sum;
}

std::vector<WrongLookup> wrong_lookups(const TextureUse& use, int dimensions) {
    const auto axes = static_cast<std::size_t>(dimensions);
    std::vector<WrongLookup> wrongs;
    wrongs.push_back({"zeros", true, use, [](const TextureCoordinates& uvw) { return uvw; }});
    for (std::size_t axis = 0; axis < axes; ++axis) add_wrongs_of_axis(use, axis, wrongs);
    for (std::size_t a = 0; a < axes; ++a) {
        for (std::size_t b = a + 1; b < axes; ++b) add_swap(use, a, b, wrongs);
    }
    TextureUse filtered = use;
    filtered.nearest = !use.nearest;
    wrongs.push_back(
        {"filter", false, filtered, [](const TextureCoordinates& uvw) { return uvw; }});
    return wrongs;
}

std::vector<double> look_up_wrongly(const ReadableTexture& texture,
                                    const std::vector<ProbeLookup>& lookups,
                                    const WrongLookup& wrong) {
    std::vector<double> sum(texture.channels, 0.0);
    if (wrong.zeros) return sum;
    for (const ProbeLookup& lookup : lookups) {
        add_lookup(texture, wrong.use, wrong.place(lookup.uvw), lookup.share, sum);
    }
    return sum;
}

}  // namespace skybake
