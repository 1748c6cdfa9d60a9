// What a two-dimensional table is to the code that bakes, measures and sizes it: a function of two
// coordinates in [0, 1], known twice, by its kernel and by a reference.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct TableModel {
    int channels = 0;
    TexelConvention convention = TexelConvention::end_points_on_texel_centres;

    // The v at which a runtime looks up y in a table of so many rows, where that is not what the
    // convention says; else empty.
    std::function<double(double y, int rows)> v_of = {};

    // The nearest coordinates to (x, y) that a probe may have, where some are no good: at the
    // horizon rounding decides what a runtime sees.
    std::function<std::array<double, 2>(double x, double y)> probe_place = {};

    // A table over x alone has one row whatever is asked of its accuracy.
    bool one_row = false;

    // The x of points at which lookups are measured, from uniform ones; empty: these themselves.
    std::function<double(double x)> x_of_point = {};

    // Quadrature levels, cheapest first, by their cost in evaluations per texel.
    std::vector<double> cost_per_texel;

    // The kernel: values at coordinates (x[i], y), channels interleaved in values[i * channels +
    // c].
    std::function<void(int level, double y, const std::vector<double>& x, double* values)> row;

    // The reference, in the same form.
    std::function<void(double y, const std::vector<double>& x, double* values)> reference;

    // The least and the largest value that physics allows.
    double lowest = 0;
    double highest = 0;

    // Error of a stored or looked-up value. `scale` is the largest reference value of the channel
    // over the points measured.
    std::function<double(double value, double reference, double scale)> error;
};

// Texture coordinates of a lookup.
double lookup_u(const TableModel& model, double x, int columns);
double lookup_v(const TableModel& model, double y, int rows);

// Texels of a table as its kernel gives them, before rounding. Tiles are rows.
Image2<double> bake_texels(const TableModel& model, int level, std::array<int, 2> size,
                           const BakeOptions& options);

// The same rounded to the pixel type.
Image2<float> store_texels(const Image2<double>& texels, config::PixelType type,
                           RangeCounts& range);

}  // namespace skybake
