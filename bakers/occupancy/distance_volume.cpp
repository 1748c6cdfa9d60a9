#include "bakers/occupancy/distance_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/occupancy/cell_blocks.h"
#include "config/assets/cloud_distance.h"

namespace skybake::occupancy {

using config::DistanceContent;

namespace {

bool has(const std::vector<DistanceContent>& contents, DistanceContent content) {
    return std::ranges::find(contents, content) != contents.end();
}

double mean_of(const BlockRows& rows, Span x, Span y, Span z) {
    double sum = 0;
    for_each_value(rows, x, y, z, [&](float value) { sum += double{value}; });
    return sum / (static_cast<double>(x.count()) * y.count() * z.count());
}

}  // namespace

std::vector<float> mean_densities(const ChannelSource& source, const CellGrid& grid,
                                  const BakeOptions& options) {
    const std::array<int, 3> size = grid.size();
    std::vector<float> means(count_of(size));
    for_each_block(source, grid, 0, options, [&](const CellBlock& block, const BlockRows& rows) {
        for (int z = block.z.first; z < block.z.last; ++z) {
            for (int y = block.y.first; y < block.y.last; ++y) {
                for (int x = 0; x < size[0]; ++x) {
                    means[index_of(size, x, y, z)] = static_cast<float>(mean_of(
                        rows, grid.voxels_of(0, x), grid.voxels_of(1, y), grid.voxels_of(2, z)));
                }
            }
        }
    });
    return means;
}

DistanceSource::DistanceSource(const VoxelBits& bits, const DistanceGrid& grid,
                               const DistanceCode& code, std::vector<DistanceContent> contents,
                               DistanceFields fields, const BakeOptions& options)
    : grid_(grid),
      size_(grid.grid.size()),
      contents_(std::move(contents)),
      fields_(std::move(fields)),
      distance_(count_of(size_), code.surface()) {
    if (has(contents_, DistanceContent::profile)) depth_.resize(distance_.size());
    ScratchFloats scratch;
    distance_squares(bits, grid, CellKind::touched, options, scratch,
                     [&](int x, int y, int z, int count, const float* squares) {
                         float* out = &distance_[index_of(size_, x, y, z)];
                         code.outside(squares, static_cast<std::size_t>(count), out);
                     });
    if (options.cancelled()) return;
    distance_squares(bits, grid, CellKind::holed, options, scratch,
                     [&](int x, int y, int z, int count, const float* squares) {
                         const std::size_t first = index_of(size_, x, y, z);
                         for (int i = 0; i < count; ++i) {
                             if (squares[i] == 0) continue;
                             const std::size_t texel = first + static_cast<std::size_t>(i);
                             distance_[texel] = code.inside(squares[i]);
                             if (!depth_.empty()) depth_[texel] = std::sqrt(squares[i]);
                         }
                     });
    if (fields_.core_m == 0 && !depth_.empty()) {
        fields_.core_m = double{*std::ranges::max_element(depth_)};
    }
}

float DistanceSource::value(DistanceContent content, std::size_t texel, int z) const {
    switch (content) {
        case DistanceContent::distance:
            return distance_[texel];
        case DistanceContent::profile: {
            const double depth = double{depth_[texel]};
            return depth == 0 ? 0 : static_cast<float>(std::min(1.0, depth / fields_.core_m));
        }
        case DistanceContent::detail_type: {
            const double height = (z + 0.5) * grid_.grid.cell / grid_.grid.voxels[2];
            if (height >= fields_.wisp_height) return 1;
            return static_cast<float>(height / fields_.wisp_height);
        }
        case DistanceContent::density_scale:
            break;
    }
    return fields_.mean_density[texel];
}

void DistanceSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    fill_rows(box, channels, [&](std::size_t c, int y, int z, float* out) {
        const std::size_t row = index_of(size_, box.origin[0], y, z);
        const auto width = static_cast<std::size_t>(box.size[0]);
        for (std::size_t x = 0; x < width; ++x) out[x] = value(contents_[c], row + x, z);
    });
}

}  // namespace skybake::occupancy
