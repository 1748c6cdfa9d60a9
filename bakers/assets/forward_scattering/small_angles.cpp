#include "bakers/assets/forward_scattering/small_angles.h"

#include <cstddef>
#include <numbers>
#include <utility>

#include "bakers/math/transcendental.h"

namespace skybake::forward_scattering {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

// Moments fall by the factor g of the narrowest lobe from each degree to the next.
std::vector<double> moments_above_rounding(const cloud_light::CloudScattering& scattering) {
    constexpr double kSmallest = 1e-14;
    double power = 1;
    double widest = 0;
    for (const cloud_light::ScatteringLobe& lobe : scattering.lobes) {
        if (lobe.phase.g > widest) widest = lobe.phase.g;
    }
    int degree = 8;
    for (; power > kSmallest; ++degree) power *= widest;
    std::vector<double> moments = moments_of(scattering, degree);
    for (double& moment : moments) moment *= scattering.albedo;
    return moments;
}

}  // namespace

SmallAngles::SmallAngles(cloud_light::CloudScattering scattering, int degree)
    : scattering_(std::move(scattering)),
      degree_(degree),
      moments_(moments_above_rounding(scattering_)),
      peak_(moments_[static_cast<std::size_t>(degree) + 1]) {}

double SmallAngles::scattered_once(const ScatteringAngle& angle) const {
    return scattering_.albedo * phase_value(scattering_, angle.one_minus, angle.one_plus);
}

std::vector<double> SmallAngles::series(double depth) const {
    const double unscattered = peak_ * exponential(-peak_ * depth);
    std::vector<double> terms;
    for (std::size_t l = 0; l < moments_.size(); ++l) {
        const double excess = moments_[l] - peak_;
        const bool is_held = l <= static_cast<std::size_t>(degree_);
        const double passed = is_held ? 1 : exponential(excess * depth);
        terms.push_back((2 * static_cast<double>(l) + 1) * (excess * passed + unscattered));
    }
    return terms;
}

void SmallAngles::factors(double depth, const std::vector<ScatteringAngle>& angles,
                          double* values) const {
    const std::vector<double> terms = series(depth);
    std::vector<double> before(angles.size(), 0.0);
    std::vector<double> legendre(angles.size(), 1.0);
    std::vector<double> sums(angles.size(), 0.0);
    for (std::size_t l = 0; l < terms.size(); ++l) {
        const auto n = static_cast<double>(l);
        const double up = (2 * n + 1) / (n + 1);
        const double down = n / (n + 1);
        for (std::size_t i = 0; i < angles.size(); ++i) {
            sums[i] += terms[l] * legendre[i];
            const double next = up * (1 - angles[i].one_minus) * legendre[i] - down * before[i];
            before[i] = legendre[i];
            legendre[i] = next;
        }
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
        values[i] = sums[i] / (kSphere * scattered_once(angles[i]));
    }
}

double SmallAngles::reference(double depth, const ScatteringAngle& angle) const {
    const std::vector<double> terms = series(depth);
    const double nu = 0.5 * (angle.one_plus - angle.one_minus);
    double above = 0;
    double sum = 0;
    for (std::size_t l = terms.size(); l-- > 0;) {
        const auto n = static_cast<double>(l);
        const double up = (2 * n + 1) / (n + 1) * nu;
        const double down = (n + 1) / (n + 2);
        const double next = terms[l] + up * sum - down * above;
        above = sum;
        sum = next;
    }
    return sum / (kSphere * scattered_once(angle));
}

}  // namespace skybake::forward_scattering
