#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/assets/phase/phase_fit.h"
#include "bakers/field/image.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {
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
         "The curves show the factor of sunlight that is scattered once, at four "
         "optical depths to the sun, from the file's texels.",
         line_chart(lines, asset.entry.name, "scattering angle (deg)", "factor", false, false)})};
}

}  // namespace skybake
