#include "bakers/occupancy/cloud_bits.h"

#include <algorithm>

#include "bakers/occupancy/cell_blocks.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake::occupancy {
namespace {

// The bits of a word that stand for voxels of a row.
std::uint64_t used_bits(std::size_t word, int count) {
    const int left = count - static_cast<int>(word) * kWordBits;
    return left >= kWordBits ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
}

// The row moved by one voxel: bit x is bit x + 1, and the last one is the first.
std::uint64_t next_voxels(const std::uint64_t* row, std::size_t word, std::size_t words,
                          int count) {
    std::uint64_t moved = row[word] >> 1U;
    if (word + 1 < words) return moved | (row[word + 1] << (kWordBits - 1));
    const auto last = static_cast<unsigned>((count - 1) % kWordBits);
    return moved | ((row[0] & 1U) << last);
}

}  // namespace

VoxelBits::VoxelBits(const std::array<int, 3>& voxels)
    : voxels_(voxels),
      words_((static_cast<std::size_t>(voxels[0]) + kWordBits - 1) / kWordBits),
      bits_(words_ * static_cast<std::size_t>(voxels[1]) * static_cast<std::size_t>(voxels[2])) {}

void VoxelBits::set_row(int y, int z, const float* values, float threshold) {
    std::uint64_t* row = bits_.data() + offset(y, z);
    for (std::size_t word = 0; word < words_; ++word) {
        const int count = std::min(kWordBits, voxels_[0] - static_cast<int>(word) * kWordBits);
        std::uint64_t bits = 0;
        for (int i = 0; i < count; ++i) {
            bits |= std::uint64_t{values[i] > threshold} << static_cast<unsigned>(i);
        }
        row[word] = bits;
        values += count;
    }
}

void VoxelBits::set(int x, int y, int z) {
    const auto bit = static_cast<unsigned>(x);
    bits_[offset(y, z) + bit / kWordBits] |= std::uint64_t{1} << (bit % kWordBits);
}

VoxelBits voxel_bits(const ChannelSource& source, const CellGrid& grid, float threshold,
                     const BakeOptions& options) {
    VoxelBits bits(grid.voxels);
    for_each_block(source, grid, 0, options, [&](const CellBlock&, const BlockRows& rows) {
        for (int z = rows.z().first; z < rows.z().last; ++z) {
            for (int y = rows.y().first; y < rows.y().last; ++y) {
                bits.set_row(y, z, rows.at(y, z), threshold);
            }
        }
    });
    return bits;
}

void cells_between(const VoxelBits& bits, CellKind kind, int y, int z, std::uint64_t* cells) {
    const std::array<int, 3>& voxels = bits.voxels();
    const int below = std::max(z - 1, 0);
    const int above = std::min(z, voxels[2] - 1);
    const int beside = wrapped(y + 1, voxels[1]);
    const std::uint64_t* rows[] = {bits.row(y, below), bits.row(beside, below), bits.row(y, above),
                                   bits.row(beside, above)};
    const std::size_t words = bits.words();
    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t any = 0;
        std::uint64_t all = ~std::uint64_t{0};
        for (const std::uint64_t* row : rows) {
            const std::uint64_t next = next_voxels(row, word, words, voxels[0]);
            any |= row[word] | next;
            all &= row[word] & next;
        }
        cells[word] = (kind == CellKind::touched ? any : ~all) & used_bits(word, voxels[0]);
    }
}

}  // namespace skybake::occupancy
