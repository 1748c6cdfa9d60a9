#include "bakers/assets/cloud_light/hemisphere_harmonics.h"

#include <cmath>
#include <numbers>

#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake::cloud_light {
namespace {

using Matrix = std::vector<std::vector<double>>;

// Solves the symmetric, positive definite system in place, by Cholesky's factors.
void factor(Matrix& matrix) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
        for (std::size_t i = j; i < matrix.size(); ++i) {
            double sum = matrix[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
            matrix[i][j] = i == j ? std::sqrt(sum) : sum / matrix[j][j];
        }
    }
}

void solve(const Matrix& factors, Harmonics& values) {
    const std::size_t count = factors.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < i; ++k) values[i] -= factors[i][k] * values[k];
        values[i] /= factors[i][i];
    }
    for (std::size_t i = count; i-- > 0;) {
        for (std::size_t k = i + 1; k < count; ++k) values[i] -= factors[k][i] * values[k];
        values[i] /= factors[i][i];
    }
}

}  // namespace

std::vector<SkyDirection> sky_directions(int zenith, int around) {
    const QuadratureRule rule = gauss_legendre(zenith);
    std::vector<SkyDirection> directions;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double up = rule.nodes[i];
        const double level = std::sqrt(1 - up * up);
        for (int k = 0; k < around; ++k) {
            const SineCosine azimuth = sine_and_cosine(2 * std::numbers::pi * (k + 0.5) / around);
            directions.push_back({{level * azimuth.cosine, level * azimuth.sine, up},
                                  2 * std::numbers::pi * rule.weights[i] / around});
        }
    }
    return directions;
}

CoefficientWeights projection_weights(const std::vector<SkyDirection>& directions) {
    CoefficientWeights weights;
    for (const SkyDirection& sky : directions) {
        Harmonics values = harmonics(sky.direction);
        for (double& value : values) value *= sky.solid_angle;
        weights.push_back(values);
    }
    return weights;
}

CoefficientWeights hemisphere_fit_weights(const std::vector<SkyDirection>& directions, int degree) {
    CoefficientWeights weights = projection_weights(directions);
    const auto count = static_cast<std::size_t>((degree + 1) * (degree + 1));
    Matrix gram(count, std::vector<double>(count, 0));
    for (std::size_t n = 0; n < directions.size(); ++n) {
        const Harmonics values = harmonics(directions[n].direction);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) gram[i][j] += weights[n][i] * values[j];
        }
    }
    factor(gram);
    for (Harmonics& values : weights) {
        for (std::size_t i = count; i < values.size(); ++i) values[i] = 0;
        solve(gram, values);
    }
    return weights;
}

}  // namespace skybake::cloud_light
