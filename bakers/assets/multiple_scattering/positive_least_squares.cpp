#include "bakers/assets/multiple_scattering/positive_least_squares.h"

#include <algorithm>
#include <cassert>

namespace skybake {

namespace {

// A fit of a sky takes about a hundred. More come only of unknowns that meet 0 one after the other,
// and x is a good answer at every step.
constexpr int kMostSteps = 600;

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// The left sides of all equations.
Vector left_sides(const SparseEquations& equations, const Vector& x) {
    Vector result(equations.count());
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t t = equations.first_term[i]; t < equations.first_term[i + 1]; ++t) {
            result[i] += equations.weights[t] * x[equations.unknowns[t]];
        }
    }
    return result;
}

// Half the gradient, for the equations' errors and what x is above 1.
Vector half_gradient(const SparseEquations& equations, const Restraint& restraint,
                     const Vector& errors, const Vector& above_one) {
    Vector result(above_one.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        for (std::size_t t = equations.first_term[i]; t < equations.first_term[i + 1]; ++t) {
            result[equations.unknowns[t]] += equations.weights[t] * errors[i];
        }
    }
    for (std::size_t j = 0; j < result.size(); ++j) {
        result[j] += restraint.towards_one[j] * above_one[j];
    }
    for (const Restraint::Link& link : restraint.links) {
        const double pull = link.strength * (above_one[link.first] - above_one[link.second]);
        result[link.first] += pull;
        result[link.second] -= pull;
    }
    return result;
}

// Returns the diagonal of that gradient's matrix.
Vector diagonal_of(const SparseEquations& equations, const Restraint& restraint) {
    Vector result = restraint.towards_one;
    for (std::size_t t = 0; t < equations.weights.size(); ++t) {
        result[equations.unknowns[t]] += equations.weights[t] * equations.weights[t];
    }
    for (const Restraint::Link& link : restraint.links) {
        result[link.first] += link.strength;
        result[link.second] += link.strength;
    }
    return result;
}

}  // namespace

std::vector<double> positive_least_squares(const SparseEquations& equations,
                                           const Restraint& restraint, double tolerance) {
    assert(equations.first_term.size() == equations.count() + 1);
    assert(equations.weights.size() == equations.unknowns.size());
    const std::size_t size = restraint.towards_one.size();
    const Vector diagonal = diagonal_of(equations, restraint);
    Vector above_one(size);  // x - 1, so that what is drawn to 1 alone stays there exactly
    Vector errors = left_sides(equations, Vector(size, 1.0));
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= equations.targets[i];
    Vector scaled(size);
    Vector direction(size);
    double first_square = 0;
    double square_before = 0;  // 0 where directions begin anew
    for (int step = 0; step < kMostSteps; ++step) {
        Vector down = half_gradient(equations, restraint, errors, above_one);
        for (std::size_t j = 0; j < size; ++j) {
            const bool held = above_one[j] <= -1 && down[j] >= 0;
            down[j] = held ? 0 : -down[j];
            scaled[j] = down[j] / diagonal[j];
        }
        const double square = dot(down, scaled);
        if (step == 0) first_square = square;
        if (square <= tolerance * tolerance * first_square) break;
        const double kept = square_before > 0 ? square / square_before : 0;
        for (std::size_t j = 0; j < size; ++j) {
            direction[j] = down[j] == 0 ? 0 : scaled[j] + kept * direction[j];
        }
        const Vector gains = left_sides(equations, direction);
        const Vector bend = half_gradient(equations, restraint, gains, direction);
        double length = dot(down, direction) / dot(bend, direction);
        std::size_t met = size;
        for (std::size_t j = 0; j < size; ++j) {
            if (1 + above_one[j] + length * direction[j] >= 0) continue;
            length = (1 + above_one[j]) / -direction[j];
            met = j;
        }
        for (std::size_t j = 0; j < size; ++j) {
            above_one[j] = std::max(above_one[j] + length * direction[j], -1.0);  // rounding
        }
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i] += length * gains[i];
        square_before = met < size ? 0 : square;
        if (met < size) above_one[met] = -1;
    }
    Vector x(size);
    for (std::size_t j = 0; j < size; ++j) x[j] = 1 + above_one[j];
    return x;
}

}  // namespace skybake
