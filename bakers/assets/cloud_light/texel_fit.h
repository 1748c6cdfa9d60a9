// The texels whose trilinear lookups come nearest to values at places that are finer than the texels.
//
// Point samples of a rough function, or means of it, make poor texels: lookups between them miss its
// peaks. The texels t here are those of least squares: with the weights A of a lookup at each place,
//
//   sum over places of (A t - value)^2 is least,   A^T A t = A^T values
//
// Places and texels are grids, so that A is a product of one matrix per axis, and the solution is
// found along one axis after the other. A place lies between two texels, so A^T A has three
// diagonals, and two corners where the axis repeats.
//
// Beside jumps such a fit overshoots. `bounds` are what the values can be by their nature, and texels
// beyond them are set to the nearest bound.
#pragma once

#include <array>
#include <vector>

namespace skybake::cloud_light {

// One axis: places i at (i + 1/2) / places and texels j at (j + 1/2) / texels of its length. There are
// at least as many places as texels.
class AxisFit {
  public:
    AxisFit(int places, int texels, bool repeats);

    // Finds the texels of a line of values, one for each place.
    void solve(const std::vector<double>& values, std::vector<double>& texels) const;

  private:
    struct Lookup {
        int low = 0;
        int high = 0;
        double share = 0;  // of the texel `high`
    };
    void factor();
    void substitute(std::vector<double>& values) const;

    int texels_ = 1;
    bool same_ = false;  // places are the texels' own
    std::vector<Lookup> lookups_;
    std::vector<double> diagonal_;
    std::vector<double> beside_;  // between texels i and i + 1
    double corner_ = 0;           // between the first and the last
    std::vector<double> factors_;
    std::vector<double> wrap_;  // the solution that the corner adds, by Sherman and Morrison
    double wrap_scale_ = 0;
};

// Fits all axes. Values and texels are x fastest; x and y repeat.
std::vector<float> fit_texels(const std::vector<float>& values, const std::array<int, 3>& places,
                              const std::array<int, 3>& texels, const std::array<float, 2>& bounds,
                              int threads);

}  // namespace skybake::cloud_light
