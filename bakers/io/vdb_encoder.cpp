#include "bakers/io/vdb_encoder.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>

#include <map>
#include <ostream>
#include <stdexcept>
#include <streambuf>

#include "bakers/io/vdb_library.h"

namespace skybake::vdb {
namespace {

using config::VdbCompression;
namespace io = openvdb::io;

constexpr float background = 0;
constexpr std::size_t uuid_at = 21;  // behind the magic number, three versions and a flag
constexpr std::size_t uuid_length = 36;

// --- Streams ------------------------------------------------------------------------------------

class StringBuffer : public std::streambuf {
  public:
    explicit StringBuffer(std::string& bytes) : bytes_(bytes) {}

  protected:
    std::streamsize xsputn(const char* data, std::streamsize size) override {
        bytes_.append(data, static_cast<std::size_t>(size));
        return size;
    }
    int_type overflow(int_type byte) override {
        if (!traits_type::eq_int_type(byte, traits_type::eof())) {
            bytes_.push_back(traits_type::to_char_type(byte));
        }
        return traits_type::not_eof(byte);
    }

  private:
    std::string& bytes_;
};

// Appends to a string what the library writes.
class StringOutput {
  public:
    explicit StringOutput(std::string& bytes) : buffer_(bytes), stream_(&buffer_) {}
    StringOutput(std::string& bytes, std::uint32_t compression_flags) : StringOutput(bytes) {
        io::setDataCompression(stream_, compression_flags);
        io::setGridBackgroundValuePtr(stream_, &background);
    }
    operator std::ostream&() { return stream_; }

  private:
    StringBuffer buffer_;
    std::ostream stream_;
};

template <class T>
void write_raw(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof(T));
}

// The library's own io::File drops ZIP for fog volumes, though every reader takes it; here what was
// asked for is what is written.
std::uint32_t compression_flags(VdbCompression compression) {
    constexpr std::uint32_t inactive_values_left_out = io::COMPRESS_ACTIVE_MASK;
    switch (compression) {
        case VdbCompression::zip:
            return inactive_values_left_out | io::COMPRESS_ZIP;
        case VdbCompression::blosc:
            return inactive_values_left_out | io::COMPRESS_BLOSC;
        case VdbCompression::none:
            break;
    }
    return inactive_values_left_out;
}

// --- Heads --------------------------------------------------------------------------------------

struct HeaderWriter : io::Archive {
    using Archive::writeHeader;
};

void insert(openvdb::MetaMap& map, const Attributes& attributes) {
    for (const auto& [name, text] : attributes) {
        map.insertMeta(name, openvdb::StringMetadata(text));
    }
}

openvdb::math::Transform::Ptr transform_of(const VdbGridDescription& grid) {
    const auto& h = grid.voxel_size;
    const openvdb::Vec3d edges(h[0], h[1], h[2]);
    const auto& c = grid.first_centre;
    const openvdb::Vec3d centre(c[0], c[1], c[2]);
    openvdb::math::MapBase::Ptr map;
    if (h[0] == h[1] && h[1] == h[2]) {
        map.reset(new openvdb::math::UniformScaleTranslateMap(h[0], centre));
    } else {
        map.reset(new openvdb::math::ScaleTranslateMap(edges, centre));
    }
    return openvdb::math::Transform::Ptr(new openvdb::math::Transform(map));
}

// The figures that readers take instead of visiting the tree. How much memory the tree takes is not
// among them: it depends on the reader.
void insert_statistics(openvdb::MetaMap& map, const std::array<int, 3>& size,
                       std::uint32_t compression) {
    using openvdb::GridBase;
    map.insertMeta(GridBase::META_FILE_BBOX_MIN, openvdb::Vec3IMetadata(openvdb::Vec3i(0)));
    map.insertMeta(GridBase::META_FILE_BBOX_MAX,
                   openvdb::Vec3IMetadata(openvdb::Vec3i(size[0] - 1, size[1] - 1, size[2] - 1)));
    map.insertMeta(GridBase::META_FILE_VOXEL_COUNT,
                   openvdb::Int64Metadata(VoxelBox{{}, size}.count()));
    map.insertMeta(GridBase::META_FILE_COMPRESSION,
                   openvdb::StringMetadata(io::compressionToString(compression)));
}

// --- Trees --------------------------------------------------------------------------------------

// A node with children within `size` and nothing else, up to those children.
template <class Node>
void write_node(StringOutput& out, const std::array<int, 3>& size, int child_edge, bool half) {
    const auto children = entries_within<Node>(size, child_edge);
    const typename Node::NodeMaskType active_tiles;
    children.save(out);
    active_tiles.save(out);
    std::vector<float> tiles(Node::NUM_VALUES, background);
    io::writeCompressedValues(out, tiles.data(), Node::NUM_VALUES, active_tiles, children, half);
}

std::string root_bytes(std::size_t children) {
    std::string bytes;
    StringOutput out(bytes);
    write_raw(out, std::int32_t{1});  // buffers per leaf
    write_raw(out, background);
    write_raw(out, openvdb::Index{0});  // tiles
    write_raw(out, static_cast<openvdb::Index>(children));
    return bytes;
}

std::string upper_node_bytes(const VoxelBox& box, VdbEncoding encoding) {
    std::string bytes;
    StringOutput out(bytes, compression_flags(encoding.compression));
    for (const std::int32_t coordinate : box.origin) write_raw(out, coordinate);
    write_node<UpperNode>(out, box.size, vdb_node_edge, encoding.half);
    return bytes;
}

// A node of 128^3 with its leaves: it depends on its size alone.
std::string lower_node_bytes(const std::array<int, 3>& size, VdbEncoding encoding) {
    std::string bytes;
    StringOutput out(bytes, compression_flags(encoding.compression));
    write_node<LowerNode>(out, size, vdb_leaf_edge, encoding.half);
    for (const VoxelBox& leaf : cells_in_tree_order({{}, size}, vdb_leaf_edge)) {
        voxels_within(leaf.size).save(out);
    }
    return bytes;
}

// --- Voxels -------------------------------------------------------------------------------------

// The values of a leaf in the order of the file, z fastest.
std::size_t gather(const VoxelBox& strip, const float* values, const VoxelBox& leaf, float* out) {
    std::array<std::ptrdiff_t, 3> first{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = leaf.origin[axis] - strip.origin[axis];
    }
    const std::ptrdiff_t row = strip.size[0];
    const std::ptrdiff_t plane = row * strip.size[1];
    const float* const corner = values + first[2] * plane + first[1] * row + first[0];
    const auto [width, height, depth] = leaf.size;
    for (int z = 0; z < depth; ++z) {
        for (int y = 0; y < height; ++y) {
            const float* const from = corner + z * plane + y * row;
            float* const to = out + y * depth + z;
            for (int x = 0; x < width; ++x) to[x * height * depth] = from[x];
        }
    }
    return static_cast<std::size_t>(leaf.count());
}

// As LeafNode::writeBuffers, for a leaf whose inactive values are all the background.
void write_leaf(std::ostream& out, const Leaf::NodeMaskType& active, const float* values,
                std::size_t count, VdbEncoding encoding) {
    active.save(out);
    write_raw(out, std::int8_t{io::NO_MASK_OR_INACTIVE_VALS});
    const std::uint32_t flags = compression_flags(encoding.compression);
    const auto size = static_cast<openvdb::Index>(count);
    if (encoding.half) {
        io::HalfWriter<true, float>::write(out, values, size, flags);
    } else {
        io::writeData(out, values, size, flags);
    }
}

}  // namespace

std::string file_head(const std::string& uuid, const Attributes& attributes, int grids) {
    std::string bytes;
    StringOutput out(bytes);
    HeaderWriter().writeHeader(out, true);
    if (bytes.size() != uuid_at + uuid_length || uuid.size() != uuid_length) {
        throw std::runtime_error("the head of a VDB file is not as expected");
    }
    bytes.replace(uuid_at, uuid_length, uuid);  // the library's is random
    openvdb::MetaMap map;
    insert(map, attributes);
    map.writeMeta(out);
    write_raw(out, std::int32_t{grids});
    return bytes;
}

VdbGridHead grid_head(const VdbGridDescription& description) {
    const std::uint32_t flags = compression_flags(description.encoding.compression);
    const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(background);
    grid->setName(description.name);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setSaveFloatAsHalf(description.encoding.half);
    grid->setTransform(transform_of(description));
    insert(*grid, description.metadata);
    insert_statistics(*grid, description.size, flags);

    VdbGridHead head;
    StringOutput out(head.bytes);
    const io::GridDescriptor descriptor(description.name, grid->type(), description.encoding.half);
    descriptor.writeHeader(out);
    head.positions_at = head.bytes.size();
    descriptor.writeStreamPos(out);
    head.grid_at = head.bytes.size();
    write_raw(out, flags);
    grid->writeMeta(out);
    grid->writeTransform(out);
    return head;
}

std::string grid_positions(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end) {
    std::string bytes;
    StringOutput out(bytes);
    io::GridDescriptor descriptor;
    descriptor.setGridPos(static_cast<std::int64_t>(grid));
    descriptor.setBlockPos(static_cast<std::int64_t>(voxels));
    descriptor.setEndPos(static_cast<std::int64_t>(end));
    descriptor.writeStreamPos(out);
    return bytes;
}

void topology(const std::array<int, 3>& size, VdbEncoding encoding,
              const std::function<bool(std::string_view)>& sink) {
    std::map<std::array<int, 3>, std::string> lower_nodes;  // at most eight sizes
    const auto upper_boxes = cells_in_tree_order({{}, size}, vdb_upper_node_edge);
    if (!sink(root_bytes(upper_boxes.size()))) return;
    for (const VoxelBox& upper : upper_boxes) {
        if (!sink(upper_node_bytes(upper, encoding))) return;
        for (const VoxelBox& lower : cells_in_tree_order(upper, vdb_node_edge)) {
            std::string& bytes = lower_nodes[lower.size];
            if (bytes.empty()) bytes = lower_node_bytes(lower.size, encoding);
            if (!sink(bytes)) return;
        }
    }
}

void encode_strip(const VoxelBox& strip, const float* values, VdbEncoding encoding,
                  VdbStrip& encoded) {
    encoded.bytes.clear();
    encoded.column_ends.clear();
    StringOutput out(encoded.bytes);
    std::array<float, Leaf::NUM_VALUES> leaf_values;
    int column = strip.origin[0];
    for (const VoxelBox& leaf : cells_in_tree_order(strip, vdb_leaf_edge)) {
        if (leaf.origin[0] != column) encoded.column_ends.push_back(encoded.bytes.size());
        column = leaf.origin[0];
        const std::size_t count = gather(strip, values, leaf, leaf_values.data());
        write_leaf(out, voxels_within(leaf.size), leaf_values.data(), count, encoding);
    }
    encoded.column_ends.push_back(encoded.bytes.size());
}

}  // namespace skybake::vdb
