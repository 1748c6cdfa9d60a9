// Places where the nearest point of cellular noise is not sure to lie in the 27 cells about the
// sample: voxels about lattice corners that have no point within a cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bakers/math/parallel.h"
#include "bakers/noise/lattice_hash.h"
#include "tests/noise/noises.h"

namespace skybake::test {

// A tile of 512^3 cells, 32^3 voxels each.
inline constexpr int kHoleCells = 512;
inline constexpr int kHoleVoxelsPerCell = 32;
inline constexpr int kHoleSize = kHoleCells * kHoleVoxelsPerCell;
inline constexpr int kHoleReach = 8;  // voxels on either side of the corner

// Points of a plane of cells.
inline std::vector<noise::CellPoint> plane_of_points(std::uint64_t key, std::uint32_t z) {
    std::vector<noise::CellPoint> points;
    points.reserve(std::size_t{kHoleCells} * kHoleCells);
    for (std::uint32_t y = 0; y < kHoleCells; ++y) {
        const noise::RowKey row = noise::row_key(key, y, z);
        for (std::uint32_t x = 0; x < kHoleCells; ++x) points.push_back(cell_point(row, x));
    }
    return points;
}

// Corners in the plane between the cells of `below` and of `above`, none of whose eight cells has
// its point within 1. By chance 0.476^8 = 0.26 % of all.
inline std::vector<std::array<int, 3>> holes_between(const std::vector<noise::CellPoint>& below,
                                                     const std::vector<noise::CellPoint>& above,
                                                     int z) {
    std::vector<std::array<int, 3>> holes;
    for (int y = 1; y < kHoleCells; ++y) {
        for (int x = 1; x < kHoleCells; ++x) {
            bool hole = true;
            for (int corner = 0; corner < 8 && hole; ++corner) {
                const int i = corner & 1;
                const int j = (corner >> 1) & 1;
                const int k = corner >> 2;
                const noise::CellPoint& point =
                    (k != 0
                         ? above
                         : below)[static_cast<std::size_t>((y - 1 + j) * kHoleCells + x - 1 + i)];
                const float dx = point.x - static_cast<float>(1 - i);
                const float dy = point.y - static_cast<float>(1 - j);
                const float dz = point.z - static_cast<float>(1 - k);
                hole = dx * dx + dy * dy + dz * dz > 1;
            }
            if (hole) holes.push_back({x, y, z});
        }
    }
    return holes;
}

// Counts of the voxels of boxes about holes.
struct HoleCount {
    std::int64_t unsure = 0;      // F1 > 1 + m in the 27 cells: more must be asked
    std::int64_t wrong = 0;       // the nearest point of the 27 cells is not the nearest
    double wrong_by = 0;          // at most
    std::int64_t mismatches = 0;  // voxels of the kernels unlike brute force in 125 cells
    void operator+=(const HoleCount& other) {
        unsure += other.unsure;
        wrong += other.wrong;
        wrong_by = std::max(wrong_by, other.wrong_by);
        mismatches += other.mismatches;
    }
};

// Squared distances from the 8^3 voxels of an octant of the box, all in `cell`, to the nearest
// point of the cells within `rings`: the specification's operations, over all points for each
// voxel.
inline void brute_force(std::uint64_t key, const std::array<int, 3>& cell,
                        const std::array<std::array<float, kHoleReach>, 3>& fraction, int rings,
                        float (&nearest)[kHoleReach][kHoleReach][kHoleReach]) {
    for (auto& slice : nearest) {
        for (auto& row : slice)
            std::fill(row, row + kHoleReach, std::numeric_limits<float>::infinity());
    }
    const auto wrap = [](int c) {
        return static_cast<std::uint32_t>((c + kHoleCells) % kHoleCells);
    };
    for (int dz = -rings; dz <= rings; ++dz) {
        for (int dy = -rings; dy <= rings; ++dy) {
            const noise::RowKey row = noise::row_key(key, wrap(cell[1] + dy), wrap(cell[2] + dz));
            for (int dx = -rings; dx <= rings; ++dx) {
                const noise::CellPoint point = noise::cell_point(row, wrap(cell[0] + dx));
                float squared[3][kHoleReach];
                for (std::size_t i = 0; i < kHoleReach; ++i) {
                    const float x = (fraction[0][i] - point.x) - static_cast<float>(dx);
                    const float y = (fraction[1][i] - point.y) - static_cast<float>(dy);
                    const float z = (fraction[2][i] - point.z) - static_cast<float>(dz);
                    squared[0][i] = x * x;
                    squared[1][i] = y * y;
                    squared[2][i] = z * z;
                }
                for (std::size_t k = 0; k < kHoleReach; ++k) {
                    for (std::size_t j = 0; j < kHoleReach; ++j) {
                        for (std::size_t i = 0; i < kHoleReach; ++i) {
                            const float d = (squared[0][i] + squared[1][j]) + squared[2][k];
                            float& best = nearest[k][j][i];
                            best = d < best ? d : best;
                        }
                    }
                }
            }
        }
    }
}

// The box about a hole, as the kernels make it and by brute force.
inline HoleCount look_into(const noise::NoiseField& field, std::uint64_t key,
                           const std::array<int, 3>& hole) {
    constexpr int kBox = 2 * kHoleReach;
    VoxelBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.origin[i] = hole[i] * kHoleVoxelsPerCell - kHoleReach;
        box.size[i] = kBox;
    }
    const std::vector<float> made = filled(field, box, 1)[0];
    HoleCount count;
    for (int octant = 0; octant < 8; ++octant) {
        std::array<int, 3> side{};
        std::array<int, 3> cell{};
        std::array<std::array<float, kHoleReach>, 3> fraction{};
        for (std::size_t i = 0; i < 3; ++i) {
            side[i] = (octant >> i) & 1;
            cell[i] = hole[i] - 1 + side[i];
            for (int v = 0; v < kHoleReach; ++v) {
                const int within = side[i] != 0 ? v : kHoleVoxelsPerCell - kHoleReach + v;
                fraction[i][static_cast<std::size_t>(v)] =
                    (static_cast<float>(within) + 0.5f) / static_cast<float>(kHoleVoxelsPerCell);
            }
        }
        float few[kHoleReach][kHoleReach][kHoleReach];
        float all[kHoleReach][kHoleReach][kHoleReach];
        brute_force(key, cell, fraction, 1, few);
        brute_force(key, cell, fraction, 2, all);
        for (std::size_t k = 0; k < kHoleReach; ++k) {
            for (std::size_t j = 0; j < kHoleReach; ++j) {
                for (std::size_t i = 0; i < kHoleReach; ++i) {
                    const auto border = [](float f) { return std::min(f, 1 - f); };
                    const float m = std::min(
                        {border(fraction[0][i]), border(fraction[1][j]), border(fraction[2][k])});
                    if (std::sqrt(few[k][j][i]) > 1 + m) ++count.unsure;
                    if (few[k][j][i] != all[k][j][i]) {
                        ++count.wrong;
                        count.wrong_by =
                            std::max(count.wrong_by, std::sqrt(double{few[k][j][i]}) -
                                                         std::sqrt(double{all[k][j][i]}));
                    }
                    const std::size_t x = static_cast<std::size_t>(side[0]) * kHoleReach + i;
                    const std::size_t y = static_cast<std::size_t>(side[1]) * kHoleReach + j;
                    const std::size_t z = static_cast<std::size_t>(side[2]) * kHoleReach + k;
                    const float found = made[(z * kBox + y) * kBox + x];
                    if (!same_bits(found, std::sqrt(all[k][j][i]))) ++count.mismatches;
                }
            }
        }
    }
    return count;
}

// Looks into holes, plane after plane, seed after seed, until so many voxels were unsure.
inline HoleCount look_into_holes(std::int64_t unsure) {
    HoleCount total;
    for (std::uint64_t seed = 1; total.unsure < unsure; ++seed) {
        const Frequency frequency = {kHoleCells, kHoleCells, kHoleCells};
        const noise::NoiseField field(noise::make_noise_plan(noise_of({worley({frequency})}, seed),
                                                             {kHoleSize, kHoleSize, kHoleSize}));
        const std::uint64_t key = noise::octave_key(seed, 0, noise::Purpose::cells, frequency);
        std::vector<noise::CellPoint> below = plane_of_points(key, 0);
        for (int z = 1; z < kHoleCells && total.unsure < unsure; ++z) {
            std::vector<noise::CellPoint> above =
                plane_of_points(key, static_cast<std::uint32_t>(z));
            const auto holes = holes_between(below, above, z);
            std::vector<HoleCount> counts(holes.size());
            parallel_for(static_cast<int>(holes.size()), 0, [&](int i) {
                const auto at = static_cast<std::size_t>(i);
                counts[at] = look_into(field, key, holes[at]);
            });
            for (const HoleCount& count : counts) total += count;
            below = std::move(above);
        }
    }
    return total;
}

}  // namespace skybake::test
