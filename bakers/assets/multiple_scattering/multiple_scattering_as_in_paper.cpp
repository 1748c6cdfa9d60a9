#include "bakers/assets/multiple_scattering/multiple_scattering_as_in_paper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/interpolation.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental-inl.h"

namespace skybake {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = 256;
constexpr int kHeight = 64;
constexpr int kSquareRootOfDirections = 8;
constexpr int kSteps = 20;
constexpr double kSampleInStep = 0.3;
constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;

// z is up, and the sun in the xz plane.
const std::vector<glm::dvec3>& directions() {
    static const std::vector<glm::dvec3> all = [] {
        std::vector<glm::dvec3> result;
        for (int i = 0; i < kSquareRootOfDirections; ++i) {
            for (int j = 0; j < kSquareRootOfDirections; ++j) {
                const double turn = (i + 0.5) / kSquareRootOfDirections;
                const double cosine = 1 - 2 * (j + 0.5) / kSquareRootOfDirections;
                const double sine = std::sqrt(1 - cosine * cosine);
                // sin(2 pi t) = cos(2 pi t - pi / 2); both arguments folded into [0, 1] half turns.
                const auto cosine_of_turn = [](double t) {
                    const double folded = std::fabs(t - std::floor(t + 0.5));
                    return HWY_NAMESPACE::cosine_of_pi(2 * folded);
                };
                result.emplace_back(sine * cosine_of_turn(turn), sine * cosine_of_turn(turn - 0.25),
                                    cosine);
            }
        }
        return result;
    }();
    return all;
}

}  // namespace

Image2<float> as_in_paper_transmittance(const Medium& medium, int threads) {
    const Shell shell = shell_of(medium);
    Image2<float> table(kWidth, kHeight, medium.channels);
    parallel_for(kHeight, threads, [&](int y) {
        for (int x = 0; x < kWidth; ++x) {
            const TransmittanceRay ray =
                transmittance_ray(shell, {texel_coordinate(kConvention, x, kWidth),
                                          texel_coordinate(kConvention, y, kHeight)});
            const Spectrum depth = optical_depth_to_top(medium, ray.altitude_km, ray.s_km);
            for (int c = 0; c < medium.channels; ++c) {
                table.texel(x, y)[c] = static_cast<float>(
                    HWY_NAMESPACE::exponential(-depth[static_cast<std::size_t>(c)]));
            }
        }
    });
    return table;
}

Spectrum multiple_scattering_as_in_paper(const Medium& medium, const Image2<float>& transmittance,
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
                const double passed = HWY_NAMESPACE::exponential(-extinction * dt);
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

}  // namespace skybake
