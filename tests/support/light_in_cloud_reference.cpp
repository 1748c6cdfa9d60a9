#include "tests/support/light_in_cloud_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "bakers/assets/forward_scattering/small_angles.h"
#include "bakers/march/cloud_light.h"
#include "bakers/math/harmonics.h"

namespace skybake {
namespace {

double coefficient(const LightInCloud& light, const glm::dvec3& place, std::size_t number) {
    const glm::dvec3 at(place.x * light.cells[0], place.y * light.cells[1],
                        std::clamp(place.z * light.cells[2], 0.5, light.cells[2] - 0.5));
    const glm::dvec3 low = glm::floor(at - 0.5);
    const glm::dvec3 t = at - 0.5 - low;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 next(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 weight = glm::mix(1.0 - t, t, next);
        const glm::dvec3 padded = low + next + 1.0;
        const double row = light.cells[0] + 2;
        const double cell = (padded.z * (light.cells[1] + 2) + padded.y) * row + padded.x;
        if (weight.x * weight.y * weight.z == 0) continue;
        sum += weight.x * weight.y * weight.z *
               double{light.values[static_cast<std::size_t>(cell) * LightInCloud::kAll + number]};
    }
    return sum;
}

double sum_of_harmonics(const LightInCloud& light, const glm::dvec3& direction,
                        const glm::dvec3& place, std::size_t first, std::size_t count) {
    const Harmonics values = harmonics(-direction);
    double sum = 0;
    for (std::size_t c = 0; c < count; ++c) sum += values[c] * coefficient(light, place, first + c);
    return std::max(sum, 0.0);
}

}  // namespace

ReferenceLight reference_light(const LightInCloud& light, const glm::dvec3& direction,
                               double offset, const glm::dvec3& place,
                               const std::array<double, 2>& tau_and_beyond) {
    static const forward_scattering::SmallAngles small(
        cloud_light::scattering_of(droplet_phase(kDropletDiameter_um), 1), 3);
    const auto [tau, beyond] = tau_and_beyond;
    const ScatteringAngle angle{offset, 2 - offset};
    const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
    ReferenceLight found;
    found.sun = small.scattered_once(angle) / light.share * std::exp(-light.share * tau) *
                    small.reference(tau, angle) +
                sum_of_harmonics(light, direction, place, 0, 16) / (1 + (1 - g) * beyond / 2);
    found.sky = sum_of_harmonics(light, direction, place, 16, 4);
    found.ground = sum_of_harmonics(light, direction, place, 20, 4);
    return found;
}

}  // namespace skybake
