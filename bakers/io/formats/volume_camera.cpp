#include "bakers/io/formats/volume_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/field/baked.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr double heading = 63 * std::numbers::pi / 180;  // from +x towards +y
constexpr double pitch = 8 * std::numbers::pi / 180;
constexpr double eye_height_m = 2;

}  // namespace

VolumeCamera volume_camera(const Baked& volume) {
    glm::dvec3 half;
    glm::dvec3 center;
    for (glm::length_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        half[a] = volume.voxel_size_m[axis] * volume.levels.front().size[axis] / 2;
        center[a] = volume.minimum_m[axis] + half[a];
    }
    const auto [rise, level] = sine_and_cosine(pitch);
    const auto [left, ahead] = sine_and_cosine(heading);
    const glm::dvec3 forward(level * ahead, level * left, rise);
    const glm::dvec3 right(left, -ahead, 0);
    const glm::dvec3 up = glm::cross(right, forward);
    const double across = camera_width_mm / (2 * camera_focal_length_mm);
    const double upwards = camera_height_mm / (2 * camera_focal_length_mm);
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 to =
            half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double needed = std::max(std::fabs(glm::dot(to, right)) / across,
                                       std::fabs(glm::dot(to, up)) / upwards);
        distance = std::max(distance, needed - glm::dot(to, forward));
    }
    glm::dvec3 position = center - distance * forward;
    position.z = std::max(position.z, eye_height_m);
    return {position, glm::dmat3(right, up, -forward), 2 * (distance + glm::length(half))};
}

}  // namespace skybake
