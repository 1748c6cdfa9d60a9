#include "bakers/io/formats/vdb/vdb_library.h"

#include <fmt/format.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <optional>

#include "bakers/io/formats/vdb/vdb_input.h"

namespace skybake::vdb {
namespace {

using config::Outcome;
namespace io = openvdb::io;

// "float", "half", "int32", "vec3s", "bool", "points", "mask".
std::string value_type_of(const openvdb::GridBase& grid, bool half) {
    // The library calls the values of a mask bool; its tree is Tree_mask_5_4_3.
    const std::string tree = grid.type();
    const std::size_t begin = tree.find('_') + 1;
    const std::string type = tree.substr(begin, tree.find('_', begin) - begin);
    if (type.starts_with("ptdataidx")) return "points";
    return half && type == "float" ? "half" : type;
}

VdbGrid describe(const Grid& head) {
    using openvdb::GridBase;
    const GridBase& grid = *head.grid;
    VdbGrid described;
    described.name = io::GridDescriptor::nameAsString(head.descriptor.uniqueName());
    described.half = head.descriptor.saveFloatAsHalf();
    described.type = grid.type();
    described.value_type = value_type_of(grid, described.half);
    described.grid_class = GridBase::gridClassToString(grid.getGridClass());
    described.compression = io::compressionToString(head.compression);
    const openvdb::Vec3d edges = grid.voxelSize();
    const openvdb::Vec3d centre = grid.transform().indexToWorld(openvdb::Coord(0, 0, 0));
    described.voxel_size = {edges[0], edges[1], edges[2]};
    described.first_centre = {centre[0], centre[1], centre[2]};
    const auto first = stated_vector(grid, GridBase::META_FILE_BBOX_MIN);
    const auto last = stated_vector(grid, GridBase::META_FILE_BBOX_MAX);
    described.states_active = first && last;
    for (std::size_t i = 0; described.states_active && i < 3; ++i) {
        described.first_active[i] = (*first)[i];
        described.last_active[i] = (*last)[i];
        described.empty = described.empty || (*last)[i] < (*first)[i];
    }
    described.size =
        stated_vector(grid, vdb_size_name).value_or(
            Vector{described.last_active[0] + 1, described.last_active[1] + 1,
                   described.last_active[2] + 1});
    using openvdb::Int64Metadata;
    const auto count = grid.getMetadata<Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
    if (count) described.active_voxels = count->value();
    described.empty = described.empty || (count && count->value() == 0);
    described.metadata = texts_of(grid);
    return described;
}

// --- Trees --------------------------------------------------------------------------------------

using Coord = openvdb::Coord;

// A leaf of a grid: where it is among the leaves of the volume, and in the file.
struct LeafEntry {
    std::array<std::uint16_t, 3> leaf{};
    std::int64_t position = 0;
};

// Reads a node's masks and tiles. Returns the corners of its children, in the file's order.
template <class Node>
std::vector<Coord> read_node(std::istream& in, std::int64_t file_size, const Coord& corner,
                             bool half) {
    typename Node::NodeMaskType children, active_tiles;
    children.load(in);
    active_tiles.load(in);
    expect(active_tiles.isOff(), "it has active tiles");
    std::vector<float> tiles(Node::NUM_VALUES);
    end_of_values(in, file_size, Node::NUM_VALUES, 0, size_of_value<float>(half));
    io::readCompressedValues(in, tiles.data(), Node::NUM_VALUES, active_tiles, half);
    std::vector<Coord> corners;
    for (openvdb::Index i = 0; i < Node::NUM_VALUES; ++i) {
        if (!children.isOn(i)) {
            expect(tiles[i] == 0, "it has tiles that are not 0");
            continue;
        }
        Coord local;
        Node::offsetToLocalCoord(i, local);
        constexpr int child_edge = Node::ChildNodeType::DIM;
        corners.push_back(
            corner.offsetBy(local[0] * child_edge, local[1] * child_edge, local[2] * child_edge));
    }
    return corners;
}

// The bounds of the volume, which all leaves of a file must be in.
class Box {
  public:
    explicit Box(const Vector& size) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // The size is checked because a slab of this size is allocated.
            expect(size[axis] > 0 && size[axis] <= most_voxels, "its size is damaged");
            size_[axis] = static_cast<int>(size[axis]);
        }
    }

    const std::array<int, 3>& size() const { return size_; }

    // Returns the part of the leaf that is in the box. Throws if there is none.
    VoxelBox leaf_at(const Coord& corner) const {
        VoxelBox box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int from = corner[axis];
            expect(from >= 0 && from < size_[axis], "it has leaves outside of its size");
            box.origin[axis] = from;
            box.size[axis] = std::min(vdb_leaf_edge, size_[axis] - from);
        }
        return box;
    }

  private:
    static constexpr std::int64_t most_voxels = 16384;  // the most along an axis of a recipe
    std::array<int, 3> size_{};
};

std::array<std::uint16_t, 3> leaf_number(const VoxelBox& leaf) {
    std::array<std::uint16_t, 3> number{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        number[axis] = static_cast<std::uint16_t>(leaf.origin[axis] / vdb_leaf_edge);
    }
    return number;
}

// Reads the leaves of a tree, in the file's order, without their positions.
std::vector<LeafEntry> read_tree(std::istream& in, std::int64_t file_size, const Box& box,
                                 bool half) {
    expect(read_raw<std::int32_t>(in) == 1, "its leaves have several buffers");
    expect(read_raw<float>(in) == 0, "its background is not 0");
    expect(read_raw<openvdb::Index>(in) == 0, "it has tiles of 4096 voxels");
    std::vector<LeafEntry> leaves;
    for (auto children = read_raw<openvdb::Index>(in); children > 0; --children) {
        Coord corner;
        corner.read(in);
        expect((corner & (vdb_upper_node_edge - 1)) == Coord(0), "a node is not in its place");
        for (const Coord& lower : read_node<UpperNode>(in, file_size, corner, half)) {
            for (const Coord& leaf : read_node<LowerNode>(in, file_size, lower, half)) {
                leaves.push_back({leaf_number(box.leaf_at(leaf)), 0});
                in.seekg(sizeof(VdbLeafMask), std::ios::cur);  // it is with the voxels too
            }
        }
    }
    return leaves;
}

// --- Voxels -------------------------------------------------------------------------------------

// The voxels of a file whose grids all have the same size.
class Volume {
  public:
    Volume(Input& input, std::vector<Grid> grids)
        : input_(input), grids_(std::move(grids)), box_(find_size(grids_)) {
        for (const Grid& grid : grids_) leaves_.push_back(find_leaves(grid));
    }

    const std::array<int, 3>& size() const { return box_.size(); }

    // Reads a slab, which begins at a multiple of 8 and is a layer of leaves.
    void read(VdbSlab& slab) {
        const VoxelBox layer = {{}, {size()[0], size()[1], slab.depth}};
        slab.voxels.assign(grids_.size() * static_cast<std::size_t>(layer.count()), 0.0F);
        for (std::size_t channel = 0; channel < grids_.size(); ++channel) {
            use(grids_[channel]);
            const std::vector<LeafEntry>& leaves = leaves_[channel];
            const auto is_below = [](const LeafEntry& leaf, int z) { return leaf.leaf[2] < z; };
            auto leaf = std::lower_bound(leaves.begin(), leaves.end(), slab.first_z / vdb_leaf_edge,
                                         is_below);
            for (; leaf != leaves.end() && leaf->leaf[2] * vdb_leaf_edge == slab.first_z; ++leaf) {
                read_leaf(channel, *leaf, slab);
            }
        }
    }

  private:
    static Vector find_size(const std::vector<Grid>& grids);
    std::vector<LeafEntry> find_leaves(const Grid& grid);
    void read_leaf(std::size_t channel, const LeafEntry& entry, VdbSlab& slab);

    // Sets up the stream for reading the grid.
    void use(const Grid& grid) {
        static constexpr float background = 0;
        io::setDataCompression(input_.stream(), grid.compression);
        io::setGridBackgroundValuePtr(input_.stream(), &background);
    }

    Input& input_;
    std::vector<Grid> grids_;
    Box box_;
    std::vector<std::vector<LeafEntry>> leaves_;  // per grid, layer after layer of z
};

void expect_voxels_within(const std::array<int, 3>& size, const Leaf::NodeMaskType& active,
                          const std::array<float, Leaf::NUM_VALUES>& values) {
    for (auto voxel = active.beginOff(); voxel; ++voxel) {
        expect(values[voxel.pos()] == 0, "it has inactive voxels that are not 0");
    }
    if (size == std::array{vdb_leaf_edge, vdb_leaf_edge, vdb_leaf_edge}) return;
    for (auto voxel = active.beginOn(); voxel; ++voxel) {
        const Coord at = Leaf::offsetToLocalCoord(voxel.pos());
        expect(at[0] < size[0] && at[1] < size[1] && at[2] < size[2],
               "it has voxels outside of its size");
    }
}

Vector Volume::find_size(const std::vector<Grid>& grids) {
    expect(!grids.empty(), "it has no grids");
    const Vector size = describe(grids[0]).size;
    for (const Grid& grid : grids) {
        expect(grid.grid->isType<openvdb::FloatGrid>(), "a grid does not hold floats");
        expect(!grid.descriptor.isInstance(), "grids share a tree");
        expect(!grid.streamed, "it is a stream");
        const VdbGrid described = describe(grid);
        expect(described.size == size, "its grids have different sizes");
        const bool says_size = stated_vector(*grid.grid, vdb_size_name).has_value();
        expect(says_size || described.first_active == Vector{},
               "its voxels do not begin at the origin");
    }
    return size;
}

std::vector<LeafEntry> Volume::find_leaves(const Grid& grid) {
    std::istream& in = input_.stream();
    const bool half = grid.descriptor.saveFloatAsHalf();
    use(grid);
    in.seekg(grid.tree_at);
    std::vector<LeafEntry> leaves = read_tree(in, input_.file_size(), box_, half);
    grid.descriptor.seekToBlocks(in);
    for (LeafEntry& leaf : leaves) {
        leaf.position = input_.position();
        Leaf::NodeMaskType active;
        active.load(in);
        in.seekg(end_of_values(in, input_.file_size(), Leaf::NUM_VALUES, active.countOn(),
                               size_of_value<float>(half)));
    }
    expect(input_.position() == grid.descriptor.getEndPos(),
           "its voxels do not end where they should");
    // The order within a layer stays that of the file, so that the file is read forwards.
    std::stable_sort(leaves.begin(), leaves.end(),
                     [](const LeafEntry& a, const LeafEntry& b) { return a.leaf[2] < b.leaf[2]; });
    return leaves;
}

void Volume::read_leaf(std::size_t channel, const LeafEntry& entry, VdbSlab& slab) {
    std::istream& in = input_.stream();
    in.seekg(entry.position);
    Leaf::NodeMaskType active;
    active.load(in);
    std::array<float, Leaf::NUM_VALUES> values;
    io::readCompressedValues(in, values.data(), Leaf::NUM_VALUES, active,
                             grids_[channel].descriptor.saveFloatAsHalf());
    const auto [x0, y0, z0] = entry.leaf;
    const VoxelBox leaf =
        box_.leaf_at(Coord(x0 * vdb_leaf_edge, y0 * vdb_leaf_edge, z0 * vdb_leaf_edge));
    expect_voxels_within(leaf.size, active, values);
    const std::size_t channels = grids_.size();
    for (int z = 0; z < leaf.size[2]; ++z) {
        for (int y = 0; y < leaf.size[1]; ++y) {
            const std::int64_t row = std::int64_t{z} * size()[1] + leaf.origin[1] + y;
            const std::int64_t voxel = row * size()[0] + leaf.origin[0];
            float* const to =
                slab.voxels.data() + static_cast<std::size_t>(voxel) * channels + channel;
            for (int x = 0; x < leaf.size[0]; ++x) {
                to[static_cast<std::size_t>(x) * channels] = values[Leaf::coordToOffset({x, y, z})];
            }
        }
    }
}

}  // namespace

Outcome<VdbFile> read(const std::filesystem::path& path) {
    return reported<VdbFile>(path, [&] {
        Input input(path);
        VdbFile file;
        file.uuid = input.getUniqueTag();
        file.library = input.version();
        openvdb::MetaMap metadata;
        input.read_metadata(metadata);
        file.attributes = texts_of(metadata);
        for (const Grid& grid : read_grid_heads(input)) file.grids.push_back(describe(grid));
        return file;
    });
}

Outcome<bool> read_voxels(const std::filesystem::path& path,
                          const std::function<bool(const VdbSlab& slab)>& visit) {
    return reported<bool>(path, [&] {
        Input input(path);
        openvdb::MetaMap metadata;
        input.read_metadata(metadata);
        Volume volume(input, read_grid_heads(input));
        VdbSlab slab;
        slab.size = volume.size();
        for (; slab.first_z < slab.size[2]; slab.first_z += vdb_leaf_edge) {
            slab.depth = std::min(vdb_leaf_edge, slab.size[2] - slab.first_z);
            volume.read(slab);
            if (!visit(slab)) return false;
        }
        return true;
    });
}

}  // namespace skybake::vdb
