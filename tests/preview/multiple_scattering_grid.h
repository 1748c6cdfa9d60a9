// Multiple scattering for one sun and one camera, as exactly as a picture can show it: the baker's
// own kernel on a grid that spans just the sun's angles along the rays of that picture.
#pragma once

#include <vector>

#include "bakers/air/medium.h"

namespace skybake::test {

// Psi (1/sr) of multiple_scattering_kernel.h at its eighth level (0.04 % RMS of its converged
// value), on columns evenly spaced in the sun's zenith angle and rows at altitudes thickness * y^2,
// y evenly spaced: closest at the ground. Between them cubics (Catmull & Rom 1974), held between
// the two nearest values, so that they are never negative and do not ring at the terminator.
class MultipleScatteringGrid {
  public:
    struct Size {
        int columns = 0;  // at least 2
        int rows = 0;     // at least 2
    };

    // Angles in radians, the first below the second.
    MultipleScatteringGrid(const Medium& medium, double first_sun_zenith, double last_sun_zenith,
                           Size size, int threads);

    // Beyond the grid's angles the nearest.
    Spectrum at(double altitude_km, double sun_cos_zenith) const;

  private:
    // At a node; beyond the grid's edges the nearest.
    double value(int channel, int column, int row) const;

    double thickness_km_ = 0;
    double first_sun_zenith_ = 0;
    double columns_per_radian_ = 0;
    int channels_ = 0;
    Size size_;
    std::vector<double> psi_;  // row by row, channel by channel, column by column
};

}  // namespace skybake::test
