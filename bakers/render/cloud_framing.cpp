#include "bakers/render/cloud_framing.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace skybake {
namespace {

constexpr double kField = 50;
// A camera that is asked for stands no lower than the eyes of somebody on the ground, and one that is
// chosen no lower than a hill, from where the ground does not hide the distance.
constexpr double kLowest_m = 2;
constexpr double kHill_m = 100;
// The share of the picture's width or height that a framed box fills.
constexpr double kFilled = 0.9;
// The share of the greatest value below which voxels do not count for the framing, because they are
// hardly visible.
constexpr float kFaint = 0.05F;

// Places the camera below the layer if the layer is so high that its nearest clouds are some voxels
// away, else above it.
void place_under_layer(const CloudMedium& medium, CloudCamera& camera) {
    const double tile = std::max(medium.extent_m[0], medium.extent_m[1]);
    const bool from_below = medium.base_m >= 0.1 * tile;
    const double below_m = std::max(medium.base_m - 0.25 * tile, kHill_m);
    const double top_m = medium.base_m + medium.extent_m[2];
    camera.position_m = {0.31 * medium.extent_m[0], 0.12 * medium.extent_m[1],
                         from_below ? below_m : top_m + 0.15 * tile};
    camera.elevation_degrees = from_below ? 12 : -9;
}

std::array<glm::dvec3, 8> corners_of(const CloudBox& box) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
            corners[i][a] = (i >> a & 1) != 0 ? box.high_m[a] : box.low_m[a];
        }
    }
    return corners;
}

// Returns a position on the camera's axis through the box's middle, so far back that all corners
// are within the share kFilled of the picture.
glm::dvec3 position_before(const CloudBox& box, const CloudCamera& camera,
                           double height_over_width) {
    const glm::dvec3 forward = direction_of(camera.elevation_degrees, camera.azimuth_degrees);
    const glm::dvec3 right = direction_of(0, camera.azimuth_degrees - 90);
    const glm::dvec3 up = direction_of(camera.elevation_degrees + 90, camera.azimuth_degrees);
    const double half = camera.horizontal_field_degrees / 2;
    const double half_width = kFilled * sine_of_degrees(half) / cosine_of_degrees(half);
    const glm::dvec3 middle = 0.5 * (box.low_m + box.high_m);
    double back = 0;
    for (const glm::dvec3& corner : corners_of(box)) {
        const glm::dvec3 from_middle = corner - middle;
        const double across = std::fabs(glm::dot(from_middle, right)) / half_width;
        const double upwards =
            std::fabs(glm::dot(from_middle, up)) / (half_width * height_over_width);
        back = std::max(back, std::max(across, upwards) - glm::dot(from_middle, forward));
    }
    return middle - back * forward;
}

// Places the camera a little below the box, so that the cloud stands against the sky, unless the
// ground is in the way.
void place_before_box(const CloudBox& box, const CameraRequest& request, double height_over_width,
                      CloudCamera& camera) {
    camera.elevation_degrees = request.pitch_degrees.value_or(8);
    camera.position_m = position_before(box, camera, height_over_width);
    if (camera.position_m[2] >= kHill_m || request.pitch_degrees) return;
    camera.elevation_degrees = -8;
    camera.position_m = position_before(box, camera, height_over_width);
}

double farthest_corner_m(const CloudBox& box, const glm::dvec3& from) {
    double farthest = 0;
    for (const glm::dvec3& corner : corners_of(box)) {
        const glm::dvec3 way = corner - from;
        farthest = std::max(farthest, std::sqrt(glm::dot(way, way)));
    }
    return farthest;
}

CloudBox tile_box(const CloudMedium& medium) {
    return {{0, 0, medium.base_m},
            {medium.extent_m[0], medium.extent_m[1], medium.base_m + medium.extent_m[2]}};
}

CloudCamera camera_for(const CloudMedium& medium, const CameraRequest& request,
                       double height_over_width) {
    CloudCamera camera;
    camera.azimuth_degrees = request.heading_degrees.value_or(kHeading);
    camera.horizontal_field_degrees = request.field_degrees.value_or(kField);
    if (medium.repeats) {
        place_under_layer(medium, camera);
    } else {
        const CloudBox box = request.whole_tile ? tile_box(medium) : occupied_box(medium);
        place_before_box(box, request, height_over_width, camera);
    }
    camera.elevation_degrees = request.pitch_degrees.value_or(camera.elevation_degrees);
    if (request.position_m) {
        const auto& [x, y, z] = *request.position_m;
        camera.position_m = {x, y, z};
    }
    camera.position_m[2] = std::max(camera.position_m[2], request.position_m ? kLowest_m : kHill_m);
    return camera;
}

double reach_m(const CloudMedium& medium, const CloudCamera& camera) {
    if (!medium.repeats) {
        return farthest_corner_m(tile_box(medium), camera.position_m);
    }
    return reach_m_from(medium, camera.position_m.z);
}

std::string kilometers(double meters) { return fmt::format("{:.4g}km", meters / 1000); }

}  // namespace

CloudBox occupied_box(const CloudMedium& medium) {
    const std::array<int, 3>& size = medium.volume.size;
    const AlignedFloats& values = medium.volume.values;
    const float greatest = *std::ranges::max_element(values);
    const float faint = std::max(medium.visible_above, kFaint * greatest);
    std::array<int, 3> low = size;
    std::array<int, 3> high{};
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            const float* row =
                values.data() + (z + 1) * medium.volume.plane() + (y + 1) * medium.volume.row() + 1;
            for (int x = 0; x < size[0]; ++x) {
                if (!(row[x] > faint)) continue;
                const std::array<int, 3> at = {x, y, z};
                for (std::size_t a = 0; a < 3; ++a) {
                    low[a] = std::min(low[a], at[a]);
                    high[a] = std::max(high[a], at[a] + 1);
                }
            }
        }
    }
    if (high[0] == 0) {
        low = {};
        high = size;
    }
    CloudBox box;
    for (std::size_t a = 0; a < 3; ++a) {
        const double origin = a == 2 ? medium.base_m : 0;
        box.low_m[a] = origin + low[a] * medium.meters_per_voxel(a);
        box.high_m[a] = origin + high[a] * medium.meters_per_voxel(a);
    }
    return box;
}

CloudViewSettings framed_view(const CloudMedium& medium, const SunDirection& sun, int width,
                              int height, const CameraRequest& request) {
    CloudViewSettings settings;
    settings.width = width;
    settings.height = height;
    settings.sun = sun;
    const MarchSteps steps = picture_steps(medium, sun);
    settings.step_m = steps.step_m;
    settings.light_step_m = steps.light_step_m;
    settings.camera = camera_for(medium, request, static_cast<double>(height) / width);
    settings.reach_m = reach_m(medium, settings.camera);
    return settings;
}

FramedScene framed_scene(const std::vector<const CloudMedium*>& media, const SunDirection& sun,
                         int width, int height, const CameraRequest& request) {
    FramedScene scene;
    const CloudMedium* lowest = nullptr;
    for (const CloudMedium* medium : media) {
        const CloudViewSettings settings = framed_view(*medium, sun, width, height, request);
        scene.layers.push_back(
            {medium, settings.step_m, settings.light_step_m, settings.reach_m, kLightGrowth});
        if (lowest != nullptr && lowest->base_m <= medium->base_m) continue;
        lowest = medium;
        scene.camera = settings.camera;
    }
    return scene;
}

std::vector<CloudViewSettings> turntable_views(const CloudMedium& medium, const SunDirection& sun,
                                               int width, int height, const CameraRequest& request,
                                               int count) {
    CloudViewSettings settings = framed_view(medium, sun, width, height, request);
    const CloudBox box = occupied_box(medium);
    const glm::dvec3 middle = 0.5 * (box.low_m + box.high_m);
    double turned = 0;  // of the first view against the camera
    if (!request.position_m) {
        // The box that holds the cloud in any turn is seen from its side.
        const glm::dvec3 half = 0.5 * (box.high_m - box.low_m);
        const double radius = std::sqrt(half.x * half.x + half.y * half.y);
        const glm::dvec3 reach(radius, radius, half.z);
        turned = settings.camera.azimuth_degrees;
        settings.camera.azimuth_degrees = 0;
        place_before_box({middle - reach, middle + reach}, request,
                         static_cast<double>(height) / width, settings.camera);
        settings.camera.position_m.z = std::max(settings.camera.position_m.z, kHill_m);
    }
    const CloudCamera first = settings.camera;
    const glm::dvec3 offset = first.position_m - middle;
    std::vector<CloudViewSettings> views;
    for (int i = 0; i < count; ++i) {
        const double turn = std::remainder(turned + 360.0 * i / count, 360.0);
        const double c = cosine_of_degrees(turn);
        const double s = sine_of_degrees(turn);
        settings.camera.azimuth_degrees = first.azimuth_degrees + turn;
        settings.camera.position_m =
            middle + glm::dvec3(c * offset.x - s * offset.y, s * offset.x + c * offset.y, offset.z);
        settings.reach_m = reach_m(medium, settings.camera);
        views.push_back(settings);
    }
    return views;
}

std::string camera_text(const CloudCamera& camera) {
    return fmt::format("position={},{},{} heading={:.4g}deg pitch={:.4g}deg fov={:.4g}deg",
                       kilometers(camera.position_m[0]), kilometers(camera.position_m[1]),
                       kilometers(camera.position_m[2]), camera.azimuth_degrees,
                       camera.elevation_degrees, camera.horizontal_field_degrees);
}

}  // namespace skybake
