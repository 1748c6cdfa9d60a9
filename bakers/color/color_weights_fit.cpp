#include "bakers/color/color_weights_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace skybake {
namespace {

// The weight, in the mean square over samples, of differences from the weights of color_weights: so
// little that it decides only between weights which give the same colours to a thousandth.
constexpr double kRestraint = 1e-3;

// A symmetric, positive matrix by rows, and its solution by Cholesky's method.
class NormalEquations {
  public:
    explicit NormalEquations(std::size_t size) : size_(size), matrix_(size * size), right_(size) {}

    double& at(std::size_t row, std::size_t column) { return matrix_[row * size_ + column]; }
    glm::dvec3& right(std::size_t row) { return right_[row]; }

    std::vector<glm::dvec3> solve() {
        for (std::size_t j = 0; j < size_; ++j) {
            for (std::size_t k = 0; k < j; ++k) at(j, j) -= at(j, k) * at(j, k);
            assert(at(j, j) > 0);
            at(j, j) = std::sqrt(at(j, j));
            for (std::size_t i = j + 1; i < size_; ++i) {
                for (std::size_t k = 0; k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
                at(i, j) /= at(j, j);
            }
        }
        std::vector<glm::dvec3> x = right_;
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= at(i, k) * x[k];
            x[i] /= at(i, i);
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k) x[i] -= at(k, i) * x[k];
            x[i] /= at(i, i);
        }
        return x;
    }

  private:
    std::size_t size_;
    std::vector<double> matrix_;
    std::vector<glm::dvec3> right_;
};

// color_weights of wavelengths in any order. Equal wavelengths share their weight.
std::vector<glm::dvec3> weights_of_lines(std::span<const double> wavelengths_nm,
                                         const ColorTarget& target) {
    std::vector<double> ascending(wavelengths_nm.begin(), wavelengths_nm.end());
    std::ranges::sort(ascending);
    ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
    const std::vector<glm::dvec3> sorted = color_weights(ascending, target);
    std::vector<glm::dvec3> weights;
    for (const double nm : wavelengths_nm) {
        const auto at = std::ranges::lower_bound(ascending, nm);
        const auto alike = std::ranges::count(wavelengths_nm, nm);
        weights.push_back(sorted[static_cast<std::size_t>(at - ascending.begin())] /
                          static_cast<double>(alike));
    }
    return weights;
}

}  // namespace

std::vector<glm::dvec3> fit_color_weights(std::span<const double> wavelengths_nm,
                                          const std::vector<ColorSample>& samples,
                                          const ColorTarget& target) {
    const std::size_t count = wavelengths_nm.size();
    std::vector<glm::dvec3> weights = weights_of_lines(wavelengths_nm, target);
    // The unknowns are what is added to these weights.
    NormalEquations equations(count);
    double squares = 0;
    for (const ColorSample& sample : samples) {
        glm::dvec3 missing = sample.color;
        for (std::size_t i = 0; i < count; ++i) missing -= sample.light[i] * weights[i];
        const double square = sample.weight * sample.weight;
        for (std::size_t i = 0; i < count; ++i) {
            const double light = square * sample.light[i];
            equations.right(i) += light * missing;
            for (std::size_t j = 0; j <= i; ++j) equations.at(i, j) += light * sample.light[j];
            squares += light * sample.light[i];
        }
    }
    if (!(squares > 0)) return weights;
    const double restraint = kRestraint * kRestraint * squares / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) equations.at(i, i) += restraint;
    const std::vector<glm::dvec3> added = equations.solve();
    for (std::size_t i = 0; i < count; ++i) weights[i] += added[i];
    return weights;
}

}  // namespace skybake
