#include "bakers/occupancy/exact_extremes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace skybake::occupancy {
namespace {

// A sum of doubles without rounding, as parts that do not overlap, from the smallest on: Shewchuk,
// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997, figure
// 6, grow-expansion.
class ExactSum {
  public:
    void add(double value) {
        for (std::size_t i = 0; i < count_; ++i) {
            const double sum = value + parts_[i];
            const double of_part = sum - value;
            parts_[i] = (value - (sum - of_part)) + (parts_[i] - of_part);
            value = sum;
        }
        parts_[count_++] = value;
    }
    // The last part that is not 0 outweighs those before it.
    bool positive() const {
        for (std::size_t i = count_; i-- > 0;) {
            if (parts_[i] != 0) return parts_[i] > 0;
        }
        return false;
    }

  private:
    std::array<double, 9> parts_{};
    std::size_t count_ = 0;
};

// The eight voxels whose mean a node is; some of them equal where it is not at a corner.
using CornerValues = std::array<double, 8>;

double mean(const CornerValues& node) {
    double sum = 0;
    for (const double voxel : node) sum += voxel;
    return sum / 8;
}

// The least float that is not below the mean. `near` is within a unit in its last place.
float mean_rounded_up(const CornerValues& node, float near) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (float candidate : {std::nextafter(near, -infinity), near}) {
        ExactSum above;  // eight times what the mean is above the candidate
        for (const double voxel : node) above.add(voxel);
        above.add(-8 * double{candidate});
        if (!above.positive()) return candidate;
    }
    return std::nextafter(near, infinity);
}

// The indices of the two voxels about each node of an axis: faces lie between two, and a voxel is
// its own neighbour.
using Neighbours = std::array<int, 2>;

template <class Index>
std::vector<Neighbours> nodes_of(int first, int last, const Index& index) {
    std::vector<Neighbours> nodes = {{index(first - 1), index(first)},
                                     {index(last - 1), index(last)}};
    for (int i = first; i < last; ++i) nodes.push_back({index(i), index(i)});
    return nodes;
}

template <class Visit>
void for_each_node(const RowBundle& bundle, int k, const Visit& visit) {
    const int cell = bundle.cell;
    const auto length = static_cast<int>(bundle.length);
    const auto same = [](int i) { return i; };
    const auto along_x = nodes_of(k * cell, std::min((k + 1) * cell, length),
                                  [&](int i) { return (i + length) % length; });
    const auto along_y = nodes_of(1, bundle.height - 1, same);
    const auto along_z = nodes_of(1, bundle.depth - 1, same);
    for (const Neighbours& z : along_z) {
        for (const Neighbours& y : along_y) {
            for (const Neighbours& x : along_x) {
                CornerValues node;
                for (std::size_t i = 0; i < 8; ++i) {
                    node[i] = bundle.at(y[i >> 1 & 1], z[i >> 2]).voxels[x[i & 1]];
                }
                visit(node);
            }
        }
    }
}

}  // namespace

CellExtremes exact_extremes(const RowBundle& bundle, int k, double least, double most) {
    // Voxels are nodes, and a mean of equal ones is exact; so if all nodes came out equal, all
    // voxels about the cell are: means of floats that differ do so by 2^-27 and more, relatively.
    if (least == most) return {rounded_down(least), rounded_up(most)};
    // How far a mean in double may be off: seven additions, each rounded to 2^-53 of a sum of at
    // most eight voxels. Those about the cell are at most 27 times as great as its nodes: beyond a
    // face lies twice the node less the voxel inside, 3 times as much, and so along each axis.
    const double off = 7 * 27 * 0x1p-53 * std::max(std::fabs(least), std::fabs(most));
    CellExtremes extremes{rounded_down(least + 2 * off), rounded_up(most - 2 * off)};
    for_each_node(bundle, k, [&](CornerValues node) {
        const double value = mean(node);
        if (value >= most - 2 * off) {
            extremes.most = std::max(extremes.most, mean_rounded_up(node, rounded_up(value)));
        }
        if (value <= least + 2 * off) {
            for (double& voxel : node) voxel = -voxel;
            extremes.least = std::min(extremes.least, -mean_rounded_up(node, rounded_up(-value)));
        }
    });
    return {extremes.least + 0.0F, extremes.most + 0.0F};
}

}  // namespace skybake::occupancy
