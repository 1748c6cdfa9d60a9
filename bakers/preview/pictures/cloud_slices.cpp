#include "bakers/preview/pictures/cloud_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bakers/assets/description/asset_label.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/occupied_cells.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "config/assets/occupancy.h"

namespace skybake {
namespace {

constexpr std::array<const char*, 3> kAxisNames = {"x", "y", "z"};

// Pixels along the longer edge of a slice.
constexpr int kSliceEdge = 768;

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kFrame = {0xe8, 0x8a, 0x1a};  // around occupied cells
constexpr Rgb kNear = {0xd6, 0xe6, 0xf2};   // an empty cell beside an occupied one
constexpr Rgb kFar = {0x1c, 0x4f, 0x8c};    // an empty cell at the greatest distance

// Returns the axes of a slice: across and up.
std::array<std::size_t, 2> axes_of_slice(int axis) {
    if (axis == 0) return {1, 2};
    if (axis == 1) return {0, 2};
    return {0, 1};
}

ChartAxis axis_km(const std::array<double, 3>& extent_m, double base_m, std::size_t axis) {
    if (axis == 2) {
        return linear_axis("altitude (km)", base_m / 1000, (base_m + extent_m[2]) / 1000);
    }
    return linear_axis(fmt::format("{} (km)", kAxisNames[axis]), 0, extent_m[axis] / 1000);
}

std::string place_of(const CloudMedium& medium, int axis, int at) {
    const auto a = static_cast<std::size_t>(axis);
    const double meters = (at + 0.5) * medium.meters_per_voxel(a) + (axis == 2 ? medium.base_m : 0);
    return fmt::format("{} = {:.3g} km", axis == 2 ? "altitude" : kAxisNames[a], meters / 1000);
}

ColourScale scale_of(const Image2<float>& field, std::string title) {
    const auto [least, most] = std::ranges::minmax_element(field.texels);
    const double low = std::min(0.0, double{*least});
    const double high = double{*most} > low ? double{*most} : low + 1;
    return {low, high, false, false, std::move(title), true};
}

// Returns what stored values mean, for the colour bar.
std::string value_title(const CloudMedium& medium) {
    return medium.optics.has_edge ? "value before its threshold" : "density";
}

void fill(Picture& picture, int x0, int x1, int y0, int y1, const Rgb& colour, double share) {
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            std::uint8_t* pixel =
                picture.rgb.data() +
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                 static_cast<std::size_t>(x)) *
                    3;
            for (std::size_t c = 0; c < 3; ++c) {
                pixel[c] = static_cast<std::uint8_t>(
                    std::lround(pixel[c] * (1 - share) + colour[c] * share));
            }
        }
    }
}

void frame(Picture& picture, int x0, int x1, int y0, int y1) {
    fill(picture, x0, x1, y0, std::min(y0 + 1, y1), kFrame, 0.7);
    fill(picture, x0, std::min(x0 + 1, x1), y0, y1, kFrame, 0.7);
}

// Returns a grey picture of the values, enlarged `scale` times, with row 0 at the top.
Picture grey_picture(const Image2<float>& field, double white, int scale) {
    Picture picture(field.width * scale, field.height * scale);
    for (int y = 0; y < field.height; ++y) {
        for (int x = 0; x < field.width; ++x) {
            const double share = std::clamp(double{*field.texel(x, y)} / white, 0.0, 1.0);
            const auto grey = static_cast<std::uint8_t>(std::lround(70 + 185 * share));
            const int row = (field.height - 1 - y) * scale;
            fill(picture, x * scale, (x + 1) * scale, row, row + scale, {grey, grey, grey}, 1);
        }
    }
    return picture;
}

// Returns the colour of an empty cell. It depends on the logarithm of the leap, because most leaps
// are short.
Rgb leap_colour(float leap, float greatest) {
    const double t =
        greatest > 1 ? std::clamp(std::log2(double{leap}) / std::log2(double{greatest}), 0.0, 1.0)
                     : 0.0;
    Rgb colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        colour[c] = static_cast<std::uint8_t>(std::lround(kNear[c] + t * (kFar[c] - kNear[c])));
    }
    return colour;
}

// The meaning of a grid's channel.
struct GridChannel {
    std::string name;
    float scale = 1;  // factor on stored values
    bool is_leap = false;
};

GridChannel grid_channel(const PreviewAsset& grid, const OccupancyBake* bake, std::size_t channel) {
    if (bake == nullptr || channel >= bake->contents.size()) {
        return {grid.entry.channels[channel]};
    }
    const config::OccupancyContent content = bake->contents[channel];
    const bool is_leap = content == config::OccupancyContent::leap;
    return {word_of("occupancy", "contents", content),
            is_leap && occupancy::is_unorm(bake->pixel_type) ? 255.0F : 1.0F, is_leap};
}

// Returns the plane in which the sum of the first channel is greatest; for leaps, least.
int telling_plane(const VoxelView& view, bool is_leap, int axis) {
    int best = 0;
    double most = 0;
    for (int at = 0; at < view.size[static_cast<std::size_t>(axis)]; ++at) {
        const Image2<float> plane = slice(view, 0, axis, at);
        double sum = 0;
        for (const float value : plane.texels) sum += double{is_leap ? -value : value};
        if (at != 0 && sum <= most) continue;
        best = at;
        most = sum;
    }
    return best;
}

PreviewPicture grid_picture(const PreviewAsset& grid, const GridChannel& channel,
                            Image2<float> field, const ChartAxis& across, const ChartAxis& up,
                            int axis, int at) {
    for (float& value : field.texels) value *= channel.scale;
    const char* axis_name = kAxisNames[static_cast<std::size_t>(axis)];
    PreviewPicture picture;
    picture.name = fmt::format("{}_{}_{}", grid.entry.name, channel.name, axis_name);
    picture.title = fmt::format("{}, cells {} = {}", channel.name, axis_name, at);
    picture.caption =
        fmt::format("The picture shows the grid's channel `{}`{}, one square per cell.",
                    channel.name, channel.is_leap ? ", leap distances in cells" : "");
    picture.titled = true;
    picture.picture =
        false_colour_chart(field, scale_of(field, channel.name), picture.title, across, up);
    return picture;
}

}  // namespace

Image2<float> column_optical_depth(const CloudMedium& medium, int threads) {
    const std::array<int, 3>& size = medium.volume.size;
    Image2<float> columns(size[0], size[1], 1);
    const double scale = medium.optics.extinction_per_m * medium.meters_per_voxel(2);
    parallel_for(size[1], threads, [&](int y) {
        for (int x = 0; x < size[0]; ++x) {
            const float* voxel = medium.volume.values.data() + medium.volume.plane() +
                                 (y + 1) * medium.volume.row() + x + 1;
            double sum = 0;
            for (int z = 0; z < size[2]; ++z) {
                sum += density(medium.optics, voxel[z * medium.volume.plane()]);
            }
            *columns.texel(x, y) = static_cast<float>(scale * sum);
        }
    });
    return columns;
}

std::array<int, 3> slice_voxel(const CloudMedium& medium, const Image2<float>& optical_depth) {
    const std::array<int, 3>& size = medium.volume.size;
    const auto deepest = std::ranges::max_element(optical_depth.texels);
    if (*deepest == 0) return {size[0] / 2, size[1] / 2, size[2] / 2};
    const auto column = static_cast<int>(deepest - optical_depth.texels.begin());
    std::array<int, 3> slices = {column % size[0], column / size[0], 0};
    std::int64_t most = -1;
    for (int z = 0; z < size[2]; ++z) {
        const float* plane = medium.volume.values.data() + (z + 1) * medium.volume.plane();
        const auto filled = std::count_if(plane, plane + medium.volume.plane(), [&](float value) {
            return density(medium.optics, value) > 0;
        });
        if (filled > most) slices[2] = z;
        most = std::max<std::int64_t>(most, filled);
    }
    return slices;
}

PreviewPicture optical_depth_picture(const CloudMedium& medium, const std::string& name,
                                     const Image2<float>& optical_depth) {
    const double greatest = double{*std::ranges::max_element(optical_depth.texels)};
    std::int64_t clear = 0;
    Image2<float> shown = optical_depth;
    // The scale spans three decades, because values below a thousandth of the greatest are
    // invisible beside it.
    ColourScale scale{greatest / 1000, greatest, true, false, "optical depth", true};
    if (greatest == 0) scale = {0, 1, false, false, "optical depth", true};
    for (float& depth : shown.texels) {
        if (depth == 0) ++clear;
        depth = std::max(depth, static_cast<float>(scale.low));
    }
    PreviewPicture picture;
    picture.name = name + "_optical_depth";
    picture.title = "Optical depth from above";
    picture.titled = true;
    picture.caption = fmt::format(
        "The picture shows extinction integrated over each column, on a logarithmic scale from "
        "{:.3g} to the maximum, {:.3g}; {:.0f} % of the columns are empty.",
        scale.low, greatest,
        100.0 * static_cast<double>(clear) / static_cast<double>(optical_depth.texels.size()));
    picture.picture =
        false_colour_chart(shown, scale, picture.title, axis_km(medium.extent_m, medium.base_m, 0),
                           axis_km(medium.extent_m, medium.base_m, 1));
    return picture;
}

PreviewPicture slice_picture(const CloudMedium& medium, const PreviewAsset& volume, int axis,
                             int at) {
    const Image2<float> field = slice(view_of(volume), 0, axis, at);
    const auto axes = axes_of_slice(axis);
    PreviewPicture picture;
    picture.name =
        fmt::format("{}_slice_{}", volume.entry.name, kAxisNames[static_cast<std::size_t>(axis)]);
    picture.title = fmt::format("Slice at {}", place_of(medium, axis, at));
    picture.group = "slices";
    picture.tab = place_of(medium, axis, at);
    picture.titled = true;
    picture.caption =
        fmt::format("The picture shows {} as the file stores it, in channel {}.",
                    medium.optics.has_edge ? "the value before its threshold" : "density",
                    volume.entry.channels.front());
    picture.picture =
        false_colour_chart(field, scale_of(field, value_title(medium)), picture.title,
                           axis_km(medium.extent_m, medium.base_m, axes[0]),
                           axis_km(medium.extent_m, medium.base_m, axes[1]), kSliceEdge);
    return picture;
}

PreviewPicture cells_picture(const CloudMedium& medium, const PreviewAsset& volume,
                             const std::string& grid_name, int cell,
                             const std::vector<float>& leaps, int axis, int at) {
    const Image2<float> field = slice(view_of(volume), 0, axis, at);
    const float most = *std::ranges::max_element(field.texels);
    const int scale = std::max(1, kSliceEdge / std::max(field.width, field.height));
    Picture drawn = grey_picture(field, most > 0 ? double{most} : 1.0, scale);

    const std::array<int, 3> cells = occupancy::CellGrid{medium.volume.size, cell}.size();
    const Image2<float> leap = slice({cells, 1, &leaps}, 0, axis, at / cell);
    const float greatest = *std::ranges::max_element(leaps);
    for (int j = 0; j < leap.height; ++j) {
        for (int i = 0; i < leap.width; ++i) {
            const int x0 = i * cell * scale;
            const int x1 = std::min((i + 1) * cell * scale, drawn.width);
            const int y1 = drawn.height - j * cell * scale;
            const int y0 = std::max(drawn.height - (j + 1) * cell * scale, 0);
            const float distance = *leap.texel(i, j);
            if (distance > 0) {
                fill(drawn, x0, x1, y0, y1, leap_colour(distance, greatest), 0.85);
            } else {
                frame(drawn, x0, x1, y0, y1);
            }
        }
    }
    const auto axes = axes_of_slice(axis);
    const auto occupied = std::ranges::count(leaps, 0.0F);
    PreviewPicture picture;
    picture.name =
        fmt::format("{}_cells_{}", grid_name, kAxisNames[static_cast<std::size_t>(axis)]);
    picture.title = fmt::format("Cells at {}", place_of(medium, axis, at));
    picture.titled = true;
    picture.group = "cells";
    picture.tab = place_of(medium, axis, at);
    picture.caption = fmt::format(
        "Cells of {} voxels per edge lie over the {} (grey). Occupied cells, {:.1f} % of all, are "
        "framed; the bluer an empty cell is, the farther a ray may leap from it, up to {:.0f} "
        "cells.",
        cell, value_title(medium),
        100.0 * static_cast<double>(occupied) / static_cast<double>(leaps.size()),
        double{greatest});
    picture.picture = framed(drawn, picture.title, axis_km(medium.extent_m, medium.base_m, axes[0]),
                             axis_km(medium.extent_m, medium.base_m, axes[1]));
    return picture;
}

std::vector<PreviewPicture> grid_pictures(const PreviewAsset& grid, const OccupancyBake* bake,
                                          const Cloud* cloud, bool draft) {
    std::vector<PreviewPicture> pictures;
    const VoxelView view = view_of(grid);
    const auto chart_axis = [&](std::size_t a) {
        if (cloud == nullptr) {
            return linear_axis(fmt::format("{} (cells)", kAxisNames[a]), 0, view.size[a]);
        }
        std::array<double, 3> extent_m{};
        for (std::size_t i = 0; i < 3; ++i) extent_m[i] = cloud->extent[i].meters;
        return axis_km(extent_m, cloud->base_altitude.meters, a);
    };
    const bool leaps_first = grid_channel(grid, bake, 0).is_leap;
    const std::size_t shown = draft ? 1 : grid.entry.channels.size();
    for (const int axis : {1, 2}) {
        const int at = telling_plane(view, leaps_first, axis);
        const auto axes = axes_of_slice(axis);
        for (std::size_t channel = 0; channel < shown; ++channel) {
            pictures.push_back(grid_picture(grid, grid_channel(grid, bake, channel),
                                            slice(view, static_cast<int>(channel), axis, at),
                                            chart_axis(axes[0]), chart_axis(axes[1]), axis, at));
        }
    }
    return pictures;
}

}  // namespace skybake
