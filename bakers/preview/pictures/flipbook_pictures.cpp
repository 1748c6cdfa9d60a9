#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {
namespace {

constexpr int smallest_cell = 128;  // pixels along the longer edge of a frame
constexpr int largest_cell = 256;
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
        return grey(fitted(slice(volume_, channel, 2, index), smallest_cell, largest_cell), scale_);
    }

    std::string scale_words() const {
        return fmt::format("Black is {:.3g}, white is {:.3g}.", scale_.black, scale_.white);
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
        pictures_.push_back({fmt::format("{}_strip_{}", entry_.name, name_of(channel)),
                             fmt::format("{}: frames of {}", entry_.name, name_of(channel)),
                             scale_words(), contact_sheet(cells, captions, 4)});
    }

    void add_player(int channel) {
        const std::string sequence = fmt::format("{}_frames_{}", entry_.name, name_of(channel));
        const int count = std::min(frames(), most_played);
        for (int index = 0; index < count; ++index) {
            PreviewPicture picture{
                fmt::format("{}_{:04}", sequence, index),
                fmt::format("{}: {} plays", entry_.name, name_of(channel)),
                fmt::format("Frame {} of {}. {}", index, frames(), scale_words()),
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
        pictures_.push_back(
            as_plot({entry_.name + "_changes", entry_.name + ": changes",
                     "The curves show the root mean square of the change from each frame to the "
                     "next one, and from the last one to the first. A jump is a peak.",
                     line_chart(lines, entry_.name + ": changes", "frame",
                                "change to the next frame", false, false)}));
    }

    const ManifestAsset& entry_;
    VoxelView volume_;
    GreyScale scale_;
    std::vector<PreviewPicture> pictures_;
};

}  // namespace

std::vector<PreviewPicture> flipbook_pictures(const PreviewAsset& asset) {
    if (!has_all_texels(asset)) return {};
    return FlipbookPictures(asset).make();
}

}  // namespace skybake
