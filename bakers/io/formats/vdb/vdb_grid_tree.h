// The tree of a grid of numbers, as it stands in a VDB file, without its voxels: where each leaf is in
// the file, and the values of tiles. Only the module skybake_vdb includes this header.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "bakers/io/formats/vdb/vdb_input.h"
#include "bakers/io/formats/vdb/vdb_library.h"
#include "bakers/io/volumes/file_voxels.h"
#include "bakers/io/volumes/grid_voxels.h"

namespace skybake::vdb {

// Where a leaf's mask and values are in the file.
struct LeafRecord {
    std::int64_t begin = 0;
    std::uint32_t bytes = 0;
    std::array<int, 3> corner{};
    bool is_zero = false;  // known once the leaf has been decoded
};

// The children and tiles of an inner node with 2^(3 log2_edge) places. Memory follows what the file
// holds: children are counted up to a place, and tiles are only kept if they differ.
template <class Node>
class NodePlaces {
  public:
    static constexpr std::size_t places = Node::NUM_VALUES;

    NodePlaces(const typename Node::NodeMaskType& children, std::vector<float> tiles,
               std::size_t first_child)
        : first_child_(first_child) {
        for (std::size_t word = 0; word < words; ++word) {
            children_[word] =
                children.template getWord<std::uint64_t>(static_cast<openvdb::Index>(word));
            before_[word] = count_;
            count_ += static_cast<std::uint32_t>(std::popcount(children_[word]));
        }
        bool differ = false;
        bool is_first = true;
        for (std::size_t i = 0; i < places; ++i) {
            if (has_child(i)) continue;
            if (is_first) tile_ = tiles[i];
            is_first = false;
            differ = differ || !(tiles[i] == tile_);
        }
        if (differ) tiles_ = std::move(tiles);
    }

    bool has_child(std::size_t place) const {
        return (children_[place / 64] >> (place % 64) & 1U) != 0;
    }
    // The number of the child at a place among all children of the tree's level.
    std::size_t child(std::size_t place) const {
        const std::uint64_t below = children_[place / 64] & ((std::uint64_t{1} << place % 64) - 1);
        return first_child_ + before_[place / 64] + static_cast<std::size_t>(std::popcount(below));
    }
    float tile(std::size_t place) const { return tiles_.empty() ? tile_ : tiles_[place]; }

  private:
    static constexpr std::size_t words = places / 64;
    std::array<std::uint64_t, words> children_{};
    std::array<std::uint32_t, words> before_{};
    std::uint32_t count_ = 0;
    std::size_t first_child_ = 0;
    float tile_ = 0;
    std::vector<float> tiles_;
};

// A box of indices, inclusive.
struct IndexBounds {
    Vector first{kNone, kNone, kNone};
    Vector last{-kNone, -kNone, -kNone};

    bool empty() const { return first[0] > last[0]; }
    void add(const Vector& from, const Vector& to) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (from[i] < first[i]) first[i] = from[i];
            if (to[i] > last[i]) last[i] = to[i];
        }
    }

  private:
    static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
};

struct GridTree {
    float background = 0;                                // as the file has it, rounded to float
    alignas(8) std::array<char, 12> stored_background{};  // in the type of the grid
    // The smallest and largest finite value of tiles and background.
    float least_tile = 0;
    float largest_tile = 0;
    ValueFaults faults;   // of tiles; those that are not finite are the background
    DensityRamp density;  // what numbers mean
    std::map<std::array<int, 3>, float> root_tiles;           // by corner
    std::map<std::array<int, 3>, std::size_t> root_children;  // by corner: number of the node
    std::vector<NodePlaces<UpperNode>> upper;
    std::vector<NodePlaces<LowerNode>> lower;
    std::vector<LeafRecord> leaves;
    IndexBounds active;

    // Where an index lies: in a leaf, or in a tile of one value.
    struct Place {
        const LeafRecord* leaf = nullptr;  // null: a tile
        float value = 0;                   // density of the tile
        int edge = 0;                      // voxels along it: 8, 128 or 4096
    };
    Place find(const openvdb::Coord& index) const;
};

// Whether a grid holds numbers, and whether it holds vectors of three floats.
bool is_of_numbers(const Grid& grid);
bool is_of_vectors(const Grid& grid);

// Calls visit(Value{}) with the type of a grid's values. Throws where it holds neither numbers nor vectors.
template <class Visit>
auto with_number_type(const Grid& head, const Visit& visit) {
    const openvdb::GridBase& grid = *head.grid;
    if (grid.isType<openvdb::FloatGrid>()) return visit(float{});
    if (grid.isType<openvdb::DoubleGrid>()) return visit(double{});
    if (grid.isType<openvdb::Int32Grid>()) return visit(std::int32_t{});
    if (grid.isType<openvdb::Int64Grid>()) return visit(openvdb::Int64{});
    if (is_of_vectors(head)) return visit(openvdb::Vec3f{});
    throw Damaged(fmt::format(
        "its grid `{}` holds {}, and only grids of float, double, int32 and "
        "int64 are read",
        openvdb::io::GridDescriptor::nameAsString(head.descriptor.uniqueName()), grid.valueType()));
}

// Reads the tree of a grid, and finds its leaves in the file. Of vectors, values are those of the component.
GridTree read_grid_tree(Input& input, const Grid& grid);

// Leaves the stream behind a grid that io::Stream wrote.
void skip_streamed_grid(Input& input, const Grid& grid);

}  // namespace skybake::vdb
