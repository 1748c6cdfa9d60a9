// The transmittance from any point towards the sun, for quadratures that need it a million times.
#pragma once

#include <vector>

#include "bakers/atmosphere/medium.h"
#include "bakers/atmosphere/ray.h"

namespace skybake {

// A table in Bruneton's coordinates (transmittance_mapping.h), in double. Along x_r it is read by
// monotone cubics (Fritsch & Carlson 1980), which never leave the range of their neighbours, a
// whole row at a time; along x_mu the reader interpolates linearly.
class TransmittanceField {
  public:
    struct Size {
        int columns = 0;  // a multiple of 8
        int rows = 0;
    };

    explicit TransmittanceField(const Medium& medium, Size size, int threads);

    // The row at an altitude is a combination of four stored ones of row_size() numbers:
    //   row[i] = weights[0] values[i] + weights[1] values[i + n] + weights[2] slopes[i] +
    //   weights[3] slopes[i + n],
    // n = row_size(). Channel c at x_mu = i / (columns() - 1) is row[c * row_stride() + i].
    struct Row {
        const double* values;
        const double* slopes;
        double weights[4];
    };
    Row row_at(double altitude_km) const;

    const Shell& shell() const { return shell_; }
    int channels() const { return channels_; }

    int columns() const { return size_.columns; }
    // A channel's row has a copy of its last column for lookups at x_mu = 1, and room for whole
    // vectors.
    int row_stride() const { return size_.columns + 8; }
    int row_size() const { return channels_ * row_stride(); }

  private:
    Shell shell_;
    int channels_ = 0;
    Size size_;
    std::vector<double> values_;  // size_.rows rows
    std::vector<double> slopes_;  // their derivative per row step
};

}  // namespace skybake
