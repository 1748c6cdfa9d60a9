#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bakers/plot/chart.h"
#include "bakers/render/tone_curve.h"

namespace skybake {
namespace {

constexpr int bruneton_slice_width = 256;
constexpr int shown_bruneton_slices = 4;

class BrunetonPictures {
  public:
    explicit BrunetonPictures(const PreviewAsset& asset) : asset_(asset), entry_(asset.entry) {
        const int last = entry_.size[2] - 1;
        for (int i = 0; i < shown_bruneton_slices; ++i) {
            const int z = last * i / (shown_bruneton_slices - 1);
            if (slices_.empty() || z != slices_.back()) slices_.push_back(z);
        }
    }

    std::vector<PreviewPicture> make() const {
        const auto channels = static_cast<int>(entry_.channels.size());
        const int colours = std::min(channels, 3);
        std::vector<PreviewPicture> pictures;
        const std::string light = slices_.size() > 1
                                      ? "by nu and the sun's cosine (across) and the view ray's "
                                        "(up: above the horizon in the upper half)"
                                      : "v upwards";
        pictures.push_back(sheet("", entry_.name, 0, colours, light));
        if (channels == 4) {
            pictures.push_back(sheet("_mie", entry_.name + ": A, the Mie layers", 3, 1, light));
        }
        return pictures;
    }

  private:
    // Returns channels first ... first + count - 1 of slice z, with row 0 at the top.
    Image2<float> colours(int z, int first, int count) const {
        return upwards(slice_of(asset_, z, first, count), 0, entry_.size[1]);
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

    const PreviewAsset& asset_;
    const ManifestAsset& entry_;
    std::vector<int> slices_;
};

}  // namespace

std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset) {
    if (!has_all_texels(asset)) return {};
    return BrunetonPictures(asset).make();
}

}  // namespace skybake
