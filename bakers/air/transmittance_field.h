// A table of the transmittance from any point towards the sun, for quadratures that need it a
// million times.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"

namespace skybake {

// True for a planet from whose top of the air the way to the horizon is more than 32 times the air's
// thickness.
bool is_flat_planet(const Shell& shell);

// A table in Bruneton's coordinates (transmittance_mapping.h), in double. Altitude is divided into
// blocks at whose ends the density may change abruptly, so that no interpolation crosses the edge
// of a layer, however thin. Within a block rows are evenly spaced in x_r and interpolated by
// monotone cubics (Fritsch & Carlson 1980), a whole row at a time. Along x_mu the reader
// interpolates linearly.
//
// Columns are evenly spaced in x_mu where the planet is round: the way to the top grows at most
// some ten times from the zenith to the horizon. Over a flat planet it grows hundreds of times, and
// sunlight fades within the first few: there columns are evenly spaced in the fourth root of x_mu.
class TransmittanceField {
  public:
    struct Size {
        int columns = 0;      // a multiple of 8
        int rows = 0;         // of a field with one block
        int least_rows = 13;  // of every block; at least 3
        bool operator==(const Size&) const = default;
    };
    // Blocks lie between neighbours of `altitudes_km`, which ascend from the ground to the top.
    TransmittanceField(const Medium& medium, const std::vector<double>& altitudes_km, Size size,
                       int threads);

    // The row at an altitude is a combination of four stored rows of row_size() numbers:
    //   row[i] = weights[0] values[i] + weights[1] values[i + n]
    //          + weights[2] slopes[i] + weights[3] slopes[i + n],   n = row_size().
    // Channel c at column i is row[i * channels() + c]; x_mu there is i / (columns() - 1), or its
    // fourth power if is_flat().
    struct Row {
        const double* values;
        const double* slopes;
        double weights[4];
    };
    Row row_at(double altitude_km) const;

    // Reads the transmittances at one altitude towards `count` suns with r mu_s = s_km[i], which
    // must not be below the horizon: channel c of sun i is written to values[c * count + i].
    void read(double altitude_km, const double* s_km, int count, double* values) const;

    const Shell& shell() const { return shell_; }
    bool is_flat() const { return is_flat_; }
    int channels() const { return channels_; }
    int columns() const { return columns_; }
    // A row has its columns, copies of the last column for lookups at x_mu = 1, and room for whole
    // vectors.
    int row_size() const { return channels_ * (columns_ + 8); }

  private:
    struct Block {
        double bottom_km;
        double x_begin;  // x_r at its bottom and top
        double x_end;
        int first_row;
        int rows;
    };

    void fill_row(const Medium& medium, double x_r, double* row) const;
    void fill_slopes(const Block& block);

    Shell shell_;
    bool is_flat_ = false;
    int channels_ = 0;
    int columns_ = 0;
    std::vector<Block> blocks_;
    std::vector<double> values_;
    std::vector<double> slopes_;  // their derivatives per row step
};

}  // namespace skybake
