#include "bakers/io/formats/nvdb/nvdb_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace skybake {
namespace {

constexpr std::array<int, 3> edges = {nvdb_leaf_edge, nvdb_lower_edge, nvdb_upper_edge};

bool is_before(const NvdbCube& a, const NvdbCube& b) { return a.corner < b.corner; }

const NvdbCube* cube_at(const std::vector<NvdbCube>& cubes, const std::array<int, 3>& corner) {
    const auto found = std::lower_bound(cubes.begin(), cubes.end(), NvdbCube{corner}, is_before);
    return found != cubes.end() && found->corner == corner ? &*found : nullptr;
}

class NvdbTreeReader {
  public:
    NvdbTreeReader(NvdbInput& file, const NvdbGrid& grid, NvdbTree& tree)
        : file_(file), grid_(grid), tree_(tree) {}

    void read() {
        file_.grid_data(grid_);
        const std::uint64_t root = file_.root_of(grid_);
        std::vector<NvdbUnit> memory;
        file_.read_node<NvdbRoot>(grid_.begin + root, memory);
        const auto& data = *reinterpret_cast<const NvdbRoot*>(memory.data());
        tree_.background = data.mBackground;
        take(data.mBackground);
        for (nanovdb::Coord::IndexType axis = 0; axis < 3; ++axis) {
            tree_.first[axis] = data.mBBox.min()[axis];
            tree_.last[axis] = data.mBBox.max()[axis];
        }
        for (std::uint32_t i = 0; i < data.mTableSize; ++i) {
            read_root_tile(root, root + sizeof(NvdbRoot) + i * sizeof(NvdbRoot::Tile));
        }
        for (std::vector<NvdbCube>& cubes : tree_.cubes) {
            std::sort(cubes.begin(), cubes.end(), is_before);
            const auto twice = std::adjacent_find(
                cubes.begin(), cubes.end(),
                [](const auto& a, const auto& b) { return a.corner == b.corner; });
            expect_nvdb(twice == cubes.end(), "nodes are listed twice");
        }
    }

  private:
    void take(float value) {
        tree_.has_finite_tiles = tree_.has_finite_tiles && std::isfinite(value);
        tree_.least_tile = std::min(tree_.least_tile, value);
        tree_.largest_tile = std::max(tree_.largest_tile, value);
    }

    void add_tile(std::size_t level, const std::array<int, 3>& corner, float value) {
        take(value);
        if (value == tree_.background) return;
        tree_.cubes[level].push_back({corner, value, 0});
    }

    // Counts a node of so many bytes. The grid has room for some number of them.
    void count(std::size_t level, std::uint64_t bytes) {
        expect_nvdb(++nodes_[level] <= grid_.head.grid_size / bytes, "nodes are listed twice");
    }

    void read_root_tile(std::uint64_t root, std::uint64_t at) {
        const auto tile = file_.read<NvdbRoot::Tile>(grid_.begin + at);
        const nanovdb::Coord origin = tile.origin();
        const std::array<int, 3> corner = {origin[0], origin[1], origin[2]};
        // Indices stay far from where they would overflow.
        constexpr int most = 1 << 30;
        for (const int i : corner) {
            expect_nvdb(i > -most && i < most && i % nvdb_upper_edge == 0,
                        "a node is not in its place");
        }
        if (tile.child == 0) return add_tile(2, corner, tile.value);
        count(2, sizeof(NvdbUpper));
        const std::uint64_t node = checked_nvdb_offset(grid_, root, tile.child, sizeof(NvdbUpper));
        read_inner<NvdbUpper>(node, 1, 5, corner);
    }

    // Reads a node whose children and tiles are of a level.
    template <class Node>
    void read_inner(std::uint64_t node, std::size_t level, int log2_edge,
                    const std::array<int, 3>& origin) {
        std::vector<NvdbUnit> memory;
        file_.read_node<Node>(grid_.begin + node, memory);
        const auto& data = *reinterpret_cast<const Node*>(memory.data());
        for (std::uint32_t i = 0; i < 1U << 3 * log2_edge; ++i) {
            std::array<int, 3> corner = nvdb_place(i, log2_edge);
            for (std::size_t a = 0; a < 3; ++a) corner[a] = origin[a] + corner[a] * edges[level];
            if (!data.mChildMask.isOn(i)) {
                add_tile(level, corner, data.mTable[i].value);
            } else if (level == 1) {
                count(1, sizeof(NvdbLower));
                read_inner<NvdbLower>(
                    checked_nvdb_offset(grid_, node, data.mTable[i].child, sizeof(NvdbLower)), 0, 4,
                    corner);
            } else {
                const std::size_t bytes = nvdb_leaf_bytes(grid_.head.type);
                count(0, bytes);
                tree_.cubes[0].push_back(
                    {corner, 0,
                     grid_.begin + checked_nvdb_offset(grid_, node, data.mTable[i].child, bytes)});
            }
        }
    }

    NvdbInput& file_;
    const NvdbGrid& grid_;
    NvdbTree& tree_;
    std::array<std::uint64_t, 3> nodes_{};
};

}  // namespace

NvdbTree::NvdbTree(NvdbInput& file, const NvdbGrid& grid) {
    NvdbTreeReader(file, grid, *this).read();
}

const NvdbCube* NvdbTree::find(const std::array<int, 3>& corner) const {
    for (std::size_t level = 0; level < edges.size(); ++level) {
        std::array<int, 3> aligned = corner;
        for (int& i : aligned) i &= ~(edges[level] - 1);
        if (const NvdbCube* cube = cube_at(cubes[level], aligned)) return cube;
    }
    return nullptr;
}

}  // namespace skybake
