#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/assets/phase/phase_fit.h"
#include "bakers/field/image.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/render/tone_curve.h"
#include "config/assets/phase.h"

namespace skybake {

namespace {

constexpr double degrees = 180 / std::numbers::pi;  // degrees per radian

// The smallest angle, in degrees, on the logarithmic axis. The forward peak of rain is some
// thousandths of a degree wide.
constexpr double smallest_shown_angle = 1e-3;

std::vector<ChartLine> lines_of(const PreviewAsset& asset, double least_angle) {
    const Image2<float>& table = asset.table;
    const auto spacing = spacing_named(asset.entry.mapping);
    std::vector<ChartLine> lines;
    for (std::size_t c = 0; c < asset.entry.channels.size(); ++c) {
        ChartLine line;
        line.name = asset.entry.channels[c];
        line.colour = noise_line_colour(line.name);
        for (int i = 0; i < table.width; ++i) {
            const double x =
                texel_coordinate(TexelConvention::end_points_on_texel_centres, i, table.width);
            const double value = table.texel(i, 0)[c];
            const double at = spacing ? radians(scattering_angle(*spacing, x)) * degrees : x;
            if (at < least_angle) continue;
            line.x.push_back(at);
            line.y.push_back(spacing ? value : radians({value, 2 - value}) * degrees);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;

struct ShownDepth {
    double depth = 0;
    std::array<std::uint8_t, 3> colour{};
};
constexpr ShownDepth kDepths[] = {{0.5, {0x2f, 0x6f, 0xc4}},
                                  {2, {0x2e, 0x8b, 0x57}},
                                  {8, {0xd0, 0x8b, 0x1e}},
                                  {32, {0xc8, 0x3a, 0x32}}};

// The row of texels whose depth is nearest.
int row_of(const Image2<float>& table, double depth) {
    const double y = forward_scattering::depth_coordinate(depth);
    return static_cast<int>(std::lround(y * (table.height - 1)));
}

ChartLine line_of(const Image2<float>& table, const ShownDepth& shown) {
    const int row = row_of(table, shown.depth);
    ChartLine line;
    line.name =
        fmt::format("optical depth {:.3g}",
                    forward_scattering::depth_at(texel_coordinate(kConvention, row, table.height)));
    line.colour = shown.colour;
    for (int i = 0; i < table.width; ++i) {
        const double x = texel_coordinate(kConvention, i, table.width);
        line.x.push_back(radians(forward_scattering::angle_at(x)) * 180 / std::numbers::pi);
        line.y.push_back(double{table.texel(i, row)[0]});
    }
    return line;
}

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

std::vector<PreviewPicture> phase_pictures(const PreviewAsset& asset) {
    const std::string& name = asset.entry.name;
    const bool inverse = asset.entry.mapping == "share";
    if (!inverse && !spacing_named(asset.entry.mapping)) return {};  // of another release
    if (inverse) {
        return {as_plot({name, "Scattering angle by share of light",
                         "The curve shows the angle below which a share of the light is scattered, "
                         "from the file's texels.",
                         line_chart(lines_of(asset, 0), asset.entry.name, "share of the light",
                                    "scattering angle (deg)", false, false)})};
    }
    return {as_plot({name, "Phase function", "The curves show the file's texels.",
                     line_chart(lines_of(asset, 0), asset.entry.name, "scattering angle (deg)",
                                "phase function (1/sr)", false, true)}),
            as_plot({name + "_peak", "Phase function, forward peak",
                     "The same curves over the logarithm of the angle show the forward peak.",
                     line_chart(lines_of(asset, smallest_shown_angle),
                                asset.entry.name + ", forward peak", "scattering angle (deg)",
                                "phase function (1/sr)", true, true)})};
}

std::vector<PreviewPicture> forward_pictures(const PreviewAsset& asset) {
    std::vector<ChartLine> lines;
    for (const ShownDepth& shown : kDepths) lines.push_back(line_of(asset.table, shown));
    return {as_plot(
        {asset.entry.name, "Light that goes on by small angles",
         "The curves show the factor of sunlight that is scattered once, at four optical depths to "
         "the sun, from the file's texels.",
         line_chart(lines, asset.entry.name, "scattering angle (deg)", "factor", false, false)})};
}

std::vector<PreviewPicture> bruneton_pictures(const PreviewAsset& asset) {
    if (!has_all_texels(asset)) return {};
    return BrunetonPictures(asset).make();
}

}  // namespace skybake
