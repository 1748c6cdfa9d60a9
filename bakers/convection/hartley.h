// The discrete Hartley transform of planes of real numbers, along x and y.
//
//   H(m, n) = sum over (x, y) of f(x, y) cas(2 pi m x / X) cas(2 pi n y / Y),   cas t = cos t + sin t
//
// (Bracewell 1983, "Discrete Hartley transform"). Applied twice it is X Y times f. Differences of
// neighbours around a circle have cas as eigenvectors, with those eigenvalues that Fourier's waves have,
// so that a Poisson equation falls apart as it does under Fourier's transform, without complex numbers.
//
// Lengths are products of 2, 3 and 5. Columns are transformed side by side, two in one complex sequence, by
// Stockham's method; rows are turned into columns first. Sums have one order, whatever the number of lanes.
#pragma once

#include <vector>

namespace skybake::convection {

// Returns whether a length has no factor but 2, 3 and 5.
bool is_smooth(int length);

class Hartley {
  public:
    // Both lengths must be smooth and even.
    Hartley(int columns, int rows);

    // Room that a call needs. Threads have their own.
    struct Scratch {
        std::vector<float> turned, from, to;
    };
    // Transforms rows() rows of columns() numbers in place. Rows lie closely.
    void transform(float* plane, Scratch& scratch) const;

  private:
    struct Stage {
        int radix = 1;
        int before = 1;                   // product of the radices of earlier stages
        std::vector<float> cosine, sine;  // of the turns of its outputs, [block][output]
    };
    struct Axis {
        int length = 1;
        std::vector<Stage> stages;
    };
    static Axis make_axis(int length);
    static void transform_columns(const Axis& axis, int columns, float* plane, Scratch& scratch);

    Axis x_, y_;
};

}  // namespace skybake::convection
