// The minimum is told by its gradient: 0 where an unknown is free, upwards where it is 0.
#include "bakers/assets/multiple_scattering/positive_least_squares.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using test::uniform;

struct Problem {
    SparseEquations equations;
    Restraint restraint;
};

Problem random_problem(std::size_t unknowns, int equations) {
    Problem problem;
    for (int i = 0; i < equations; ++i) {
        const int terms = *rc::gen::inRange(1, 6);
        for (int t = 0; t < terms; ++t) {
            problem.equations.add_term(*rc::gen::inRange<std::size_t>(0, unknowns), uniform(0, 1));
        }
        problem.equations.end_equation(uniform(-1, 3));
    }
    for (std::size_t j = 0; j < unknowns; ++j) {
        problem.restraint.towards_one.push_back(test::log_uniform(1e-3, 1));
        if (j > 0) problem.restraint.links.push_back({j - 1, j, test::log_uniform(1e-3, 1)});
    }
    return problem;
}

// Half the gradient, written down anew.
std::vector<double> gradient_at(const Problem& problem, const std::vector<double>& x) {
    std::vector<double> gradient(x.size());
    const SparseEquations& equations = problem.equations;
    for (std::size_t i = 0; i < equations.count(); ++i) {
        double error = -equations.targets[i];
        for (std::size_t t = equations.first_term[i]; t < equations.first_term[i + 1]; ++t) {
            error += equations.weights[t] * x[equations.unknowns[t]];
        }
        for (std::size_t t = equations.first_term[i]; t < equations.first_term[i + 1]; ++t) {
            gradient[equations.unknowns[t]] += equations.weights[t] * error;
        }
    }
    for (std::size_t j = 0; j < x.size(); ++j) {
        gradient[j] += problem.restraint.towards_one[j] * (x[j] - 1);
    }
    for (const Restraint::Link& link : problem.restraint.links) {
        gradient[link.first] += link.strength * (x[link.first] - x[link.second]);
        gradient[link.second] += link.strength * (x[link.second] - x[link.first]);
    }
    return gradient;
}

RC_GTEST_PROP(PositiveLeastSquares, TheGradientTellsTheMinimum, ()) {
    const auto unknowns = *rc::gen::inRange<std::size_t>(1, 30);
    const Problem problem = random_problem(unknowns, *rc::gen::inRange(0, 60));
    const std::vector<double> x =
        positive_least_squares(problem.equations, problem.restraint, 1e-10);
    const std::vector<double> gradient = gradient_at(problem, x);
    for (std::size_t j = 0; j < unknowns; ++j) {
        RC_ASSERT(x[j] >= 0);
        RC_ASSERT(gradient[j] > -1e-7);
        if (x[j] > 0) RC_ASSERT(gradient[j] < 1e-7);
    }
}

TEST(PositiveLeastSquares, UnknownsOfNoEquationStayOne) {
    SparseEquations equations;
    equations.add_term(1, 2.0);
    equations.end_equation(-4);
    const Restraint restraint = {{1e-3, 1e-3, 1e-3}, {{1, 2, 1.0}}};
    const std::vector<double> x = positive_least_squares(equations, restraint, 1e-10);
    EXPECT_EQ(x[0], 1);
    EXPECT_EQ(x[1], 0);  // wants to be -2
    EXPECT_NEAR(x[2], 1e-3 / (1 + 1e-3), 1e-9);
}

}  // namespace
}  // namespace skybake
