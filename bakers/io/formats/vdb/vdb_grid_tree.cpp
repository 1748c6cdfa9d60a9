#include "bakers/io/formats/vdb/vdb_grid_tree.h"

#include <openvdb/io/Compression.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace skybake::vdb {
namespace {

namespace io = openvdb::io;
using Coord = openvdb::Coord;

Vector vector_at(const Coord& at) { return {at[0], at[1], at[2]}; }

template <class Value>
class TreeReader {
  public:
    TreeReader(Input& input, const Grid& grid)
        : input_(input),
          in_(input.stream()),
          grid_(grid),
          half_(grid.descriptor.saveFloatAsHalf()) {}

    GridTree read() {
        in_.seekg(grid_.tree_at);
        io::setDataCompression(in_, grid_.compression);
        expect(read_raw<std::int32_t>(in_) == 1, "its leaves have several buffers");
        const auto background = read_raw<Value>(in_);
        std::memcpy(tree_.stored_background.data(), &background, sizeof background);
        io::setGridBackgroundValuePtr(in_, tree_.stored_background.data());
        tree_.background = number_of(background, grid_.component);
        expect(std::isfinite(tree_.background), "its background is not finite");
        take_tile(tree_.background);
        const auto tiles = read_raw<openvdb::Index>(in_);
        const auto children = read_raw<openvdb::Index>(in_);
        for (openvdb::Index i = 0; i < tiles; ++i) read_root_tile();
        for (openvdb::Index i = 0; i < children; ++i) read_upper();
        find_leaves();
        io::setGridBackgroundValuePtr(in_, nullptr);
        if (grid_.grid->getGridClass() == openvdb::GRID_LEVEL_SET) find_half_width();
        return std::move(tree_);
    }

  private:
    // The half width of the band is known from the tiles inside of the surface. Where there are none,
    // it is that outside, which is the background.
    void find_half_width() {
        tree_.density = DensityRamp(tree_.least_tile < 0 ? -tree_.least_tile : tree_.background);
        expect(tree_.density.is_valid(), "its level set has no half width");
    }

    void take_tile(float value) {
        tree_.least_tile = std::min(tree_.least_tile, value);
        tree_.largest_tile = std::max(tree_.largest_tile, value);
    }

    // Returns the value of a tile, or the background for one that is not finite.
    float tile_value(float value, const Coord& corner, int edge) {
        if (value != tree_.background) {
            tree_.faults.add(value, vector_at(corner), std::int64_t{edge} * edge * edge);
        }
        const float taken = std::isfinite(value) ? value : tree_.background;
        take_tile(taken);
        return taken;
    }

    // Returns the corner of a node of the root.
    Coord read_corner() {
        // Indices stay far from where they would overflow.
        constexpr int most = 1 << 30;
        Coord corner;
        corner.read(in_);
        for (std::size_t i = 0; i < 3; ++i) {
            expect(corner[i] > -most && corner[i] < most, "a node is not in its place");
        }
        expect((corner & (vdb_upper_node_edge - 1)) == Coord(0), "a node is not in its place");
        const std::array<int, 3> key = {corner[0], corner[1], corner[2]};
        expect(!tree_.root_tiles.contains(key) && !tree_.root_children.contains(key),
               "two nodes are in the same place");
        return corner;
    }

    void read_root_tile() {
        const Coord corner = read_corner();
        const float value = number_of(read_raw<Value>(in_), grid_.component);
        const bool is_active = read_raw<std::int8_t>(in_) != 0;
        tree_.root_tiles[{corner[0], corner[1], corner[2]}] =
            tile_value(value, corner, vdb_upper_node_edge);
        if (is_active) add_active(corner, vdb_upper_node_edge);
    }

    void add_active(const Coord& corner, int edge) {
        const Vector first = vector_at(corner);
        tree_.active.add(first, {first[0] + edge - 1, first[1] + edge - 1, first[2] + edge - 1});
    }

    // Reads the masks and tiles of a node and calls `child` with the corner of each of its children.
    template <class Node, class Visit>
    void read_node(const Coord& corner, std::vector<NodePlaces<Node>>& nodes,
                   std::size_t first_child, const Visit& child) {
        typename Node::NodeMaskType children, active;
        children.load(in_);
        active.load(in_);
        std::vector<Value> stored(Node::NUM_VALUES);
        end_of_values(in_, input_.file_size(), Node::NUM_VALUES, active.countOn(), size_);
        io::readCompressedValues(in_, stored.data(), Node::NUM_VALUES, active, half_);
        std::vector<float> tiles(Node::NUM_VALUES);
        std::transform(stored.begin(), stored.end(), tiles.begin(),
                       [&](const Value& value) { return number_of(value, grid_.component); });
        constexpr int edge = Node::ChildNodeType::DIM;
        const auto corner_of = [&](openvdb::Index place) {
            Coord local;
            Node::offsetToLocalCoord(place, local);
            return corner + Coord(local[0] * edge, local[1] * edge, local[2] * edge);
        };
        for (openvdb::Index i = 0; i < Node::NUM_VALUES; ++i) {
            if (children.isOn(i)) continue;
            tiles[i] = tile_value(tiles[i], corner_of(i), edge);
            if (active.isOn(i)) add_active(corner_of(i), edge);
        }
        nodes.emplace_back(children, std::move(tiles), first_child);
        for (auto place = children.beginOn(); place; ++place) child(corner_of(place.pos()));
    }

    void read_upper() {
        const Coord corner = read_corner();
        tree_.root_children[{corner[0], corner[1], corner[2]}] = tree_.upper.size();
        read_node<UpperNode>(corner, tree_.upper, tree_.lower.size(), [&](const Coord& lower) {
            read_node<LowerNode>(lower, tree_.lower, tree_.leaves.size(),
                                 [&](const Coord& leaf) { read_leaf_mask(leaf); });
        });
    }

    void read_leaf_mask(const Coord& corner) {
        Leaf::NodeMaskType active;
        active.load(in_);
        tree_.leaves.emplace_back().corner = {corner[0], corner[1], corner[2]};
        const Vector from = vector_at(corner);
        if (active.isOn()) return add_active(corner, vdb_leaf_edge);
        for (auto voxel = active.beginOn(); voxel; ++voxel) {
            const Coord local = Leaf::offsetToLocalCoord(voxel.pos());
            const Vector at = {from[0] + local[0], from[1] + local[1], from[2] + local[2]};
            tree_.active.add(at, at);
        }
    }

    void find_leaves() {
        if (!grid_.streamed) grid_.descriptor.seekToBlocks(in_);
        for (LeafRecord& leaf : tree_.leaves) {
            leaf.begin = input_.position();
            Leaf::NodeMaskType active;
            active.load(in_);
            const std::int64_t end =
                end_of_values(in_, input_.file_size(), Leaf::NUM_VALUES, active.countOn(), size_);
            leaf.bytes = static_cast<std::uint32_t>(end - leaf.begin);
            in_.seekg(end);
        }
        expect(grid_.streamed || input_.position() == grid_.descriptor.getEndPos(),
               "its voxels do not end where they should");
    }

    Input& input_;
    std::istream& in_;
    const Grid& grid_;
    const bool half_;
    const ValueSize size_ = size_of_value<Value>(half_);
    GridTree tree_;
};

}  // namespace

GridTree::Place GridTree::find(const Coord& index) const {
    const Coord corner = index & ~(vdb_upper_node_edge - 1);
    const std::array<int, 3> key = {corner[0], corner[1], corner[2]};
    const auto node = root_children.find(key);
    if (node == root_children.end()) {
        const auto tile = root_tiles.find(key);
        const float value = tile == root_tiles.end() ? background : tile->second;
        return {nullptr, density(value), vdb_upper_node_edge};
    }
    const NodePlaces<UpperNode>& of_root = upper[node->second];
    const std::size_t place = UpperNode::coordToOffset(index);
    if (!of_root.has_child(place)) return {nullptr, density(of_root.tile(place)), vdb_node_edge};
    const NodePlaces<LowerNode>& of_upper = lower[of_root.child(place)];
    const std::size_t below = LowerNode::coordToOffset(index);
    if (!of_upper.has_child(below)) return {nullptr, density(of_upper.tile(below)), vdb_leaf_edge};
    return {&leaves[of_upper.child(below)], 0, vdb_leaf_edge};
}

bool is_of_numbers(const Grid& grid) {
    const openvdb::GridBase& base = *grid.grid;
    return base.isType<openvdb::FloatGrid>() || base.isType<openvdb::DoubleGrid>() ||
           base.isType<openvdb::Int32Grid>() || base.isType<openvdb::Int64Grid>();
}

bool is_of_vectors(const Grid& grid) { return grid.grid->isType<openvdb::Vec3SGrid>(); }

GridTree read_grid_tree(Input& input, const Grid& grid) {
    return with_number_type(
        grid, [&]<class Value>(Value) { return TreeReader<Value>(input, grid).read(); });
}

void skip_streamed_grid(Input& input, const Grid& grid) {
    if (grid.descriptor.isInstance()) return;
    if (!is_of_numbers(grid)) {
        throw Damaged(fmt::format("its grid `{}` holds {} and stands before others in a stream, "
                                  "where only grids of numbers are passed over; write a file by "
                                  "openvdb::io::File",
                                  grid.descriptor.gridName(), grid.grid->valueType()));
    }
    read_grid_tree(input, grid);
}

}  // namespace skybake::vdb
