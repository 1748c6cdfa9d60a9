#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "bakers/math/facts.h"
#include "bakers/plot/chart.h"
#include "bakers/plot/false_colours.h"
#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {

namespace {

// The file says what its texels are of, in metres for the texels 0 and 1.
struct DistancePictures {
    const PreviewAsset& asset;
    std::array<double, 2> metres;
    VoxelView view;

    explicit DistancePictures(const PreviewAsset& of)
        : asset(of), metres{number("metres_at_0"), number("metres_at_1")}, view(view_of(of)) {}

    double number(const char* name) const {
        return number_named(asset.entry.details, name).value_or(0);
    }

    ChartAxis axis_of(std::size_t a) const {
        const AxisMapping& axis = asset.entry.axes[a];
        return linear_axis(fmt::format("{} (km)", std::array{"x", "y", "altitude"}[a]),
                           axis.first / 1000, axis.last / 1000);
    }

    PreviewPicture picture(int axis) const {
        const int at = view.size[static_cast<std::size_t>(axis)] / 2;
        Image2<float> field = slice(view, 0, axis, at);
        for (float& value : field.texels) {
            value = static_cast<float>(metres[0] + double{value} * (metres[1] - metres[0]));
        }
        const auto [least, most] = std::ranges::minmax_element(field.texels);
        const double end = std::max({1.0, -double{*least}, double{*most}});
        const char* name = axis == 1 ? "y" : "z";
        PreviewPicture picture;
        picture.name = fmt::format("{}_distance_{}", asset.entry.name, name);
        picture.title = fmt::format("{}: distance, texels {} = {}", asset.entry.name, name, at);
        picture.caption =
            "The picture shows how far a ray may go on, in metres, red; within the cloud, blue, "
            "how far it is at least to its surface; and white where neither is known to be more "
            "than 0.";
        picture.kind = PictureKind::plot;
        picture.picture = false_colour_chart(field, {-end, end, false, true, "distance (m)"},
                                             picture.title, axis_of(0), axis_of(axis == 1 ? 2 : 1));
        return picture;
    }

    PreviewPicture field_picture(int channel) const {
        const int at = view.size[1] / 2;
        const std::string& letter = asset.entry.channels[static_cast<std::size_t>(channel)];
        PreviewPicture picture;
        picture.name = fmt::format("{}_{}_y", asset.entry.name, letter);
        picture.title = fmt::format("{}: {}, texels y = {}", asset.entry.name, letter, at);
        picture.caption = fmt::format("The picture shows the channel {}.", letter);
        picture.kind = PictureKind::plot;
        picture.picture =
            false_colour_chart(slice(view, channel, 1, at), {0, 1, false, false, letter},
                               picture.title, axis_of(0), axis_of(2));
        return picture;
    }
};

constexpr int most_cells = 12;    // of the strip
constexpr int most_played = 240;  // frames that a page plays

class FlipbookPictures {
  public:
    explicit FlipbookPictures(const PreviewAsset& asset)
        : entry_(asset.entry), volume_(view_of(asset)) {
        const auto [least, most] = std::ranges::minmax_element(asset.voxels);
        const bool is_usual = *least >= 0 && *most <= 1;
        if (!is_usual && *least < *most) scale_ = {double{*least}, double{*most}};
    }

    std::vector<PreviewPicture> make() {
        for (int channel = 0; channel < volume_.channels; ++channel) {
            add_strip(channel);
            add_player(channel);
        }
        if (frames() > 1) add_changes();
        return std::move(pictures_);
    }

  private:
    int frames() const { return volume_.size[2]; }

    std::string name_of(int channel) const {
        return entry_.channels[static_cast<std::size_t>(channel)];
    }

    Picture frame(int channel, int index) const {
        return grey(slice(volume_, channel, 2, index), scale_, 128, 256);
    }

    void add_strip(int channel) {
        const int count = std::min(frames(), most_cells);
        std::vector<Picture> cells;
        std::vector<std::string> captions;
        for (int i = 0; i < count; ++i) {
            const int index = static_cast<int>(std::int64_t{i} * frames() / count);
            cells.push_back(frame(channel, index));
            captions.push_back(fmt::format("frame {}", index));
        }
        pictures_.push_back(picture_of(entry_, "strip_" + name_of(channel),
                                       "frames of " + name_of(channel), scale_words(scale_),
                                       contact_sheet(cells, captions, 4)));
    }

    void add_player(int channel) {
        const std::string sequence = fmt::format("{}_frames_{}", entry_.name, name_of(channel));
        const int count = std::min(frames(), most_played);
        for (int index = 0; index < count; ++index) {
            PreviewPicture picture{
                fmt::format("{}_{:04}", sequence, index),
                fmt::format("{}: {} plays", entry_.name, name_of(channel)),
                fmt::format("Frame {} of {}. {}", index, frames(), scale_words(scale_)),
                frame(channel, index)};
            picture.sequence = sequence;
            pictures_.push_back(std::move(picture));
        }
    }

    // The root mean square of what changes from a frame to the next one.
    double change_after(int channel, int index) const {
        const Image2<float> here = slice(volume_, channel, 2, index);
        const Image2<float> next = slice(volume_, channel, 2, (index + 1) % frames());
        double sum = 0;
        for (std::size_t i = 0; i < here.texels.size(); ++i) {
            const double change = double{next.texels[i]} - double{here.texels[i]};
            sum += change * change;
        }
        return std::sqrt(sum / static_cast<double>(here.texels.size()));
    }

    void add_changes() {
        std::vector<ChartLine> lines;
        for (int channel = 0; channel < volume_.channels; ++channel) {
            ChartLine line{name_of(channel), noise_line_colour(name_of(channel)), {}, {}};
            for (int index = 0; index < frames(); ++index) {
                line.x.push_back(index);
                line.y.push_back(change_after(channel, index));
            }
            lines.push_back(std::move(line));
        }
        pictures_.push_back(as_plot(
            picture_of(entry_, "changes", "changes",
                       "The curves show the root mean square of the change from each frame to the "
                       "next one, and from the last one to the first. A jump is a peak.",
                       line_chart(lines, entry_.name + ": changes", "frame",
                                  "change to the next frame", false, false))));
    }

    const ManifestAsset& entry_;
    VoxelView volume_;
    GreyScale scale_;
    std::vector<PreviewPicture> pictures_;
};

}  // namespace

std::vector<PreviewPicture> distance_pictures(const PreviewAsset& asset) {
    const DistancePictures pictures(asset);
    std::vector<PreviewPicture> all = {pictures.picture(1), pictures.picture(2)};
    for (int channel = 1; channel < pictures.view.channels; ++channel) {
        all.push_back(pictures.field_picture(channel));
    }
    return all;
}

std::vector<PreviewPicture> flipbook_pictures(const PreviewAsset& asset) {
    if (!has_all_texels(asset)) return {};
    return FlipbookPictures(asset).make();
}

}  // namespace skybake
