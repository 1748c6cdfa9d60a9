#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/fourier_transform.h"

namespace skybake {
namespace {

constexpr int most_frames = 16;      // whose spectra are averaged
constexpr double few_ranks = 0.125;  // share of the pixels that are shown as points

using ComplexLine = std::vector<std::complex<float>>;

// Waves of about one frequency: the sum of their power, and how many there are.
struct Band {
    double power = 0;
    double count = 0;
};

class BlueNoisePictures {
  public:
    explicit BlueNoisePictures(const PreviewAsset& asset)
        : entry_(asset.entry), volume_(view_of(asset)) {}

    std::vector<PreviewPicture> make() {
        add_frames();
        if (std::min(volume_.size[0], volume_.size[1]) < 8) return std::move(pictures_);
        const Image2<float> power = frame_power();
        add_power(power);
        add_curves(power);
        return std::move(pictures_);
    }

  private:
    void add_frames() {
        const Image2<float> frame = slice(volume_, 0, 2, 0);
        Image2<float> points = frame;
        for (float& value : points.texels) value = double{value} < few_ranks ? 0.0F : 1.0F;
        std::vector<Picture> pictures = {grey(frame), grey(points)};
        std::vector<std::string> captions = {"frame 0", "frame 0, values below 1/8"};
        if (volume_.size[2] > 1) {
            pictures.push_back(grey(slice(volume_, 0, 1, 0)));
            captions.push_back("y = 0: x across, frames up");
        }
        pictures_.push_back(picture_of(
            entry_, "frames", "frames",
            "Black is 0, white is 1. The points keep apart from each other as all values do.",
            contact_sheet(pictures, captions, 3)));
    }

    // Returns the power of each wave in frames, over that of white noise, with the mean in the
    // middle.
    Image2<float> frame_power() const {
        const int width = volume_.size[0];
        const int height = volume_.size[1];
        const int frames = std::min(volume_.size[2], most_frames);
        Image2<float> power(width, height, 1);
        double all = 0;
        for (int i = 0; i < frames; ++i) {
            const std::vector<ComplexLine> columns = transformed(slice(volume_, 0, 2, i));
            for (int x = 0; x < width; ++x) {
                for (int y = 0; y < height; ++y) {
                    if (x == 0 && y == 0) continue;
                    const float of_wave = std::norm(
                        columns[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)]);
                    *power.texel((x + width / 2) % width, (y + height / 2) % height) += of_wave;
                    all += double{of_wave};
                }
            }
        }
        const double mean = all / (double{1} * width * height - 1);
        for (float& value : power.texels) {
            value = static_cast<float>(mean > 0 ? double{value} / mean : 0);
        }
        return power;
    }

    void add_power(const Image2<float>& power) {
        pictures_.push_back(picture_of(
            entry_, "power", "spectrum of frames",
            "The picture shows the power of waves, from none, black, to twice that of white noise, "
            "white. The mean is in the middle, half a cycle per pixel at the edges. Blue noise is "
            "dark in the middle and alike in all directions.",
            grey(power, {0, 2})));
    }

    // Returns the mean power at each frequency up to half a cycle per pixel.
    ChartLine curve_of_frames(const Image2<float>& power) const {
        const auto bands = static_cast<std::size_t>(std::min(power.width, power.height)) / 2;
        std::vector<Band> found(bands + 1);
        for (int y = 0; y < power.height; ++y) {
            for (int x = 0; x < power.width; ++x) {
                const double u = static_cast<double>(x - power.width / 2) / power.width;
                const double v = static_cast<double>(y - power.height / 2) / power.height;
                const double place = 2 * static_cast<double>(bands) * std::hypot(u, v);
                const auto band = static_cast<std::size_t>(std::lround(place));
                if (band == 0 || band > bands) continue;
                found[band].power += double{*power.texel(x, y)};
                ++found[band].count;
            }
        }
        return line_of("within a frame", {0x2f, 0x6f, 0xc4}, found);
    }

    ChartLine curve_over_time() const {
        const int frames = volume_.size[2];
        const auto pixels = static_cast<std::size_t>(volume_.size[0] * volume_.size[1]);
        FourierTransform transform(frames);
        std::vector<Band> found(static_cast<std::size_t>(frames) / 2 + 1);
        ComplexLine line(static_cast<std::size_t>(frames));
        double all = 0;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            for (std::size_t t = 0; t < line.size(); ++t) {
                line[t] = (*volume_.voxels)[t * pixels + pixel];
            }
            transform(line);
            for (std::size_t k = 1; k < line.size(); ++k) {
                const double power = double{std::norm(line[k])};
                all += power;
                if (k >= found.size()) continue;
                found[k].power += power;
                ++found[k].count;
            }
        }
        const double mean = all / (double{1} * static_cast<double>(pixels) * (frames - 1));
        for (Band& band : found) band.power /= mean > 0 ? mean : 1;
        return line_of("over time", {0xc8, 0x3a, 0x32}, found);
    }

    // The bands go up to half a cycle per pixel or frame.
    static ChartLine line_of(const std::string& name, Colour colour,
                             const std::vector<Band>& bands) {
        ChartLine line{name, colour, {}, {}};
        for (std::size_t k = 1; k < bands.size(); ++k) {
            if (bands[k].count == 0) continue;
            line.x.push_back(0.5 * static_cast<double>(k) / static_cast<double>(bands.size() - 1));
            line.y.push_back(bands[k].power / bands[k].count);
        }
        return line;
    }

    void add_curves(const Image2<float>& power) {
        std::vector<ChartLine> lines = {curve_of_frames(power)};
        if (volume_.size[2] >= 4) lines.push_back(curve_over_time());
        lines.push_back({"white noise", {0x8a, 0x8a, 0x8a}, {0, 0.5}, {1, 1}});
        pictures_.push_back(picture_of(
            entry_, "spectrum", "spectrum",
            fmt::format("The curves show the mean power of waves over that of white noise: of {} "
                        "frames, over all directions, and of all pixels over time.",
                        std::min(volume_.size[2], most_frames)),
            line_chart(lines, entry_.name + ": spectrum", "frequency (cycles per pixel or frame)",
                       "power, white noise = 1", false, true)));
        pictures_.back().kind = PictureKind::plot;
    }

    const ManifestAsset& entry_;
    VoxelView volume_;
    std::vector<PreviewPicture> pictures_;
};

}  // namespace

std::vector<PreviewPicture> blue_noise_pictures(const PreviewAsset& asset) {
    if (asset.entry.channels.size() != 1 || !has_all_texels(asset)) return {};
    return BlueNoisePictures(asset).make();
}

}  // namespace skybake
