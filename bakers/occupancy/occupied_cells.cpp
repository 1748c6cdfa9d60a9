#include "bakers/occupancy/occupied_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/field/pixel_type.h"
#include "bakers/math/half_conversion.h"
#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/leap_distance.h"
#include "config/assets/occupancy.h"

namespace skybake::occupancy {
namespace {

int count_above(const BlockRows& rows, Span x, Span y, Span z, float threshold) {
    int count = 0;
    for_each_value(rows, x, y, z, [&](float value) { count += value > threshold ? 1 : 0; });
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

template <class Value, class Combine>
std::vector<Value> halved(const std::vector<Value>& values, const std::array<int, 3>& size,
                          const Combine& combine) {
    const std::array<int, 3> coarse = next_level_size(size);
    std::vector<Value> result(count_of(coarse));
    const auto pair_of = [&](std::size_t axis, int i) {
        return Span{2 * i, std::min(2 * i + 2, size[axis])};
    };
    for (int k = 0; k < coarse[2]; ++k) {
        const Span z = pair_of(2, k);
        for (int j = 0; j < coarse[1]; ++j) {
            const Span y = pair_of(1, j);
            for (int i = 0; i < coarse[0]; ++i) {
                const Span x = pair_of(0, i);
                Value value = values[index_of(size, x.first, y.first, z.first)];
                for (int fine_z = z.first; fine_z < z.last; ++fine_z) {
                    for (int fine_y = y.first; fine_y < y.last; ++fine_y) {
                        for (int fine_x = x.first; fine_x < x.last; ++fine_x) {
                            value = combine(value, values[index_of(size, fine_x, fine_y, fine_z)]);
                        }
                    }
                }
                result[index_of(coarse, i, j, k)] = value;
            }
        }
    }
    return result;
}

using config::OccupancyContent;

constexpr float kFarthestLeap = 255;

// The next half above one that is not infinite.
float next_half_up(float half) {
    const std::uint16_t bits = half_of_float(half);
    if ((bits & 0x7fffU) == 0) return float_of_half(1);  // 0, whatever its sign
    const bool negative = (bits & 0x8000U) != 0;
    return float_of_half(static_cast<std::uint16_t>(negative ? bits - 1 : bits + 1));
}

double steps_of(PixelType type) { return type == PixelType::unorm8 ? 255 : 65535; }

}  // namespace

double occupied_share(const OccupiedCells& cells) {
    const auto count = std::ranges::count(cells.occupied, 1);
    return static_cast<double>(count) / static_cast<double>(cells.occupied.size());
}

OccupiedCells occupied_cells(const CellRanges& ranges, float threshold) {
    OccupiedCells cells{ranges.size, {}};
    cells.occupied.reserve(ranges.maximum.size());
    for (const float maximum : ranges.maximum)
        cells.occupied.push_back(maximum > threshold ? 1 : 0);
    return cells;
}

OccupiedCells occupied_cells_as_in_thesis(const ChannelSource& source, const CellGrid& grid,
                                          float threshold, const BakeOptions& options) {
    OccupiedCells cells{grid.size(), std::vector<std::uint8_t>(count_of(grid.size()))};
    for_each_block(source, grid, 0, options, eighths_into(cells, grid, threshold));
    for (std::size_t axis = 0; axis < 3; ++axis) dilate(cells, axis);
    return cells;
}

std::array<int, 3> next_level_size(const std::array<int, 3>& size) {
    return {(size[0] + 1) / 2, (size[1] + 1) / 2, (size[2] + 1) / 2};
}

CellRanges next_level(const CellRanges& ranges) {
    return {next_level_size(ranges.size), halved(ranges.minimum, ranges.size, std::ranges::min),
            halved(ranges.maximum, ranges.size, std::ranges::max)};
}

OccupiedCells next_level(const OccupiedCells& cells) {
    return {next_level_size(cells.size), halved(cells.occupied, cells.size, std::ranges::max)};
}

float stored_up(float value, PixelType type) {
    if (type == PixelType::float32) return value;
    if (type == PixelType::half) {
        const float nearest = round_to_pixel_type(value, type);
        return nearest < value ? next_half_up(nearest) : nearest;
    }
    // In double, where no product of a float and 65535 is rounded.
    return static_cast<float>(std::ceil(double{value} * steps_of(type)) / steps_of(type));
}

float stored_down(float value, PixelType type) {
    if (type == PixelType::float32) return value;
    if (type == PixelType::half) return -stored_up(-value, type);
    return static_cast<float>(std::floor(double{value} * steps_of(type)) / steps_of(type));
}

CellSource::CellSource(CellRanges ranges, OccupiedCells occupied,
                       std::vector<OccupancyContent> contents, PixelType pixel_type)
    : ranges_(std::move(ranges)),
      occupied_(std::move(occupied)),
      contents_(std::move(contents)),
      pixel_type_(pixel_type) {
    const bool leaps = std::ranges::find(contents_, OccupancyContent::leap) != contents_.end();
    if (leaps) leap_ = leap_distance(occupied_);
}

float CellSource::value(OccupancyContent content, std::size_t cell) const {
    switch (content) {
        case OccupancyContent::occupied:
            return occupied_.occupied[cell];
        case OccupancyContent::minimum:
            return stored_down(ranges_.minimum[cell], pixel_type_);
        case OccupancyContent::maximum:
            return stored_up(ranges_.maximum[cell], pixel_type_);
        case OccupancyContent::leap:
            break;
    }
    return is_unorm(pixel_type_) ? static_cast<float>(leap_[cell]) / kFarthestLeap
                                 : static_cast<float>(leap_[cell]);
}

void CellSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    fill_rows(box, channels, [&](std::size_t c, int y, int z, float* out) {
        const std::size_t row = index_of(ranges_.size, box.origin[0], y, z);
        const auto width = static_cast<std::size_t>(box.size[0]);
        for (std::size_t x = 0; x < width; ++x) out[x] = value(contents_[c], row + x);
    });
}

}  // namespace skybake::occupancy
