// Models of tables whose functions are known.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "bakers/field/table_model.h"

namespace skybake::test {

// A function of x and y, from which the kernel of level i is off by off[i]. Each level costs ten times
// as much as the one before.
inline TableModel model_of(std::function<double(double x, double y)> function,
                           std::vector<double> off = {0}) {
    TableModel model;
    model.channels = 1;
    for (std::size_t level = 0; level < off.size(); ++level) {
        model.cost_per_texel.push_back(std::pow(10, level));
    }
    model.highest = 10;
    model.row = [=](int level, double y, const std::vector<double>& x, double* values) {
        for (const double at : x)
            *values++ = function(at, y) + off[static_cast<std::size_t>(level)];
    };
    model.reference = [=](double y, const std::vector<double>& x, double* values) {
        for (const double at : x) *values++ = function(at, y);
    };
    model.error = [](double value, double reference, double) { return value - reference; };
    return model;
}

}  // namespace skybake::test
