#include "bakers/io/formats/vdb/vdb_library.h"
#include "config/sections/file_formats.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>

#include <algorithm>
#include <bit>
#include <ostream>
#include <stdexcept>
#include <streambuf>

#include "bakers/field/voxel_index.h"
#include "bakers/math/half_conversion.h"

namespace skybake::vdb {
namespace {

using config::VdbCompression;
namespace io = openvdb::io;

// Of a number or a vector.
constexpr std::array<float, 3> background{};
constexpr std::size_t uuid_at = 21;  // after the magic number, three versions and a flag
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

// A stream that appends what the library writes to a string.
class StringOutput {
  public:
    explicit StringOutput(std::string& bytes) : buffer_(bytes), stream_(&buffer_) {}
    StringOutput(std::string& bytes, std::uint32_t compression_flags) : StringOutput(bytes) {
        io::setDataCompression(stream_, compression_flags);
        io::setGridBackgroundValuePtr(stream_, background.data());
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

// Returns the flags for the requested compression. The library's own io::File drops ZIP for fog
// volumes although every reader accepts it; this encoder writes what was requested.
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

openvdb::Vec3IMetadata vector_of(const std::array<int, 3>& v) {
    return openvdb::Vec3IMetadata(openvdb::Vec3i(v[0], v[1], v[2]));
}

// Adds the figures that readers use instead of visiting the tree. The memory size of the tree is
// not among them, because it depends on the reader.
void insert_statistics(openvdb::MetaMap& map, const VdbActiveVoxels& active,
                       std::uint32_t compression) {
    using openvdb::GridBase;
    map.insertMeta(GridBase::META_FILE_BBOX_MIN, vector_of(active.first));
    map.insertMeta(GridBase::META_FILE_BBOX_MAX, vector_of(active.last));
    map.insertMeta(GridBase::META_FILE_VOXEL_COUNT, openvdb::Int64Metadata(active.count));
    map.insertMeta(GridBase::META_FILE_COMPRESSION,
                   openvdb::StringMetadata(io::compressionToString(compression)));
}

// --- Trees --------------------------------------------------------------------------------------

// Writes a node that has these children and no tiles, without the children themselves.
template <class Node>
void write_node(StringOutput& out, const std::vector<std::uint16_t>& places, VdbEncoding encoding) {
    typename Node::NodeMaskType children;
    for (const std::uint16_t place : places) children.setOn(place);
    const typename Node::NodeMaskType active_tiles;
    children.save(out);
    active_tiles.save(out);
    const auto write_tiles = [&]<class Value>(Value zero) {
        std::vector<Value> tiles(Node::NUM_VALUES, zero);
        io::writeCompressedValues(out, tiles.data(), Node::NUM_VALUES, active_tiles, children,
                                  encoding.half);
    };
    encoding.components == 1 ? write_tiles(float{}) : write_tiles(openvdb::Vec3f(0));
}

// --- Voxels -------------------------------------------------------------------------------------

// Copies the active values of a leaf to every `components`-th float of `out` in the order of the file, z
// fastest, and returns their number. The leaf's first value is at `corner`; `row` and `plane` are the
// distances between values along y and z.
std::size_t gather(const float* corner, std::ptrdiff_t row, std::ptrdiff_t plane,
                   const VdbLeafMask& active, int components, float* out) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    float* const begin = out;
    const auto put = [&out, components](float value) {
        *out = value;
        out += components;
    };
    for (std::size_t x = 0; x < active.size(); ++x) {
        const float* const from = corner + x;
        if (active[x] == all) {
            for (int y = 0; y < vdb_leaf_edge; ++y) {
                for (int z = 0; z < vdb_leaf_edge; ++z) put(from[y * row + z * plane]);
            }
            continue;
        }
        for (std::uint64_t left = active[x]; left != 0; left &= left - 1) {
            const int voxel = std::countr_zero(left);
            put(from[voxel / vdb_leaf_edge * row + voxel % vdb_leaf_edge * plane]);
        }
    }
    return static_cast<std::size_t>((out - begin) / components);
}

// Does what LeafNode::writeBuffers does, for a leaf whose inactive values are all the background. `count` is
// that of components.
void write_leaf(std::ostream& out, const VdbLeafMask& active, const float* values,
                std::size_t count, VdbEncoding encoding) {
    write_raw(out, active);
    write_raw(out, std::int8_t{io::NO_MASK_OR_INACTIVE_VALS});
    const std::uint32_t flags = compression_flags(encoding.compression);
    const auto size = static_cast<openvdb::Index>(count);
    if (!encoding.half) {
        io::writeData(out, values, size, flags);
        return;
    }
    std::array<std::uint16_t, std::size_t{3} * Leaf::NUM_VALUES> halves;
    std::transform(values, values + count, halves.begin(), half_of_float);
    io::writeData(out, halves.data(), size, flags);
}

// --- The functions of VdbCodec ------------------------------------------------------------------

std::string file_head(const std::string& uuid, const Attributes& attributes, int grids) {
    std::string bytes;
    StringOutput out(bytes);
    HeaderWriter().writeHeader(out, true);
    if (bytes.size() != uuid_at + uuid_length || uuid.size() != uuid_length) {
        throw std::runtime_error("the head of a VDB file is not as expected");
    }
    bytes.replace(uuid_at, uuid_length, uuid);  // the library's own UUID is random
    openvdb::MetaMap map;
    insert(map, attributes);
    map.writeMeta(out);
    write_raw(out, std::int32_t{grids});
    return bytes;
}

VdbGridHead grid_head(const VdbGridDescription& description) {
    const std::uint32_t flags = compression_flags(description.encoding.compression);
    const bool is_vector = description.encoding.components > 1;
    openvdb::GridBase::Ptr grid = openvdb::FloatGrid::create();
    if (is_vector) grid = openvdb::Vec3SGrid::create();
    grid->setName(description.name);
    if (is_vector) {
        grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    } else {
        grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    }
    grid->setSaveFloatAsHalf(description.encoding.half);
    grid->setTransform(transform_of(description));
    insert(*grid, description.metadata);
    insert_statistics(*grid, description.active, flags);
    if (description.size) grid->insertMeta(vdb_size_name, vector_of(*description.size));

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

std::string root(std::size_t upper_nodes, VdbEncoding encoding) {
    std::string bytes;
    StringOutput out(bytes);
    write_raw(out, std::int32_t{1});  // buffers per leaf
    for (int i = 0; i < encoding.components; ++i) write_raw(out, background[0]);
    write_raw(out, openvdb::Index{0});  // tiles
    write_raw(out, static_cast<openvdb::Index>(upper_nodes));
    return bytes;
}

std::string upper_node(const std::array<int, 3>& corner, const std::vector<std::uint16_t>& places,
                       VdbEncoding encoding) {
    std::string bytes;
    StringOutput out(bytes, compression_flags(encoding.compression));
    for (const std::int32_t coordinate : corner) write_raw(out, coordinate);
    write_node<UpperNode>(out, places, encoding);
    return bytes;
}

std::string lower_node(const VdbLeaves& leaves, VdbEncoding encoding) {
    std::string bytes;
    StringOutput out(bytes, compression_flags(encoding.compression));
    write_node<LowerNode>(out, leaves.places, encoding);
    for (const VdbLeafMask& active : leaves.active) write_raw(out, active);
    return bytes;
}

void encode_strip(const VoxelBox& strip, const float* values, const VdbLeaves& leaves,
                  VdbEncoding encoding, VdbStrip& encoded) {
    encoded.bytes.clear();
    encoded.column_ends.fill(0);
    StringOutput out(encoded.bytes);
    const std::ptrdiff_t row = strip.size[0], plane = row * strip.size[1];
    std::array<float, std::size_t{3} * Leaf::NUM_VALUES> active_values;
    for (std::size_t i = 0; i < leaves.places.size(); ++i) {
        const std::uint16_t place = leaves.places[i];
        const float* const corner = values + index_in(strip, leaf_origin(strip, place));
        const VdbLeafMask& active = leaves.active[i];
        std::size_t count = 0;
        for (int c = 0; c < encoding.components; ++c) {
            count += gather(corner + c * strip.count(), row, plane, active, encoding.components,
                            active_values.data() + c);
        }
        write_leaf(out, active, active_values.data(), count, encoding);
        encoded.column_ends[static_cast<std::size_t>(vdb_column(place))] = encoded.bytes.size();
    }
    for (std::size_t column = 1; column < encoded.column_ends.size(); ++column) {
        std::size_t& end = encoded.column_ends[column];
        end = std::max(end, encoded.column_ends[column - 1]);  // a column may be empty
    }
}

}  // namespace
}  // namespace skybake::vdb

extern "C" const skybake::VdbCodec* skybake_vdb_codec() {
    using namespace skybake::vdb;
    static constexpr skybake::VdbCodec codec = {file_head,    grid_head,  grid_positions,
                                                root,         upper_node, lower_node,
                                                encode_strip, read,       open_grid};
    return &codec;
}
