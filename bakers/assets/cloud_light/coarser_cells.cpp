#include "bakers/assets/cloud_light/coarser_cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/math/wrapped.h"

namespace skybake::cloud_light {
namespace {

std::array<int, 3> coarser_size(const std::array<int, 3>& size, const CellFactors& factors) {
    std::array<int, 3> coarser{};
    for (std::size_t a = 0; a < 3; ++a) coarser[a] = (size[a] + factors[a] - 1) / factors[a];
    return coarser;
}

// Calls use(k, j) for the rows of cells within those of the coarser row y of plane z.
template <class Use>
void for_rows_within(const std::array<int, 3>& size, const CellFactors& factors, int z, int y,
                     const Use& use) {
    for (int k = z * factors[2]; k < std::min((z + 1) * factors[2], size[2]); ++k) {
        for (int j = y * factors[1]; j < (y + 1) * factors[1]; ++j) use(k, j);
    }
}

// Adds values, times their weights if there are any, to the sums of coarser cells.
void add_row(const float* values, const float* weights, int factor, std::vector<double>& sums) {
    std::size_t i = 0;
    for (double& sum : sums) {
        for (int k = 0; k < factor; ++k, ++i) {
            sum += weights == nullptr ? double{values[i]} : double{values[i]} * double{weights[i]};
        }
    }
}

// Two coarser cells and the weight of the second.
struct Between {
    int first = 0;
    int second = 0;
    float weight = 0;
};

Between between(int cell, int factor, int coarse, bool repeats) {
    const double at = (cell + 0.5) / factor - 0.5;
    const double below = std::floor(at);
    const int first = static_cast<int>(below);
    const auto kept = [&](int i) {
        return repeats ? wrapped(i, coarse) : std::clamp(i, 0, coarse - 1);
    };
    return {kept(first), kept(first + 1), static_cast<float>(at - below)};
}

}  // namespace

CellFactors coarser_factors(const std::array<int, 3>& size) {
    CellFactors factors = kSameCells;
    for (std::size_t a = 0; a < 2; ++a) {
        for (const int factor : {5, 3, 2}) {
            if (size[a] % factor == 0 && size[a] > factor) factors[a] = factor;
        }
    }
    if (size[2] > 2) factors[2] = 2;
    return factors;
}

LayerCells coarser_cells(const LayerCells& cells, const CellFactors& factors) {
    const std::array<int, 3>& from = cells.extinction.size();
    const std::array<int, 3> to = coarser_size(from, factors);
    LayerCells coarser{CellFields(to, 1), cells.edge_m};
    for (std::size_t a = 0; a < 3; ++a) coarser.edge_m[a] *= factors[a];
    const int together = factors[0] * factors[1] * factors[2];
    for (int z = 0; z < to[2]; ++z) {
        for (int y = 0; y < to[1]; ++y) {
            std::vector<double> sums(static_cast<std::size_t>(to[0]));
            for_rows_within(from, factors, z, y, [&](int k, int j) {
                add_row(cells.extinction.row(0, k, j), nullptr, factors[0], sums);
            });
            float* row = coarser.extinction.row(0, z, y);
            for (const double sum : sums) *row++ = static_cast<float>(sum / together);
        }
    }
    return coarser;
}

CellFields mean_light(const CellFields& light, const CellFields& extinction,
                      const CellFactors& factors, const BakeOptions& options) {
    CellFields mean(coarser_size(light.size(), factors), light.count());
    for_each_plane(mean, options, [&](int z) {
        std::vector<double> sums(static_cast<std::size_t>(mean.size()[0]));
        std::vector<double> weights = sums;
        for (int y = 0; y < mean.size()[1]; ++y) {
            std::ranges::fill(weights, 0.0);
            for_rows_within(light.size(), factors, z, y, [&](int k, int j) {
                add_row(extinction.row(0, k, j), nullptr, factors[0], weights);
            });
            for (std::size_t c = 0; c < light.count(); ++c) {
                std::ranges::fill(sums, 0.0);
                for_rows_within(light.size(), factors, z, y, [&](int k, int j) {
                    add_row(light.row(c, k, j), extinction.row(0, k, j), factors[0], sums);
                });
                float* row = mean.row(c, z, y);
                for (std::size_t x = 0; x < sums.size(); ++x) {
                    row[x] = weights[x] > 0 ? static_cast<float>(sums[x] / weights[x]) : 0;
                }
            }
        }
    });
    return mean;
}

void add_interpolated(const CellFields& coarse, const CellFactors& factors, float weight,
                      CellFields& fine, const BakeOptions& options) {
    const std::array<int, 3>& from = coarse.size();
    const std::array<int, 3>& to = fine.size();
    std::vector<Between> along_x;
    for (int x = 0; x < to[0]; ++x) along_x.push_back(between(x, factors[0], from[0], true));
    for_each_plane(fine, options, [&](int z) {
        const Between up = between(z, factors[2], from[2], false);
        std::vector<float> middle(static_cast<std::size_t>(from[0]));
        for (int y = 0; y < to[1]; ++y) {
            const Between across = between(y, factors[1], from[1], true);
            for (std::size_t c = 0; c < fine.count(); ++c) {
                const float* a = coarse.row(c, up.first, across.first);
                const float* b = coarse.row(c, up.first, across.second);
                const float* d = coarse.row(c, up.second, across.first);
                const float* e = coarse.row(c, up.second, across.second);
                for (std::size_t x = 0; x < middle.size(); ++x) {
                    const float low = a[x] + across.weight * (b[x] - a[x]);
                    const float high = d[x] + across.weight * (e[x] - d[x]);
                    middle[x] = low + up.weight * (high - low);
                }
                float* row = fine.row(c, z, y);
                for (const Between& at : along_x) {
                    const float first = middle[static_cast<std::size_t>(at.first)];
                    const float second = middle[static_cast<std::size_t>(at.second)];
                    *row++ += weight * (first + at.weight * (second - first));
                }
            }
        }
    });
}

}  // namespace skybake::cloud_light
