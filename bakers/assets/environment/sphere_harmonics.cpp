#include "bakers/assets/environment/sphere_harmonics.h"

#include <cmath>
#include <numbers>

namespace skybake {

namespace {

// Calls visit(direction, solid angle, texel) for each texel of a map, row by row.
template <class Visit>
void for_each_texel(const Image2<float>& map, const EnvironmentLayout& layout, const Visit& visit) {
    const auto [columns, rows] = layout.part_size();
    for (int part = 0; part < layout.parts(); ++part) {
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                visit(layout.direction(part, (x + 0.5) / columns, (y + 0.5) / rows),
                      layout.solid_angle(part, x, y), map.texel(x, part * rows + y));
            }
        }
    }
}

}  // namespace

std::array<double, kHarmonics> harmonics_at(const glm::dvec3& direction) {
    const double x = direction.x;
    const double y = direction.z;
    const double z = direction.y;
    const double x2 = x * x, y2 = y * y, z2 = z * z;
    constexpr double kPi = std::numbers::pi;
    const double of_1 = std::sqrt(3 / (4 * kPi));
    const double of_2 = std::sqrt(15 / (4 * kPi));
    const double of_3 = std::sqrt(7 / (16 * kPi));
    const double of_3_1 = std::sqrt(21 / (32 * kPi));
    const double of_3_2 = std::sqrt(105 / (4 * kPi));
    const double of_3_3 = std::sqrt(35 / (32 * kPi));
    const double of_4 = 3 * std::sqrt(1 / (256 * kPi));
    const double of_4_1 = 3 * std::sqrt(5 / (32 * kPi));
    const double of_4_2 = 3 * std::sqrt(5 / (64 * kPi));
    const double of_4_3 = 3 * std::sqrt(35 / (32 * kPi));
    const double of_4_4 = 3 * std::sqrt(35 / (256 * kPi));
    return {std::sqrt(1 / (4 * kPi)),
            of_1 * y,
            of_1 * z,
            of_1 * x,
            of_2 * x * y,
            of_2 * y * z,
            std::sqrt(5 / (16 * kPi)) * (3 * z2 - 1),
            of_2 * x * z,
            0.5 * of_2 * (x2 - y2),
            of_3_3 * y * (3 * x2 - y2),
            of_3_2 * x * y * z,
            of_3_1 * y * (5 * z2 - 1),
            of_3 * z * (5 * z2 - 3),
            of_3_1 * x * (5 * z2 - 1),
            0.5 * of_3_2 * z * (x2 - y2),
            of_3_3 * x * (x2 - 3 * y2),
            4 * of_4_4 * x * y * (x2 - y2),
            of_4_3 * y * z * (3 * x2 - y2),
            2 * of_4_2 * x * y * (7 * z2 - 1),
            of_4_1 * y * z * (7 * z2 - 3),
            of_4 * (35 * z2 * z2 - 30 * z2 + 3),
            of_4_1 * x * z * (7 * z2 - 3),
            of_4_2 * (x2 - y2) * (7 * z2 - 1),
            of_4_3 * x * z * (x2 - 3 * y2),
            of_4_4 * (x2 * x2 - 6 * x2 * y2 + y2 * y2)};
}

std::vector<std::array<double, kHarmonics>> harmonics_of(const Image2<float>& map,
                                                         const EnvironmentLayout& layout) {
    std::vector<std::array<double, kHarmonics>> sums(static_cast<std::size_t>(map.channels));
    for_each_texel(map, layout,
                   [&](const glm::dvec3& direction, double solid_angle, const float* light) {
                       const std::array<double, kHarmonics> values = harmonics_at(direction);
                       for (std::array<double, kHarmonics>& sum : sums) {
                           const double weight = solid_angle * double{*light++};
                           for (std::size_t i = 0; i < kHarmonics; ++i) {
                               sum[i] += weight * values[i];
                           }
                       }
                   });
    return sums;
}

std::vector<double> level_irradiance(const Image2<float>& map, const EnvironmentLayout& layout) {
    std::vector<double> sums(static_cast<std::size_t>(map.channels));
    for_each_texel(map, layout,
                   [&](const glm::dvec3& direction, double solid_angle, const float* light) {
                       if (direction.y <= 0) return;
                       for (double& sum : sums) sum += solid_angle * direction.y * double{*light++};
                   });
    return sums;
}

}  // namespace skybake
