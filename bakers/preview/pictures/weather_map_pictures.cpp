#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"

namespace skybake {
namespace {

constexpr int smallest_map = 256;  // pixels along the longer edge of a channel
constexpr int largest_map = 512;

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

std::vector<PreviewPicture> weather_map_pictures(const PreviewAsset& asset) {
    const Image2<float>& map = asset.table;
    const ManifestAsset& entry = asset.entry;
    if (map.width <= 0 || map.height <= 0 || map.channels <= 0) return {};
    std::vector<Picture> planes, tiles;
    std::vector<std::string> captions;
    std::vector<ChartLine> lines;
    for (std::size_t c = 0; c < entry.channels.size(); ++c) {
        const Image2<float> plane = channel_of(map, c);
        planes.push_back(grey(fitted(plane, smallest_map, largest_map), {}));
        tiles.push_back(grey(fitted(tiled_twice(plane), smallest_map, largest_map), {}));
        const ValueStatistics& statistics = entry.levels.front().statistics[c];
        captions.push_back(fmt::format("{}, mean {:.3f}", entry.channels[c], statistics.mean));
        lines.push_back(steps_of_histogram(statistics, entry.channels[c]));
    }
    std::vector<PreviewPicture> pictures;
    pictures.push_back({entry.name + "_channels", entry.name + ": channels",
                        "Each channel is shown with y up. Black is 0, white is 1.",
                        contact_sheet(planes, captions, 2)});
    pictures.push_back({entry.name + "_tiled", entry.name + ": two by two tiles",
                        "The tile is repeated: a seam would show as a line through the middle.",
                        contact_sheet(tiles, captions, 2)});
    pictures.push_back(
        {entry.name + "_histogram", entry.name + ": histogram",
         "The curves show what share of the texels has each value.",
         line_chart(lines, entry.name + ": histogram", "value", "share", false, false)});
    pictures.back().kind = PictureKind::plot;
    return pictures;
}

}  // namespace skybake
