// Removes the divergence of a velocity field, exactly on its grid.
//
// The pressure p solves D G p = D u with the divergence D and the gradient G of the grid itself, so that
// u - G p has no divergence but rounding (Chorin 1968, "Numerical solution of the Navier-Stokes equations").
// Along x and y the equation falls apart under Hartley's transform; along z each of its waves has a
// tridiagonal system with walls at both ends.
#pragma once

#include <vector>

#include "bakers/convection/grid.h"
#include "bakers/convection/hartley.h"

namespace skybake::convection {

class Projection {
  public:
    explicit Projection(const Grid& grid);
    // The vertical velocity must be 0 at level 0.
    void project(std::array<Field, 3>& velocity, int threads);

  private:
    float* plane(int z) { return values_.data() + static_cast<std::size_t>(z) * area_; }
    void set_divergence(const std::array<Field, 3>& velocity, int z);
    void solve_columns(int y);
    void solve_mean_column();
    void subtract_gradient(std::array<Field, 3>& velocity, int z);

    Grid grid_;
    Hartley hartley_;
    std::size_t area_;
    std::vector<float> values_;   // of a level: the divergence, its transform, the pressure
    std::vector<float> factors_;  // of the eliminations
    std::array<std::vector<float>, 2> eigenvalues_;  // of second differences, 1/m2
};

}  // namespace skybake::convection
