#include "bakers/occupancy/occupied_cells.h"

#include <algorithm>
#include <cstddef>

#include "bakers/occupancy/cell_blocks.h"

namespace skybake::occupancy {

namespace {

OccupiedCells no_cells(const CellGrid& grid) {
    OccupiedCells cells{grid.size(), {}};
    cells.occupied.resize(count_of(cells.size));
    return cells;
}

int count_above(const BlockRows& rows, Span x, Span y, Span z, float threshold) {
    int count = 0;
    for (int plane = z.first; plane < z.last; ++plane) {
        for (int line = y.first; line < y.last; ++line) {
            const float* row = rows.at(line, plane);
            for (int i = x.first; i < x.last; ++i) count += row[i] > threshold ? 1 : 0;
        }
    }
    return count;
}

// The cells that are on before the ring is added.
BlockWork eighths_into(OccupiedCells& cells, const CellGrid& grid, float threshold) {
    return [&cells, &grid, threshold](const CellBlock& block, const BlockRows& rows) {
        for (int k = block.z.first; k < block.z.last; ++k) {
            const Span z = grid.voxels_of(2, k);
            for (int j = block.y.first; j < block.y.last; ++j) {
                const Span y = grid.voxels_of(1, j);
                for (int i = 0; i < cells.size[0]; ++i) {
                    const Span x = grid.voxels_of(0, i);
                    const int above = count_above(rows, x, y, z, threshold);
                    const int voxels = x.count() * y.count() * z.count();
                    cells.occupied[index_of(cells.size, i, j, k)] = 8 * above >= voxels ? 1 : 0;
                }
            }
        }
    };
}

// One more cell on either side along an axis: three times, a ring of 26.
void dilate(OccupiedCells& cells, std::size_t axis) {
    const std::vector<std::uint8_t> before = cells.occupied;
    std::size_t stride = 1;
    for (std::size_t a = 0; a < axis; ++a) stride *= static_cast<std::size_t>(cells.size[a]);
    const auto count = static_cast<std::size_t>(cells.size[axis]);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::size_t at = i / stride % count;
        const bool lower = at > 0 && before[i - stride] != 0;
        const bool upper = at + 1 < count && before[i + stride] != 0;
        if (lower || upper) cells.occupied[i] = 1;
    }
}

void add_ring(OccupiedCells& cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) dilate(cells, axis);
}

}  // namespace

double occupied_share(const OccupiedCells& cells) {
    const auto count = std::count(cells.occupied.begin(), cells.occupied.end(), 1);
    return static_cast<double>(count) / static_cast<double>(cells.occupied.size());
}

OccupiedCells occupied_cells(const CellRanges& ranges, float threshold) {
    OccupiedCells cells{ranges.size, {}};
    cells.occupied.reserve(ranges.maximum.size());
    for (const float maximum : ranges.maximum)
        cells.occupied.push_back(maximum > threshold ? 1 : 0);
    return cells;
}

OccupiedCells occupied_cells_as_in_thesis(const float* voxels, const CellGrid& grid,
                                          float threshold, int threads) {
    OccupiedCells cells = no_cells(grid);
    for_each_block(voxels, grid, 0, threads, eighths_into(cells, grid, threshold));
    add_ring(cells);
    return cells;
}

OccupiedCells occupied_cells_as_in_thesis(const ChannelSource& source, const CellGrid& grid,
                                          float threshold, const BakeOptions& options) {
    OccupiedCells cells = no_cells(grid);
    for_each_block(source, grid, 0, options, eighths_into(cells, grid, threshold));
    add_ring(cells);
    return cells;
}

}  // namespace skybake::occupancy
