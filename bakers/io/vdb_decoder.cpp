#include "bakers/io/vdb_decoder.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

#include "bakers/io/file_diagnostic.h"
#include "bakers/io/vdb_library.h"

namespace skybake::vdb {
namespace {

using config::Outcome;
namespace io = openvdb::io;

// A file that is not what it should be; caught at the end of this file.
struct Damaged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

void expect(bool condition, const char* what) {
    if (!condition) throw Damaged(what);
}

template <class T>
T read_raw(std::istream& in) {
    T value;
    in.read(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
}

// --- Heads --------------------------------------------------------------------------------------

// The first format with a mask in each node, of 2012; and the last one that the library knows.
constexpr std::uint32_t oldest_format = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
constexpr std::uint32_t newest_format = openvdb::OPENVDB_FILE_VERSION;

// A file read with what io::Archive has for classes that derive from it.
//
// The library allocates what a file's lengths ask for before it finds that the file ends, 4 GiB for
// one flipped bit; so lengths are looked at before the library reads.
class Input : public io::Archive {
  public:
    // Reads the head of the file; the stream throws from now on where the file ends early.
    explicit Input(const std::filesystem::path& path) : stream_(path, std::ios::binary) {
        stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        stream_.seekg(0, std::ios::end);
        file_size_ = stream_.tellg();
        stream_.seekg(0);
        expect(read_raw<std::int64_t>(stream_) == openvdb::OPENVDB_MAGIC, "it begins otherwise");
        const auto format = read_raw<std::uint32_t>(stream_);
        expect(format >= oldest_format && format <= newest_format, "its format is not known");
        stream_.seekg(0);
        readHeader(stream_);
        expect(inputHasGridOffsets(), "it does not say where its grids are");
        metadata_->setSeekable(true);
        io::setStreamMetadataPtr(stream_, metadata_, false);
        setFormatVersion(stream_);
        setLibraryVersion(stream_);
    }
    std::istream& stream() { return stream_; }
    std::int64_t position() { return stream_.tellg(); }
    std::int64_t file_size() const { return file_size_; }

    std::int32_t read_grid_count() { return readGridCount(stream_); }
    std::uint32_t read_compression() {
        readGridCompression(stream_);
        return io::getDataCompression(stream_);
    }
    void read_metadata(openvdb::MetaMap& map) {
        const auto begin = stream_.tellg();
        for (auto entries = read_raw<std::uint32_t>(stream_); entries > 0; --entries) {
            skip_sized(3);  // name, type, value
        }
        stream_.seekg(begin);
        map.readMeta(stream_);
    }
    openvdb::GridBase::Ptr read_descriptor(io::GridDescriptor& descriptor) {
        const auto begin = stream_.tellg();
        skip_sized(3);  // the names of grid, type and parent
        stream_.seekg(begin);
        return descriptor.read(stream_);
    }
    void read_transform(openvdb::GridBase& grid) {
        const auto begin = stream_.tellg();
        skip_sized(1);  // the name of its kind
        stream_.seekg(begin);
        grid.readTransform(stream_);
    }

  private:
    // Skips a length and so many bytes, `count` times.
    void skip_sized(int count) {
        for (; count > 0; --count) {
            const std::int64_t length = read_raw<std::uint32_t>(stream_);
            expect(position() + length <= file_size_, "it ends early");
            stream_.seekg(length, std::ios::cur);
        }
    }

    io::StreamMetadata::Ptr metadata_{new io::StreamMetadata};  // outlives the stream
    std::ifstream stream_;
    std::int64_t file_size_ = 0;
};

struct Grid {
    io::GridDescriptor descriptor;
    openvdb::GridBase::Ptr grid;  // its metadata and transform, no tree
    std::uint32_t compression = 0;
    std::int64_t tree_at = 0;
};

std::vector<Grid> read_grid_heads(Input& input) {
    std::vector<Grid> grids;
    const std::int32_t count = input.read_grid_count();
    for (std::int32_t i = 0; i < count; ++i) {
        Grid& head = grids.emplace_back();
        head.grid = input.read_descriptor(head.descriptor);
        head.descriptor.seekToGrid(input.stream());
        head.compression = input.read_compression();
        input.read_metadata(*head.grid);
        input.read_transform(*head.grid);
        head.tree_at = input.position();
        head.descriptor.seekToEnd(input.stream());
    }
    return grids;
}

// The texts of a map by name, without what helps OpenVDB to find its way in the file.
Attributes texts_of(const openvdb::MetaMap& map) {
    Attributes attributes;
    for (auto entry = map.beginMeta(); entry != map.endMeta(); ++entry) {
        if (entry->first == openvdb::GridBase::META_FILE_DELAYED_LOAD) continue;
        attributes.emplace_back(entry->first, entry->second->str());
    }
    return attributes;
}

std::array<std::int64_t, 3> corner(const openvdb::GridBase& grid, const char* name) {
    const auto found = grid.getMetadata<openvdb::Vec3IMetadata>(name);
    if (!found) return {};
    const openvdb::Vec3i value = found->value();
    return {value[0], value[1], value[2]};
}

VdbGrid describe(const Grid& head) {
    const openvdb::GridBase& grid = *head.grid;
    VdbGrid described;
    described.name = io::GridDescriptor::nameAsString(head.descriptor.uniqueName());
    described.type = grid.type();
    described.grid_class = openvdb::GridBase::gridClassToString(grid.getGridClass());
    described.compression = io::compressionToString(head.compression);
    const openvdb::Vec3d edges = grid.voxelSize();
    const openvdb::Vec3d centre = grid.transform().indexToWorld(openvdb::Coord(0, 0, 0));
    described.voxel_size = {edges[0], edges[1], edges[2]};
    described.first_centre = {centre[0], centre[1], centre[2]};
    described.first_active = corner(grid, openvdb::GridBase::META_FILE_BBOX_MIN);
    described.last_active = corner(grid, openvdb::GridBase::META_FILE_BBOX_MAX);
    using openvdb::Int64Metadata;
    const auto count = grid.getMetadata<Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
    if (count) described.active_voxels = count->value();
    described.half = head.descriptor.saveFloatAsHalf();
    described.metadata = texts_of(grid);
    return described;
}

// --- Trees --------------------------------------------------------------------------------------

// Reads a node's masks and tiles, which are to be those of a dense volume.
template <class Node>
void expect_dense_node(std::istream& in, const std::array<int, 3>& size, int child_edge,
                       bool half) {
    typename Node::NodeMaskType children, active_tiles;
    children.load(in);
    active_tiles.load(in);
    expect(children == entries_within<Node>(size, child_edge) && active_tiles.isOff(),
           "its voxels are not a dense box");
    std::vector<float> tiles(Node::NUM_VALUES);
    io::readCompressedValues(in, tiles.data(), Node::NUM_VALUES, active_tiles, half);
}

void expect_dense_tree(std::istream& in, const std::array<int, 3>& size, bool half) {
    const auto upper_boxes = cells_in_tree_order({{}, size}, vdb_upper_node_edge);
    expect(read_raw<std::int32_t>(in) == 1, "its leaves have several buffers");
    expect(read_raw<float>(in) == 0, "its background is not 0");
    const auto tiles = read_raw<openvdb::Index>(in);
    const auto children = read_raw<openvdb::Index>(in);
    expect(tiles == 0 && children == upper_boxes.size(), "its voxels are not a dense box");
    for (const VoxelBox& upper : upper_boxes) {
        for (const std::int32_t coordinate : upper.origin) {
            expect(read_raw<std::int32_t>(in) == coordinate, "its voxels are not a dense box");
        }
        expect_dense_node<UpperNode>(in, upper.size, vdb_node_edge, half);
        for (const VoxelBox& lower : cells_in_tree_order(upper, vdb_node_edge)) {
            expect_dense_node<LowerNode>(in, lower.size, vdb_leaf_edge, half);
            for (const VoxelBox& leaf : cells_in_tree_order(lower, vdb_leaf_edge)) {
                Leaf::NodeMaskType active;
                active.load(in);
                expect(active == voxels_within(leaf.size), "its voxels are not a dense box");
            }
        }
    }
}

// --- Voxels -------------------------------------------------------------------------------------

// Where the leaves of a dense volume's grids are in the file.
class DenseVolume {
  public:
    DenseVolume(Input& input, std::vector<Grid> grids) : input_(input), grids_(std::move(grids)) {
        expect(!grids_.empty(), "it has no grids");
        put_in_order();
        find_size();
        for (const Grid& grid : grids_) leaves_.push_back(find_leaves(grid));
    }

    const std::array<int, 3>& size() const { return size_; }

    // `slab` begins at a multiple of 8 and is a layer of leaves.
    void read(VdbSlab& slab) {
        slab.voxels.resize(
            grids_.size() *
            static_cast<std::size_t>(VoxelBox{{}, {size_[0], size_[1], slab.depth}}.count()));
        const VoxelBox layer = {{0, 0, slab.first_z}, {size_[0], size_[1], slab.depth}};
        for (std::size_t channel = 0; channel < grids_.size(); ++channel) {
            use(grids_[channel]);
            for (const VoxelBox& leaf : cells_in_tree_order(layer, vdb_leaf_edge)) {
                read_leaf(channel, leaf, slab);
            }
        }
    }

  private:
    void put_in_order();
    void find_size();
    std::vector<std::int64_t> find_leaves(const Grid& grid);
    void read_leaf(std::size_t channel, const VoxelBox& leaf, VdbSlab& slab);

    // Makes the stream one of the grid.
    void use(const Grid& grid) {
        static constexpr float background = 0;
        io::setDataCompression(input_.stream(), grid.compression);
        io::setGridBackgroundValuePtr(input_.stream(), &background);
    }
    std::size_t leaf_index(const std::array<int, 3>& origin) const {
        const auto at = [&](std::size_t axis) {
            return static_cast<std::size_t>(origin[axis] / vdb_leaf_edge);
        };
        return (at(0) * leaf_counts_[1] + at(1)) * leaf_counts_[2] + at(2);
    }

    Input& input_;
    std::vector<Grid> grids_;
    std::array<int, 3> size_{};
    std::array<std::size_t, 3> leaf_counts_{};
    std::vector<std::vector<std::int64_t>> leaves_;  // per grid, by leaf_index
};

// Puts the grids in the order of channels.
void DenseVolume::put_in_order() {
    constexpr std::string_view channels = "RGBA";
    const auto rank = [&](const Grid& grid) {
        const std::string& name = grid.descriptor.gridName();
        if (name == "density" && grids_.size() == 1) return std::size_t{0};
        const std::size_t found = name.size() == 1 ? channels.find(name) : std::string::npos;
        expect(found != std::string::npos, "its grids have other names than density or R, G, B, A");
        return found;
    };
    std::vector<Grid> sorted(channels.size());
    for (Grid& grid : grids_) {
        expect(grid.grid->isType<openvdb::FloatGrid>(), "a grid does not hold floats");
        expect(!grid.descriptor.isInstance(), "grids share a tree");
        Grid& place = sorted[rank(grid)];
        expect(place.grid == nullptr, "two grids have one name");
        place = grid;
    }
    sorted.resize(grids_.size());
    for (const Grid& grid : sorted) expect(grid.grid != nullptr, "a channel is missing");
    grids_ = std::move(sorted);
}

void DenseVolume::find_size() {
    const VdbGrid first = describe(grids_[0]);
    double leaves = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t last = first.last_active[axis];
        expect(last >= 0 && last < std::numeric_limits<int>::max(), "its bounds are damaged");
        size_[axis] = static_cast<int>(last) + 1;
        leaf_counts_[axis] = static_cast<std::size_t>(last) / vdb_leaf_edge + 1;
        leaves *= static_cast<double>(leaf_counts_[axis]);
    }
    // A damaged size must not have memory allocated: each leaf takes its mask at least.
    expect(leaves * sizeof(Leaf::NodeMaskType) < static_cast<double>(input_.file_size()),
           "it is too small for its bounds");
    for (const Grid& grid : grids_) {
        const VdbGrid described = describe(grid);
        expect(described.first_active == std::array<std::int64_t, 3>{} &&
                   described.last_active == first.last_active,
               "its grids do not have one box that begins at the origin");
    }
}

std::vector<std::int64_t> DenseVolume::find_leaves(const Grid& grid) {
    std::istream& in = input_.stream();
    const bool half = grid.descriptor.saveFloatAsHalf();
    use(grid);
    in.seekg(grid.tree_at);
    expect_dense_tree(in, size_, half);
    grid.descriptor.seekToBlocks(in);
    std::vector<std::int64_t> positions(leaf_counts_[0] * leaf_counts_[1] * leaf_counts_[2]);
    for (const VoxelBox& upper : cells_in_tree_order({{}, size_}, vdb_upper_node_edge)) {
        for (const VoxelBox& lower : cells_in_tree_order(upper, vdb_node_edge)) {
            for (const VoxelBox& leaf : cells_in_tree_order(lower, vdb_leaf_edge)) {
                positions[leaf_index(leaf.origin)] = input_.position();
                Leaf::NodeMaskType active;
                active.load(in);
                // Null: skip the values.
                io::readCompressedValues<float>(in, nullptr, Leaf::NUM_VALUES, active, half);
            }
        }
    }
    expect(input_.position() == grid.descriptor.getEndPos(),
           "its voxels do not end where they should");
    return positions;
}

void DenseVolume::read_leaf(std::size_t channel, const VoxelBox& leaf, VdbSlab& slab) {
    std::istream& in = input_.stream();
    in.seekg(leaves_[channel][leaf_index(leaf.origin)]);
    Leaf::NodeMaskType active;
    active.load(in);
    expect(active == voxels_within(leaf.size), "its voxels are not a dense box");
    std::array<float, Leaf::NUM_VALUES> values;
    io::readCompressedValues(in, values.data(), Leaf::NUM_VALUES, active,
                             grids_[channel].descriptor.saveFloatAsHalf());
    const std::size_t channels = grids_.size();
    for (int z = 0; z < leaf.size[2]; ++z) {
        for (int y = 0; y < leaf.size[1]; ++y) {
            const std::int64_t row = std::int64_t{z} * size_[1] + leaf.origin[1] + y;
            const std::int64_t voxel = row * size_[0] + leaf.origin[0];
            float* const to =
                slab.voxels.data() + static_cast<std::size_t>(voxel) * channels + channel;
            for (int x = 0; x < leaf.size[0]; ++x) {
                to[static_cast<std::size_t>(x) * channels] = values[Leaf::coordToOffset({x, y, z})];
            }
        }
    }
}

// --- Outcomes -----------------------------------------------------------------------------------

template <class T, class Function>
Outcome<T> reported(const std::filesystem::path& path, Function&& function) {
    std::string reason;
    try {
        static const bool types_are_known = (openvdb::initialize(), true);
        static_cast<void>(types_are_known);
        return {function(), {}};
    } catch (const std::ios::failure&) {
        reason = "it ends early";
    } catch (const std::exception& error) {
        reason = error.what();
    }
    return {{},
            {file_error("E0304", path.string(),
                        fmt::format("cannot read `{}` as a VDB file: {}", path.string(), reason))}};
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
        DenseVolume volume(input, read_grid_heads(input));
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
