#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "bakers/plot/chart.h"
#include "bakers/render/tone_curve.h"

namespace skybake {
namespace {

constexpr int bruneton_slice_width = 256;
constexpr int shown_bruneton_slices = 4;

class BrunetonPictures {
  public:
    explicit BrunetonPictures(const PreviewAsset& asset)
        : entry_(asset.entry),
          volume_{{entry_.size[0], entry_.size[1], entry_.size[2]},
                  static_cast<int>(entry_.channels.size()),
                  &asset.voxels} {
        const int last = entry_.size[2] - 1;
        for (int i = 0; i < shown_bruneton_slices; ++i) {
            const int z = last * i / (shown_bruneton_slices - 1);
            if (slices_.empty() || z != slices_.back()) slices_.push_back(z);
        }
    }

    std::vector<PreviewPicture> make() const {
        const int colours = std::min(volume_.channels, 3);
        std::vector<PreviewPicture> pictures;
        const std::string light = slices_.size() > 1
                                      ? "by nu and the sun's cosine (across) and the view ray's "
                                        "(up: above the horizon in the upper half)"
                                      : "v upwards";
        pictures.push_back(sheet("", entry_.name, 0, colours, light));
        if (volume_.channels == 4) {
            pictures.push_back(sheet("_mie", entry_.name + ": A, the Mie layers", 3, 1, light));
        }
        return pictures;
    }

  private:
    // Returns channels first ... first + count - 1 of slice z, with row 0 at the top.
    Image2<float> colours(int z, int first, int count) const {
        Image2<float> result(entry_.size[0], entry_.size[1], count);
        for (int c = 0; c < count; ++c) {
            const Image2<float> channel = slice(volume_, first + c, 2, z);
            for (int y = 0; y < result.height; ++y) {
                for (int x = 0; x < result.width; ++x) {
                    result.texel(x, result.height - 1 - y)[c] = *channel.texel(x, y);
                }
            }
        }
        return result;
    }

    // The caption states the altitude of slice z. Because x_r = rho / H, altitudes are roughly
    // proportional to the square of x_r.
    std::string caption(int z) const {
        if (slices_.size() == 1)
            return fmt::format("{} x {} texels", entry_.size[0], entry_.size[1]);
        const double x = static_cast<double>(z) / (entry_.size[2] - 1);
        return fmt::format("slice {}: rho / H = {:.3g}", z, x);
    }

    PreviewPicture sheet(const std::string& suffix, const std::string& title, int first, int count,
                         const std::string& axes) const {
        const double exposure = exposure_for(colours(slices_.front(), first, count));
        std::vector<Picture> pictures;
        std::vector<std::string> captions;
        for (const int z : slices_) {
            pictures.push_back(tone_mapped(
                fitted(colours(z, first, count), bruneton_slice_width, 2 * bruneton_slice_width),
                exposure));
            captions.push_back(caption(z));
        }
        return {entry_.name + suffix, title,
                fmt::format("The picture shows the texels {}; {}.", axes, tone_text(exposure)),
                contact_sheet(pictures, captions, slices_.size() > 1 ? 2 : 1), exposure};
    }

    const ManifestAsset& entry_;
    VoxelView volume_;
    std::vector<int> slices_;
};

}  // namespace

std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset) {
    std::size_t values = asset.entry.channels.size();
    for (const int edge : asset.entry.size) values *= static_cast<std::size_t>(edge);
    if (asset.entry.size.size() != 3 || values == 0 || asset.voxels.size() != values) return {};
    return BrunetonPictures(asset).make();
}

}  // namespace skybake
