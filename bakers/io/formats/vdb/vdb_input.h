// Reads what stands in a VDB file before its trees, and guards OpenVDB against files that are damaged
// or hostile. Only source files of the module skybake_vdb include this header.
//
// The library allocates memory by the lengths in a file before it notices that the file ends, so lengths
// are checked before it reads. Of 600 copies of a file of 54 kB, each with one bit flipped, OpenVDB
// 10.0's io::File asks for more than 6 GiB for 61, crashes on 1 and fills up to 1.7 GiB for others.
#pragma once

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/vdb/vdb_library.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::vdb {

// An exception for a file that is damaged or holds what is not read.
struct Damaged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline void expect(bool condition, const char* what) {
    if (!condition) throw Damaged(what);
}

template <class T>
T read_raw(std::istream& in) {
    T value;
    in.read(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
}

// A file that is read with the protected functions of openvdb::io::Archive.
class Input : public openvdb::io::Archive {
  public:
    // Reads the head of the file. From now on the stream throws if the file ends early.
    explicit Input(const std::filesystem::path& path);

    std::istream& stream() { return stream_; }
    std::int64_t position() { return stream_.tellg(); }
    std::int64_t file_size() const { return file_size_; }
    // Whether io::Stream wrote the file, which does not say where its grids are.
    bool is_stream() const { return !inputHasGridOffsets(); }

    std::int32_t read_grid_count() { return readGridCount(stream_); }
    std::uint32_t read_compression();
    // Reads metadata, except what only serves to load voxels later.
    void read_metadata(openvdb::MetaMap& map);
    openvdb::GridBase::Ptr read_descriptor(openvdb::io::GridDescriptor& descriptor);
    void read_transform(openvdb::GridBase& grid);

  private:
    // Reads a length and that many bytes.
    std::string read_sized();

    openvdb::io::StreamMetadata::Ptr metadata_{
        new openvdb::io::StreamMetadata};  // outlives the stream
    std::ifstream stream_;
    std::int64_t file_size_ = 0;
};

struct Grid {
    openvdb::io::GridDescriptor descriptor;
    openvdb::GridBase::Ptr grid;  // its metadata and transform, no tree
    std::uint32_t compression = 0;
    std::int64_t tree_at = 0;
    bool streamed = false;  // by io::Stream: the file does not say where voxels begin and end
    int component = 0;      // that is read of vectors; 0 of numbers
};

std::vector<Grid> read_grid_heads(Input& input);

// Returns the texts of a map by name, without those that OpenVDB itself needs to read the file.
Attributes texts_of(const openvdb::MetaMap& map);

using Vector = std::array<std::int64_t, 3>;

std::optional<Vector> stated_vector(const openvdb::GridBase& grid, const char* name);

// Bytes of a value in memory and in the file, where reals may be halves.
struct ValueSize {
    int memory = 4;
    int file = 4;
};

template <class Value>
constexpr ValueSize size_of_value(bool half) {
    constexpr int size = sizeof(Value);
    if constexpr (std::is_same_v<Value, openvdb::Vec3f>) return {size, half ? size / 2 : size};
    return {size, half && std::is_floating_point_v<Value> ? 2 : size};
}

// Returns a number, or a component of a vector, as float.
template <class Value>
float number_of(const Value& value, int component) {
    if constexpr (std::is_same_v<Value, openvdb::Vec3f>) {
        return value[component];
    } else {
        return static_cast<float>(value);
    }
}

// Returns where the values that io::readCompressedValues would read from here on end, or throws if
// their lengths do not fit `count` values or the file. `active` of them are active. The stream stays
// where it is.
std::int64_t end_of_values(std::istream& in, std::int64_t file_size, std::size_t count,
                           std::size_t active, ValueSize size);

// Returns what `function` returns, or E0304 with the reason of what it throws.
template <class T, class Function>
config::Outcome<T> reported(const std::filesystem::path& path, Function&& function) {
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
    return file_error("E0304", path.string(),
                      fmt::format("cannot read `{}` as a VDB file: {}", path.string(), reason));
}

}  // namespace skybake::vdb
