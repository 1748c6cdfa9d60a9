// Light in a plane slab that scatters isotropically, by the integral equation of its source
// function: a reference that shares nothing with the solver or with paths of light.
//
//   J(t) = w / 4pi F e^(-t / mu_0) + w / 2 integral of E_1(|t - t'|) J(t') dt'
//
// J is linear between nodes; the integrals of E_1 times a linear function are exact. Nodes are
// closest at both ends, where J has logarithmic slopes.
#pragma once

#include <boost/math/special_functions/expint.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace skybake::test {

class IsotropicSlab {
  public:
    // `beam` is the irradiance of a surface that faces the sun.
    IsotropicSlab(double depth, double albedo, double sun_cosine, double beam, int cells = 240)
        : depth_(depth) {
        for (int i = 0; i <= cells; ++i) {
            nodes_.push_back(0.5 * depth *
                             (1 - std::cos(std::numbers::pi * static_cast<double>(i) / cells)));
        }
        const std::size_t n = nodes_.size();
        std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0.0));
        source_.resize(n);
        for (std::size_t row = 0; row < n; ++row) {
            source_[row] =
                albedo / (4 * std::numbers::pi) * beam * std::exp(-nodes_[row] / sun_cosine);
            matrix[row][row] += 1;
            for (std::size_t cell = 0; cell + 1 < n; ++cell) {
                const auto [first, last] = kernel(nodes_[row], nodes_[cell], nodes_[cell + 1]);
                matrix[row][cell] -= 0.5 * albedo * first;
                matrix[row][cell + 1] -= 0.5 * albedo * last;
            }
        }
        solve(matrix);
    }

    // The radiance that leaves the top, or else the bottom, at this cosine to the vertical.
    double leaving(double cosine, bool is_up) const {
        const bool at_bottom = !is_up;
        double sum = 0;
        for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
            const double near = (at_bottom ? depth_ - nodes_[i + 1] : nodes_[i]) / cosine;
            const double far = (at_bottom ? depth_ - nodes_[i] : nodes_[i + 1]) / cosine;
            const double of_near = at_bottom ? source_[i + 1] : source_[i];
            const double of_far = at_bottom ? source_[i] : source_[i + 1];
            const double width = far - near;
            const double whole = -std::expm1(-width);
            // The mean of the distance from the nearer end, over what the cell sends.
            const double share_of_far = (whole - width * std::exp(-width)) / width;
            sum += std::exp(-near) * (whole * of_near + share_of_far * (of_far - of_near));
        }
        return sum;
    }

  private:
    // The integrals of E_1 and of u E_1 from 0 to u.
    static std::pair<double, double> integrals(double u) {
        if (u == 0) return {0, 0};
        const double e2 = boost::math::expint(2, u);
        return {1 - e2, 0.5 - u * e2 - boost::math::expint(3, u)};
    }

    // The integrals of E_1(|t - t'|) over a cell times the hat functions of its ends. A node is
    // never inside a cell.
    static std::pair<double, double> kernel(double at, double begin, double end) {
        const bool is_above = at >= end;
        const double near = is_above ? at - end : begin - at;
        const double far = is_above ? at - begin : end - at;
        const auto [from_zero, from_first] = integrals(near);
        const auto [to_zero, to_first] = integrals(far);
        const double whole = to_zero - from_zero;
        const double of_far = (to_first - from_first - near * whole) / (far - near);
        const double of_near = whole - of_far;
        return is_above ? std::pair{of_far, of_near} : std::pair{of_near, of_far};
    }

    // Gauss's elimination: the matrix's diagonal is the largest of each row.
    void solve(std::vector<std::vector<double>>& matrix) {
        const std::size_t n = source_.size();
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t row = k + 1; row < n; ++row) {
                const double factor = matrix[row][k] / matrix[k][k];
                for (std::size_t j = k; j < n; ++j) matrix[row][j] -= factor * matrix[k][j];
                source_[row] -= factor * source_[k];
            }
        }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t j = k + 1; j < n; ++j) source_[k] -= matrix[k][j] * source_[j];
            source_[k] /= matrix[k][k];
        }
    }

    double depth_;
    std::vector<double> nodes_;
    std::vector<double> source_;
};

}  // namespace skybake::test
