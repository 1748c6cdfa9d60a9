#include "bakers/clouds/column_field.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace skybake::cloud {
namespace {

// Centres of `count` columns from `first` on, in tiles.
std::vector<double> centres(int first, int count, int size) {
    std::vector<double> places;
    for (int i = 0; i < count; ++i) places.push_back((first + i + 0.5) / size);
    return places;
}

void fill_maps(const CloudPlan& plan, const std::vector<double>& x, double y, std::size_t row,
               Columns& columns) {
    const std::size_t width = x.size();
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t at = row * width + i;
        double coverage = plan.coverage;
        if (plan.coverage_map) coverage *= plan.coverage_map->at(x[i], y);
        columns.offset[at] = static_cast<float>(coverage - 1);
        if (!plan.type_map) continue;
        const double type = plan.type_map->at(x[i], y);
        columns.second_type[at] = static_cast<float>(std::min(2 * type, 1.0));
        columns.third_type[at] = static_cast<float>(std::max(2 * type - 1, 0.0));
    }
}

}  // namespace

Columns make_columns(const CloudPlan& plan, int first_x, int width, int first_y, int rows) {
    assert(width >= 0 && rows >= 0);
    Columns columns;
    columns.first_x = first_x;
    columns.first_y = first_y;
    columns.width = width;
    columns.rows = rows;
    const std::vector<double> x = centres(first_x, width, plan.size[0]);
    const std::vector<double> y = centres(first_y, rows, plan.size[1]);
    const std::size_t count = x.size() * y.size();
    columns.towers.resize(count);
    columns.offset.resize(count);
    if (plan.type_map) {
        columns.second_type.resize(count);
        columns.third_type.resize(count);
    }
    std::vector<double> sums(x.size());
    for (std::size_t row = 0; row < y.size(); ++row) {
        std::ranges::fill(sums, 0.0);
        plan.towers.add_row(y[row], x, sums.data());
        for (std::size_t i = 0; i < x.size(); ++i) {
            columns.towers[row * x.size() + i] = static_cast<float>(sums[i]);
        }
        fill_maps(plan, x, y[row], row, columns);
    }
    return columns;
}

}  // namespace skybake::cloud
