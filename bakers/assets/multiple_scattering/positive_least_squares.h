// Solves sparse equations by least squares for unknowns that may not be negative. Where equations
// determine unknowns poorly, these are drawn towards 1 and towards their neighbours.
#pragma once

#include <cstddef>
#include <vector>

namespace skybake {

// Each equation states that the sum over its terms of weight * x[unknown] is the target.
struct SparseEquations {
    std::vector<std::size_t> first_term = {0};  // of each equation, and the end of the last
    std::vector<std::size_t> unknowns;          // of each term
    std::vector<double> weights;                // of each term
    std::vector<double> targets;                // of each equation

    std::size_t count() const { return targets.size(); }
    void add_term(std::size_t unknown, double weight) {
        unknowns.push_back(unknown);
        weights.push_back(weight);
    }
    void end_equation(double target) {
        targets.push_back(target);
        first_term.push_back(unknowns.size());
    }
};

struct Restraint {
    struct Link {
        std::size_t first = 0;
        std::size_t second = 0;
        double strength = 0;  // weight of (x[first] - x[second])^2
    };
    std::vector<double> towards_one;  // for each unknown, > 0: weight of (x - 1)^2
    std::vector<Link> links;
};

// Returns the unique x >= 0 that minimises the sum of the squared errors of all equations and of
// the restraint's terms. Unknowns that occur in no equation and no link are 1.
//
// The method is conjugate gradients from x = 1 on the unknowns that are free, restarted whenever
// one reaches 0 (Polyak 1969), until the gradient, in the norm of the inverse diagonal, has fallen
// by `tolerance`.
std::vector<double> positive_least_squares(const SparseEquations& equations,
                                           const Restraint& restraint, double tolerance);

}  // namespace skybake
