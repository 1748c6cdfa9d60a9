// Hillaire's multiple scattering by the quadrature of the paper and of its sample: a referee of the converged
// value, and the baseline of its speed.
//
// It uses 64 directions, uniform over the sphere, and 20 steps each, evaluated at 0.3 of a step,
// with sunlight from a bilinear lookup of a 256x64 transmittance table ("A Scalable and Production
// Ready Sky and Atmosphere Rendering Technique", EGSR 2020, section 5.5).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/image.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/table_model.h"
#include "config/assets/transmittance.h"

namespace skybake::as_in_paper {

inline constexpr double kPi = std::numbers::pi;
inline constexpr int kWidth = 256;
inline constexpr int kHeight = 64;
inline constexpr int kSquareRootOfDirections = 8;
inline constexpr int kSteps = 20;
inline constexpr double kSampleInStep = 0.3;
inline constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;

// z is up, and the sun in the xz plane.
inline const std::vector<glm::dvec3>& directions() {
    static const std::vector<glm::dvec3> all = [] {
        std::vector<glm::dvec3> result;
        for (int i = 0; i < kSquareRootOfDirections; ++i) {
            for (int j = 0; j < kSquareRootOfDirections; ++j) {
                const double turn = (i + 0.5) / kSquareRootOfDirections;
                const double cosine = 1 - 2 * (j + 0.5) / kSquareRootOfDirections;
                const double sine = std::sqrt(1 - cosine * cosine);
                result.emplace_back(sine * std::cos(2 * kPi * turn),
                                    sine * std::sin(2 * kPi * turn), cosine);
            }
        }
        return result;
    }();
    return all;
}

// Makes the transmittance table that the method reads, in Bruneton's mapping.
inline Image2<float> transmittance(const Medium& medium) {
    RangeCounts range;
    return store_texels(
        bake_texels(transmittance_model(medium, {}), 0, {kWidth, kHeight}, {.threads = 1}),
        config::PixelType::float32, range);
}

// Returns Psi (1/sr) at an altitude for one sun, computed as the paper describes.
inline Spectrum multiple_scattering(const Medium& medium, const Image2<float>& transmittance,
                                    double altitude_km, double sun_cos_zenith) {
    const Shell shell = shell_of(medium);
    const auto channels = static_cast<std::size_t>(medium.channels);
    const glm::dvec3 start = {0, 0, shell.ground_radius_km + altitude_km};
    const double sun_sin = std::sqrt(std::max(0.0, 1 - sun_cos_zenith * sun_cos_zenith));
    const glm::dvec3 sun = {sun_sin, 0, sun_cos_zenith};

    const auto sunlight = [&](const glm::dvec3& p, double altitude) {
        Spectrum result{};
        const double s = glm::dot(p, sun);
        if (s < -horizon_distance_km(shell, altitude)) return result;
        const double r = shell.ground_radius_km + altitude;
        const UnitCoordinates at = transmittance_coordinates(shell, altitude, s / r);
        bilinear(transmittance, texture_coordinate(kConvention, at.x_mu, kWidth),
                 texture_coordinate(kConvention, at.x_r, kHeight), data(result));
        return result;
    };

    Spectrum second_order{};
    Spectrum scattered{};
    for (const glm::dvec3& direction : directions()) {
        const double s = start.z * direction.z;
        const bool hits_ground =
            s < -horizon_distance_km(shell, altitude_km) || (altitude_km == 0 && s < 0);
        const double length = hits_ground ? distance_to_ground_km(shell, altitude_km, s)
                                          : distance_to_top_km(shell, altitude_km, s);
        Spectrum throughput(1.0);
        double t = 0;
        for (int step = 0; step < kSteps; ++step) {
            const double next = length * (step + kSampleInStep) / kSteps;
            const double dt = next - t;
            t = next;
            const glm::dvec3 p = start + t * direction;
            const double altitude =
                std::clamp(altitude_along_km(shell, altitude_km, s, t), 0.0, shell.thickness_km);
            const Coefficients at = coefficients_at(medium, altitude);
            const Spectrum light = sunlight(p, altitude);
            for (std::size_t c = 0; c < channels; ++c) {
                const double extinction = at.extinction_per_km[c];
                if (!(extinction > 0)) continue;
                const double passed = std::exp(-extinction * dt);
                const double share =
                    throughput[c] * at.scattering_per_km[c] * (1 - passed) / extinction;
                scattered[c] += share;
                second_order[c] += share * light[c] / (4 * kPi);
                throughput[c] *= passed;
            }
        }
        if (hits_ground) {
            const glm::dvec3 p = start + length * direction;
            const double cosine = glm::dot(p, sun) / shell.ground_radius_km;
            const Spectrum light = sunlight(p, 0);
            second_order += throughput * light * std::max(0.0, cosine) * medium.ground_albedo / kPi;
        }
    }
    const auto count = static_cast<double>(directions().size());
    return second_order / count / (1.0 - scattered / count);
}

}  // namespace skybake::as_in_paper
