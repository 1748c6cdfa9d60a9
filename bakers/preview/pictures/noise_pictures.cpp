#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {
namespace {

constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};

class NoisePictures {
  public:
    explicit NoisePictures(const PreviewAsset& asset)
        : entry_(asset.entry), volume_(view_of(asset)), scale_(scale_of(asset.voxels)) {}

    std::vector<PreviewPicture> make() {
        const bool is_curve = volume_.size[1] == 1 && volume_.size[2] == 1;
        if (entry_.kind == "optical_depth") {
            is_curve ? add_curves() : add_slices();
            return std::move(pictures_);
        }
        add_slices();
        if (entry_.kind == "cloud_light") return std::move(pictures_);
        add_tiles();
        add_histogram();
        return std::move(pictures_);
    }

  private:
    // Returns [0, 1] if it contains all voxels, as for most noises, else the range from the least
    // to the greatest value.
    static GreyScale scale_of(const std::vector<float>& voxels) {
        const auto [least, most] = std::ranges::minmax_element(voxels);
        if (*least >= 0 && *most <= 1) return {};
        if (*least == *most) return {double{*least}, double{*least} + 1};
        return {double{*least}, double{*most}};
    }

    // Names a channel and the plane of a slice: "R, x = 64".
    std::string plane_words(int channel, int axis, int at) const {
        return fmt::format("{}, {} = {}", entry_.channels[static_cast<std::size_t>(channel)],
                           axis_names[static_cast<std::size_t>(axis)], at);
    }

    int middle(int axis) const { return volume_.size[static_cast<std::size_t>(axis)] / 2; }

    void add_slices() {
        const bool may_be_flat = entry_.kind == "optical_depth" || entry_.kind == "cloud_light";
        const bool is_flat = may_be_flat && volume_.size[2] == 1;
        std::vector<Picture> slices;
        std::vector<std::string> captions;
        for (int channel = 0; channel < volume_.channels; ++channel) {
            for (int axis = is_flat ? 2 : 0; axis < 3; ++axis) {
                slices.push_back(grey(slice(volume_, channel, axis, middle(axis)), scale_));
                captions.push_back(plane_words(channel, axis, middle(axis)));
            }
        }
        const std::string planes = is_flat
                                       ? "Each channel is shown with y up. "
                                       : "Each row shows a channel in the middle planes across x, "
                                         "y and z. z is up in the first two, y in the last. ";
        pictures_.push_back(picture_of(entry_, "slices", "slices", planes + scale_words(scale_),
                                       contact_sheet(slices, captions, is_flat ? 2 : 3)));
    }

    // Adds the curves of a table with one axis, over its texture coordinate.
    void add_curves() {
        std::vector<ChartLine> lines;
        for (int channel = 0; channel < volume_.channels; ++channel) {
            const std::string& name = entry_.channels[static_cast<std::size_t>(channel)];
            const Image2<float> texels = slice(volume_, channel, 2, 0);
            ChartLine line{name, noise_line_colour(name), {}, {}};
            for (int i = 0; i < texels.width; ++i) {
                line.x.push_back((i + 0.5) / texels.width);
                line.y.push_back(*texels.texel(i, 0));
            }
            lines.push_back(std::move(line));
        }
        const bool over_decades = entry_.mapping == "phase_functions";
        pictures_.push_back(
            as_plot(picture_of(entry_, "curves", "curves",
                               fmt::format("These are the file's texels: {}.", entry_.content),
                               line_chart(lines, entry_.name, "u", "value", false, over_decades))));
    }

    void add_tiles() {
        std::vector<Picture> tiles;
        std::vector<std::string> captions;
        for (int channel = 0; channel < volume_.channels; ++channel) {
            for (const int axis : {2, 0}) {
                const Image2<float> plane =
                    tiled_twice(slice(volume_, channel, axis, middle(axis)));
                tiles.push_back(grey(plane, scale_, 256, 1024));
                captions.push_back(plane_words(channel, axis, middle(axis)));
            }
        }
        pictures_.push_back(picture_of(
            entry_, "tiled", "two by two tiles",
            fmt::format("The tile is repeated: a seam would show as a line through the middle. The "
                        "measured seam error is {:.3g}. {}",
                        entry_.seam_error, scale_words(scale_)),
            contact_sheet(tiles, captions, 2)));
    }

    void add_histogram() {
        std::vector<ChartLine> lines;
        const std::vector<ValueStatistics>& statistics = entry_.levels.front().statistics;
        for (std::size_t i = 0; i < std::min(statistics.size(), entry_.channels.size()); ++i) {
            lines.push_back(histogram_line(statistics[i], entry_.channels[i]));
        }
        pictures_.push_back(as_plot(picture_of(
            entry_, "histogram", "histogram",
            "The curves show how often each value of a channel occurs; the area below a curve is "
            "the share of voxels.",
            line_chart(lines, entry_.name + ": histogram", "value", "density", false, false))));
    }

    // Returns a line with one step per bin, which goes down to 0 at both ends.
    ChartLine histogram_line(const ValueStatistics& statistics, const std::string& channel) const {
        ChartLine line{fmt::format("{}, mean {:.3f}", channel, statistics.mean),
                       noise_line_colour(channel),
                       {statistics.histogram_range[0]},
                       {0}};
        const auto bins = static_cast<double>(statistics.histogram.size());
        const double width = (statistics.histogram_range[1] - statistics.histogram_range[0]) / bins;
        const double voxels = double{1} * volume_.size[0] * volume_.size[1] * volume_.size[2];
        for (const std::int64_t count : statistics.histogram) {
            const double density = static_cast<double>(count) / (voxels * width);
            const double left = line.x.back();
            line.x.insert(line.x.end(), {left, left + width});
            line.y.insert(line.y.end(), {density, density});
        }
        line.x.push_back(line.x.back());
        line.y.push_back(0);
        return line;
    }

    const ManifestAsset& entry_;
    VoxelView volume_;
    GreyScale scale_;
    std::vector<PreviewPicture> pictures_;
};

// Returns how much of an asset's area has each value, with a step for each bin.
ChartLine steps_of_histogram(const ValueStatistics& statistics, const std::string& channel) {
    ChartLine line{channel, noise_line_colour(channel), {}, {}};
    std::int64_t count = 0;
    for (const std::int64_t of_bin : statistics.histogram) count += of_bin;
    const auto bins = static_cast<double>(statistics.histogram.size());
    for (std::size_t i = 0; i < statistics.histogram.size(); ++i) {
        const double share = static_cast<double>(statistics.histogram[i]) /
                             static_cast<double>(std::max<std::int64_t>(count, 1));
        for (const double edge : {static_cast<double>(i), static_cast<double>(i) + 1}) {
            line.x.push_back(edge / bins);
            line.y.push_back(share);
        }
    }
    return line;
}

}  // namespace

Picture grey(const Image2<float>& whole, const GreyScale& scale, int smallest_edge,
             int longest_edge) {
    const Image2<float> field = fitted(whole, smallest_edge, longest_edge);
    Picture picture(field.width, field.height);
    auto pixel = picture.rgb.begin();
    for (int y = field.height - 1; y >= 0; --y) {
        for (int x = 0; x < field.width; ++x) {
            const double t =
                (double{*field.texel(x, y)} - scale.black) / (scale.white - scale.black);
            const auto byte = static_cast<std::uint8_t>(std::lround(255 * std::clamp(t, 0.0, 1.0)));
            pixel = std::fill_n(pixel, 3, byte);
        }
    }
    return picture;
}

std::string scale_words(const GreyScale& scale) {
    return fmt::format("Black is {:.3g}, white is {:.3g}.", scale.black, scale.white);
}

PreviewPicture picture_of(const ManifestAsset& entry, const std::string& stem,
                          const std::string& title, std::string caption, Picture picture) {
    return {entry.name + "_" + stem, entry.name + ": " + title, std::move(caption),
            std::move(picture)};
}

std::array<std::uint8_t, 3> noise_line_colour(const std::string& channel) {
    if (channel == "R") return {0xc8, 0x3a, 0x32};
    if (channel == "G") return {0x2e, 0x8b, 0x57};
    if (channel == "B") return {0x2f, 0x6f, 0xc4};
    return {0x1f, 0x23, 0x28};
}

std::vector<PreviewPicture> noise_pictures(const PreviewAsset& asset) {
    if (!has_all_texels(asset)) return {};
    return NoisePictures(asset).make();
}

std::vector<PreviewPicture> weather_map_pictures(const PreviewAsset& asset) {
    const Image2<float>& map = asset.table;
    const ManifestAsset& entry = asset.entry;
    if (map.width <= 0 || map.height <= 0 || map.channels <= 0) return {};
    std::vector<Picture> planes, tiles;
    std::vector<std::string> captions;
    std::vector<ChartLine> lines;
    for (std::size_t c = 0; c < entry.channels.size(); ++c) {
        const Image2<float> plane = channel_of(map, c);
        planes.push_back(grey(plane));
        tiles.push_back(grey(tiled_twice(plane)));
        const ValueStatistics& statistics = entry.levels.front().statistics[c];
        captions.push_back(fmt::format("{}, mean {:.3f}", entry.channels[c], statistics.mean));
        lines.push_back(steps_of_histogram(statistics, entry.channels[c]));
    }
    std::vector<PreviewPicture> pictures = {
        picture_of(entry, "channels", "channels",
                   "Each channel is shown with y up. Black is 0, white is 1.",
                   contact_sheet(planes, captions, 2)),
        picture_of(entry, "tiled", "two by two tiles",
                   "The tile is repeated: a seam would show as a line through the middle.",
                   contact_sheet(tiles, captions, 2)),
        picture_of(entry, "histogram", "histogram",
                   "The curves show what share of the texels has each value.",
                   line_chart(lines, entry.name + ": histogram", "value", "share", false, false))};
    pictures.back().kind = PictureKind::plot;
    return pictures;
}

}  // namespace skybake
