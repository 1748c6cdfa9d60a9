#include "bakers/occupancy/cloud_bits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

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

constexpr int kFinestEdge = 4;

// Calls visit(x, y, z) for the places of a box that lie within `size`.
template <class Visit>
void for_each_within(const std::array<int, 3>& first, int edge, const std::array<int, 3>& size,
                     const Visit& visit) {
    for (int z = first[2]; z < std::min(first[2] + edge, size[2]); ++z) {
        for (int y = first[1]; y < std::min(first[1] + edge, size[1]); ++y) {
            for (int x = first[0]; x < std::min(first[0] + edge, size[0]); ++x) visit(x, y, z);
        }
    }
}

std::array<int, 3> times(const std::array<int, 3>& at, int factor) {
    return {at[0] * factor, at[1] * factor, at[2] * factor};
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

struct NearestVoxel::Search {
    std::array<double, 3> place{};  // seen from the copy of the tile that is searched
    unsigned wanted = 0;            // the bit of Blocks::holds
    double least = std::numeric_limits<double>::infinity();
};

NearestVoxel::NearestVoxel(const VoxelBits& bits, const std::array<double, 3>& voxel_m)
    : bits_(bits), voxel_m_(voxel_m) {
    do add_level();
    while (count_of(levels_.back().size) > 1);
}

unsigned NearestVoxel::contents_of_voxels(const std::array<int, 3>& first) const {
    const int width = std::min(kFinestEdge, bits_.voxels()[0] - first[0]);
    const std::uint64_t all = (std::uint64_t{1} << width) - 1;
    unsigned holds = 0;
    for_each_within({0, first[1], first[2]}, kFinestEdge, {1, bits_.voxels()[1], bits_.voxels()[2]},
                    [&](int, int y, int z) {
                        const auto x = static_cast<unsigned>(first[0]);
                        const std::uint64_t above = (bits_.row(y, z)[x / 64] >> (x % 64)) & all;
                        holds |= (above != 0 ? 2U : 0U) | (above != all ? 1U : 0U);
                    });
    return holds;
}

unsigned NearestVoxel::contents_of_blocks(const std::array<int, 3>& first) const {
    const Blocks& finer = levels_.back();
    unsigned holds = 0;
    for_each_within(first, 2, finer.size, [&](int x, int y, int z) {
        holds |= finer.holds[index_of(finer.size, x, y, z)];
    });
    return holds;
}

void NearestVoxel::add_level() {
    const bool is_finest = levels_.empty();
    Blocks blocks;
    blocks.edge = is_finest ? kFinestEdge : 2 * levels_.back().edge;
    for (std::size_t a = 0; a < 3; ++a) {
        blocks.size[a] = (bits_.voxels()[a] + blocks.edge - 1) / blocks.edge;
    }
    blocks.holds.resize(count_of(blocks.size));
    for_each_within({}, std::numeric_limits<int>::max(), blocks.size, [&](int x, int y, int z) {
        const unsigned holds = is_finest ? contents_of_voxels(times({x, y, z}, kFinestEdge))
                                         : contents_of_blocks(times({x, y, z}, 2));
        blocks.holds[index_of(blocks.size, x, y, z)] = static_cast<std::uint8_t>(holds);
    });
    levels_.push_back(std::move(blocks));
}

// The squared distance to the cells about the voxels of a block.
double NearestVoxel::square_to(const Search& search, const std::array<int, 3>& first,
                               int edge) const {
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const int last = std::min(first[a] + edge, bits_.voxels()[a]);
        double low = first[a] - 0.5;
        double high = last + 0.5;
        if (a == 2) {
            low = std::max(low, 0.0);
            high = std::min(high, static_cast<double>(bits_.voxels()[2]));
        }
        const double way =
            std::max({0.0, low - search.place[a], search.place[a] - high}) * voxel_m_[a];
        square += way * way;
    }
    return square;
}

void NearestVoxel::search_voxels(const std::array<int, 3>& at, Search& search) const {
    for_each_within(times(at, kFinestEdge), kFinestEdge, bits_.voxels(), [&](int x, int y, int z) {
        if (bits_.at(x, y, z) != (search.wanted == 2)) return;
        search.least = std::min(search.least, square_to(search, {x, y, z}, 1));
    });
}

void NearestVoxel::search_block(std::size_t level, const std::array<int, 3>& at,
                                Search& search) const {
    if (level == 0) return search_voxels(at, search);
    const Blocks& finer = levels_[level - 1];
    std::array<Block, 8> parts;  // the nearer ones first
    std::size_t count = 0;
    for_each_within(times(at, 2), 2, finer.size, [&](int x, int y, int z) {
        if ((finer.holds[index_of(finer.size, x, y, z)] & search.wanted) == 0) return;
        const std::array<int, 3> part = {x, y, z};
        const Block block{part, square_to(search, times(part, finer.edge), finer.edge)};
        std::size_t i = count++;
        for (; i > 0 && parts[i - 1].square > block.square; --i) parts[i] = parts[i - 1];
        parts[i] = block;
    });
    for (std::size_t i = 0; i < count; ++i) {
        if (parts[i].square >= search.least) return;
        search_block(level - 1, parts[i].at, search);
    }
}

double NearestVoxel::least_square(const std::array<double, 3>& place, bool above) const {
    Search search;
    search.wanted = above ? 2 : 1;
    if ((levels_.back().holds.front() & search.wanted) == 0) return search.least;
    for (const int x : {0, -1, 1}) {
        for (const int y : {0, -1, 1}) {
            search.place = {place[0] + x * bits_.voxels()[0], place[1] + y * bits_.voxels()[1],
                            place[2]};
            if (square_to(search, {}, levels_.back().edge) >= search.least) continue;
            search_block(levels_.size() - 1, {}, search);
        }
    }
    return search.least;
}

double NearestVoxel::to_cloud(const std::array<double, 3>& place) const {
    return std::sqrt(least_square(place, true));
}

double NearestVoxel::to_hole(const std::array<double, 3>& place) const {
    const double outside = std::min(place[2], bits_.voxels()[2] - place[2]) * voxel_m_[2];
    return std::min(std::sqrt(least_square(place, false)), std::max(0.0, outside));
}

}  // namespace skybake::occupancy
