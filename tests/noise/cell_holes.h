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
                const auto cell = static_cast<std::size_t>((y - 1 + j) * kHoleCells + x - 1 + i);
                const noise::CellPoint& point = (corner < 4 ? below : above)[cell];
                const float dx = point.x - static_cast<float>(1 - i);
                const float dy = point.y - static_cast<float>(1 - j);
                const float dz = point.z - static_cast<float>(corner < 4);
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

// The box about a hole, as the kernels make it and by brute force: the specification's operations,
// over all points of the cells within one and within two of the voxel's.
inline HoleCount look_into(const noise::NoiseField& field, std::uint64_t key,
                           const std::array<int, 3>& hole) {
    VoxelBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.origin[i] = hole[i] * kHoleVoxelsPerCell - kHoleReach;
        box.size[i] = 2 * kHoleReach;
    }
    const std::vector<float> made = filled(field, box, 1)[0];
    constexpr int kCells = 6;  // about the hole along an axis
    const auto cell = [&](std::size_t axis, int i) {
        return static_cast<std::uint32_t>((hole[axis] - kCells / 2 + i + kHoleCells) % kHoleCells);
    };
    noise::CellPoint points[kCells][kCells][kCells];
    testing::for_each_voxel({kCells, kCells, kCells}, [&](int x, int y, int z) {
        points[z][y][x] =
            noise::cell_point(noise::row_key(key, cell(1, y), cell(2, z)), cell(0, x));
    });
    HoleCount count;
    std::size_t at = 0;
    testing::for_each_voxel(box.size, [&](int x, int y, int z) {
        // The voxel's cell is the third or the fourth along each axis.
        std::array<int, 3> own{};
        std::array<float, 3> fraction{};
        float m = 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const int v = std::array{x, y, z}[i] - kHoleReach;
            own[i] = v < 0 ? 2 : 3;
            fraction[i] = (static_cast<float>(v < 0 ? v + kHoleVoxelsPerCell : v) + 0.5f) /
                          static_cast<float>(kHoleVoxelsPerCell);
            m = std::min({m, fraction[i], 1 - fraction[i]});
        }
        float few = std::numeric_limits<float>::infinity();
        float all = few;
        testing::for_each_voxel({5, 5, 5}, [&](int i, int j, int k) {
            const noise::CellPoint& point = points[own[2] + k - 2][own[1] + j - 2][own[0] + i - 2];
            const float dx = (fraction[0] - point.x) - static_cast<float>(i - 2);
            const float dy = (fraction[1] - point.y) - static_cast<float>(j - 2);
            const float dz = (fraction[2] - point.z) - static_cast<float>(k - 2);
            const float d = (dx * dx + dy * dy) + dz * dz;
            all = std::min(all, d);
            if (i % 4 != 0 && j % 4 != 0 && k % 4 != 0) few = std::min(few, d);
        });
        if (std::sqrt(few) > 1 + m) ++count.unsure;
        if (few != all) {
            ++count.wrong;
            count.wrong_by =
                std::max(count.wrong_by, std::sqrt(double{few}) - std::sqrt(double{all}));
        }
        if (!same_bits(made[at++], std::sqrt(all))) ++count.mismatches;
    });
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
