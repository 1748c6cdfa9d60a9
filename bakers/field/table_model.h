// The model of a two-dimensional table, for the code that bakes, measures and sizes it: a function
// of two coordinates in [0, 1], given by a kernel and by a reference.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/dither.h"
#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct TableModel {
    int channels = 0;
    TexelConvention convention = TexelConvention::end_points_on_texel_centres;

    // Returns the v at which a runtime looks up y in a table with that many rows. Empty if the
    // convention determines v.
    std::function<double(double y, int rows)> v_of = {};

    // Returns the coordinates nearest to (x, y) at which a probe may lie. Some places are
    // unsuitable: at the horizon, rounding decides what a runtime sees.
    std::function<std::array<double, 2>(double x, double y)> probe_place = {};

    // A table over x alone has one row, whatever accuracy is asked for.
    bool one_row = false;

    // Maps uniform x to the x at which lookups are measured. Empty: they are measured at the
    // uniform x.
    std::function<double(double x)> x_of_point = {};

    // The cost of each quadrature level in evaluations per texel, cheapest level first.
    std::vector<double> cost_per_texel;

    // The kernel: values at coordinates (x[i], y), channels interleaved in values[i * channels +
    // c].
    std::function<void(int level, double y, const std::vector<double>& x, double* values)> row;

    // The reference, in the same form.
    std::function<void(double y, const std::vector<double>& x, double* values)> reference;

    // The smallest and the largest value that physics allows.
    double lowest = 0;
    double highest = 0;

    // Returns the error of a stored or looked-up value. `scale` is the largest reference value of
    // the channel over the points measured.
    std::function<double(double value, double reference, double scale)> error;
};

// The texture coordinates at which a runtime looks up x or y.
double lookup_u(const TableModel& model, double x, int columns);
double lookup_v(const TableModel& model, double y, int rows);

// Returns the texels of a table as its kernel gives them, before rounding. Each row is one tile of
// the work.
Image2<double> bake_texels(const TableModel& model, int level, std::array<int, 2> size,
                           const BakeOptions& options);

// Returns the texels rounded for a file, and counts those that its pixel type holds inaccurately.
// `first` is the place in the table of an image that is a part of it.
Image2<float> store_texels(const Image2<double>& texels, TexelRounding rounding, RangeCounts& range,
                           std::array<int, 2> first = {0, 0});

}  // namespace skybake
