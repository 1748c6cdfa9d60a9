#include "bakers/assets/cloud_light/sky_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/vector_double2.hpp>
#include <numbers>

#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake::cloud_light {
namespace {

constexpr double kHemisphere = 2 * std::numbers::pi;
// Along the cosine and along the azimuth of a part. The light next to the sun is a degree wide.
constexpr int kPoints = 64;

// Directions between two cosines of the zenith angle, within half a width of the azimuth of a vector.
struct Part {
    double low = 0;
    double high = 1;
    glm::dvec2 middle{1, 0};  // a unit vector
    double half_width = std::numbers::pi;
};

// Integrals over a part, divided by its solid angle.
struct PartMeans {
    double radiance = 0;
    double level = 0;  // of radiance times the cosine of the zenith angle
};

PartMeans means_of(const SkyByDirection& sky, const Part& part) {
    static const QuadratureRule rule = gauss_legendre(kPoints);
    PartMeans means;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double up = part.low + (part.high - part.low) * rule.nodes[i];
        const double level = std::sqrt(1 - up * up);
        double ring = 0;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            const SineCosine turn = sine_and_cosine(part.half_width * (2 * rule.nodes[k] - 1));
            const double x = part.middle.x * turn.cosine - part.middle.y * turn.sine;
            const double y = part.middle.y * turn.cosine + part.middle.x * turn.sine;
            ring += rule.weights[k] * sky({level * x, level * y, up});
        }
        means.radiance += rule.weights[i] * ring;
        means.level += rule.weights[i] * up * ring;
    }
    return means;
}

Part part_of(const SkyDirection& ordinate, const std::vector<SkyDirection>& ordinates) {
    double below = 0;
    double ring = 0;
    for (const SkyDirection& other : ordinates) {
        if (other.direction.z == ordinate.direction.z) {
            ring += other.solid_angle;
        } else if (other.direction.z < ordinate.direction.z) {
            below += other.solid_angle;
        }
    }
    const double level = std::sqrt(1 - ordinate.direction.z * ordinate.direction.z);
    return {below / kHemisphere, std::min((below + ring) / kHemisphere, 1.0),
            glm::dvec2(ordinate.direction) / level, std::numbers::pi * ordinate.solid_angle / ring};
}

// Makes the irradiance of a level surface that of the sky: L_n (1 + slope (mu_n - c)), where c is the
// mean of mu_n by light.
void correct_irradiance(double irradiance, const std::vector<SkyDirection>& ordinates,
                        std::vector<double>& radiances) {
    std::array<double, 3> sums{};  // of light times powers of the cosine
    for (std::size_t n = 0; n < ordinates.size(); ++n) {
        double term = radiances[n] * ordinates[n].solid_angle;
        for (double& sum : sums) {
            sum += term;
            term *= ordinates[n].direction.z;
        }
    }
    const double centre = sums[1] / sums[0];
    const double slope = (irradiance - sums[1]) / (sums[2] - centre * sums[1]);
    // Also of black skies, whose slope is not a number.
    if (!(std::fabs(slope) < 1)) return;
    for (std::size_t n = 0; n < ordinates.size(); ++n) {
        radiances[n] *= 1 + slope * (ordinates[n].direction.z - centre);
    }
}

}  // namespace

double mean_radiance(const SkyByDirection& sky) {
    constexpr int kRings = 4;
    constexpr int kAround = 8;
    double sum = 0;
    for (int i = 0; i < kRings * kAround; ++i) {
        const SineCosine azimuth = sine_and_cosine(kHemisphere * (i % kAround + 0.5) / kAround);
        const double low = static_cast<double>(i / kAround) / kRings;
        sum += means_of(sky, {low,
                              low + 1.0 / kRings,
                              {azimuth.cosine, azimuth.sine},
                              std::numbers::pi / kAround})
                   .radiance;
    }
    return sum / (kRings * kAround);
}

std::vector<double> ordinate_radiances(const SkyByDirection& sky,
                                       const std::vector<SkyDirection>& ordinates) {
    std::vector<double> radiances;
    double irradiance = 0;
    for (const SkyDirection& ordinate : ordinates) {
        const PartMeans means = means_of(sky, part_of(ordinate, ordinates));
        radiances.push_back(means.radiance);
        irradiance += means.level * ordinate.solid_angle;
    }
    correct_irradiance(irradiance, ordinates, radiances);
    return radiances;
}

}  // namespace skybake::cloud_light
