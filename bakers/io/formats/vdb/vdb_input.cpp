#include "bakers/io/formats/vdb/vdb_input.h"

#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/io.h>

#include <cstring>
#include <sstream>

#include "bakers/io/files/system_call.h"
#include "bakers/io/formats/vdb/vdb_grid_tree.h"

namespace skybake::vdb {
namespace {

namespace io = openvdb::io;

// The formats that are read: from the first with a mask in each node, of 2012, to the last that the
// library knows.
constexpr std::uint32_t oldest_format = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
constexpr std::uint32_t newest_format = openvdb::OPENVDB_FILE_VERSION;

// Adds one entry. The library takes the size of a value from its type, so the two must agree.
void add_entry(const std::string& name, const std::string& type, const std::string& value,
               openvdb::MetaMap& map) {
    if (type == io::DelayedLoadMetadata::staticTypeName()) return;
    if (type == openvdb::StringMetadata::staticTypeName()) {
        map.insertMeta(name, openvdb::StringMetadata(value));
        return;
    }
    if (!openvdb::Metadata::isRegisteredType(type)) return;
    const openvdb::Metadata::Ptr entry = openvdb::Metadata::createMetadata(type);
    expect(entry->size() == value.size(), "a value of its metadata has another size than its type");
    const auto size = static_cast<std::uint32_t>(value.size());
    std::string bytes(sizeof size, '\0');
    std::memcpy(bytes.data(), &size, sizeof size);
    std::istringstream in(bytes + value, std::ios::binary);
    entry->read(in);
    map.insertMeta(name, *entry);
}

}  // namespace

Input::Input(const std::filesystem::path& path) {
    open_to_read(stream_, path);
    stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    stream_.seekg(0, std::ios::end);
    file_size_ = stream_.tellg();
    stream_.seekg(0);
    const auto magic = read_raw<std::int64_t>(stream_);
    // "NanoVDB" and a digit
    constexpr std::int64_t seven_bytes = (std::int64_t{1} << 56) - 1;
    expect((magic & seven_bytes) != 0x4244566f6e614e,
           "it is a NanoVDB file: write format = \"nvdb\"");
    expect(magic == openvdb::OPENVDB_MAGIC, "it does not begin as a VDB file");
    const auto format = read_raw<std::uint32_t>(stream_);
    expect(format >= oldest_format && format <= newest_format, "its format is not known");
    stream_.seekg(0);
    readHeader(stream_);
    metadata_->setSeekable(true);
    io::setStreamMetadataPtr(stream_, metadata_, false);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
}

std::uint32_t Input::read_compression() {
    readGridCompression(stream_);
    return io::getDataCompression(stream_);
}

void Input::read_metadata(openvdb::MetaMap& map) {
    for (auto entries = read_raw<std::uint32_t>(stream_); entries > 0; --entries) {
        const std::string name = read_sized();
        const std::string type = read_sized();
        add_entry(name, type, read_sized(), map);
    }
}

openvdb::GridBase::Ptr Input::read_descriptor(io::GridDescriptor& descriptor) {
    const auto begin = stream_.tellg();
    for (int name = 0; name < 3; ++name) read_sized();  // of grid, type and parent
    stream_.seekg(begin);
    return descriptor.read(stream_);
}

void Input::read_transform(openvdb::GridBase& grid) {
    const auto begin = stream_.tellg();
    // The map of a frustum has further lengths.
    expect(read_sized() != openvdb::math::NonlinearFrustumMap::mapType(),
           "the transform of a grid is a frustum");
    stream_.seekg(begin);
    grid.readTransform(stream_);
}

std::string Input::read_sized() {
    const std::int64_t length = read_raw<std::uint32_t>(stream_);
    expect(position() + length <= file_size_, "it ends early");
    std::string bytes(static_cast<std::size_t>(length), '\0');
    stream_.read(bytes.data(), length);
    return bytes;
}

std::vector<Grid> read_grid_heads(Input& input) {
    std::vector<Grid> grids;
    const std::int32_t count = input.read_grid_count();
    for (std::int32_t i = 0; i < count; ++i) {
        Grid& head = grids.emplace_back();
        head.grid = input.read_descriptor(head.descriptor);
        if (!input.is_stream()) head.descriptor.seekToGrid(input.stream());
        head.compression = input.read_compression();
        input.read_metadata(*head.grid);
        input.read_transform(*head.grid);
        head.tree_at = input.position();
        head.streamed = input.is_stream();
        if (head.streamed) {
            if (i + 1 < count) skip_streamed_grid(input, head);
            continue;
        }
        const std::int64_t end = head.descriptor.getEndPos();
        expect(end >= head.tree_at && end <= input.file_size(),
               "a grid does not end behind its head");
        head.descriptor.seekToEnd(input.stream());
    }
    return grids;
}

Attributes texts_of(const openvdb::MetaMap& map) {
    Attributes attributes;
    for (auto entry = map.beginMeta(); entry != map.endMeta(); ++entry) {
        attributes.emplace_back(entry->first, entry->second->str());
    }
    return attributes;
}

std::optional<Vector> stated_vector(const openvdb::GridBase& grid, const char* name) {
    const auto found = grid.getMetadata<openvdb::Vec3IMetadata>(name);
    if (!found) return std::nullopt;
    const openvdb::Vec3i value = found->value();
    return Vector{value[0], value[1], value[2]};
}

namespace {

// Returns how many bytes stand between the first byte of compressed values and the values: inactive
// values, and the mask that chooses between them.
std::int64_t bytes_before_values(int what, std::size_t count, int value) {
    std::int64_t bytes = 0;
    const bool has_one = what == io::NO_MASK_AND_ONE_INACTIVE_VAL ||
                         what == io::MASK_AND_ONE_INACTIVE_VAL ||
                         what == io::MASK_AND_TWO_INACTIVE_VALS;
    const bool has_mask = what == io::MASK_AND_NO_INACTIVE_VALS ||
                          what == io::MASK_AND_ONE_INACTIVE_VAL ||
                          what == io::MASK_AND_TWO_INACTIVE_VALS;
    if (has_one) bytes += value;
    if (what == io::MASK_AND_TWO_INACTIVE_VALS) bytes += value;
    if (has_mask) bytes += static_cast<std::int64_t>(count / 8);
    return bytes;
}

// Blosc trusts the two lengths in the head of its data.
void check_blosc(std::istream& in, std::int64_t bytes, std::int64_t unpacked) {
    constexpr std::int64_t head = 16;
    expect(bytes >= head, "its values are damaged");
    in.seekg(4, std::ios::cur);  // versions, flags, size of a number
    expect(read_raw<std::uint32_t>(in) == static_cast<std::uint64_t>(unpacked),
           "its values are damaged");
    in.seekg(4, std::ios::cur);  // size of a block
    expect(read_raw<std::uint32_t>(in) == static_cast<std::uint64_t>(bytes),
           "its values are damaged");
    in.seekg(-head, std::ios::cur);
}

}  // namespace

std::int64_t end_of_values(std::istream& in, std::int64_t file_size, std::size_t count,
                           std::size_t active, ValueSize size) {
    const std::int64_t begin = in.tellg();
    const std::uint32_t compression = io::getDataCompression(in);
    const int what = read_raw<std::int8_t>(in);
    in.seekg(bytes_before_values(what, count, size.memory), std::ios::cur);
    const bool only_active =
        (compression & io::COMPRESS_ACTIVE_MASK) != 0 && what != io::NO_MASK_AND_ALL_VALS;
    const auto values = static_cast<std::int64_t>(only_active ? active : count);
    const std::int64_t unpacked = values * size.file;
    std::int64_t bytes = unpacked;
    if ((compression & (io::COMPRESS_BLOSC | io::COMPRESS_ZIP)) != 0 &&
        !(size.file < size.memory && values == 0)) {
        constexpr std::int64_t most_overhead = 1024;
        bytes = read_raw<std::int64_t>(in);
        // Values that do not become smaller are stored as they are, with their length below 0.
        expect(bytes > 0 ? bytes <= unpacked + most_overhead : bytes == -unpacked,
               "the length of its values is damaged");
        if (bytes > 0 && (compression & io::COMPRESS_BLOSC) != 0) check_blosc(in, bytes, unpacked);
        bytes = bytes > 0 ? bytes : -bytes;
    }
    const std::int64_t end = static_cast<std::int64_t>(in.tellg()) + bytes;
    expect(end <= file_size, "it ends early");
    in.seekg(begin);
    return end;
}

}  // namespace skybake::vdb
