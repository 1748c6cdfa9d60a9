#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

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
        return {fmt::format("{} (km)", std::array{"x", "y", "altitude"}[a]),
                [first = axis.first / 1000, last = axis.last / 1000](double t) {
                    return first + t * (last - first);
                }};
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

}  // namespace

std::vector<PreviewPicture> distance_pictures(const PreviewAsset& asset) {
    const DistancePictures pictures(asset);
    std::vector<PreviewPicture> all = {pictures.picture(1), pictures.picture(2)};
    for (int channel = 1; channel < pictures.view.channels; ++channel) {
        all.push_back(pictures.field_picture(channel));
    }
    return all;
}

}  // namespace skybake
