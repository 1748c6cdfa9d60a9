#include <fmt/format.h>

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

namespace {

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

}  // namespace

std::vector<PreviewPicture> forward_pictures(const PreviewAsset& asset) {
    std::vector<ChartLine> lines;
    for (const ShownDepth& shown : kDepths) lines.push_back(line_of(asset.table, shown));
    return {as_plot(
        {asset.entry.name, "Light that goes on by small angles",
         "The curves show the factor of sunlight that is scattered once, at four optical depths to "
         "the sun, from the file's texels.",
         line_chart(lines, asset.entry.name, "scattering angle (deg)", "factor", false, false)})};
}

}  // namespace skybake
