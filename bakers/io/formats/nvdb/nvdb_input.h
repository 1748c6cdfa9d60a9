// Reads what a NanoVDB file says of itself, its inner nodes and its leaves, and guards against files
// that are damaged or hostile: a node must lie within its grid.
//
// The checksum of a NanoVDB grid, as the library's GridChecksum makes it: a CRC-32 of grid, tree and
// root, and one of the CRC-32 of each node, upper nodes first, then lower ones, then leaves.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"
#include "bakers/io/volumes/grid_voxels.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Thrown where a file is damaged or holds what is not read, with the reason.
struct NvdbDamage {
    std::string reason;
};

inline void expect_nvdb(bool condition, const char* reason) {
    if (!condition) throw NvdbDamage{reason};
}

struct NvdbGrid {
    std::string name;
    NvdbGridHead head;
    std::uint64_t begin = 0;   // where its bytes are read from
    std::uint64_t zipped = 0;  // where a grid that is compressed by zip is in the file; else 0
    std::string unread = {};   // why its voxels are not read: "it is compressed"; empty: they are
};

// "float", "vec3f", "mask", as the library calls them; "type 27" of one that it does not know.
std::string nvdb_type_name(nanovdb::GridType type);

// A file that has been opened, with the heads of its grids, of one or several segments.
class NvdbInput {
  public:
    explicit NvdbInput(FileInput file);

    const std::vector<NvdbGrid>& grids() const { return grids_; }

    void read(std::uint64_t offset, void* bytes, std::size_t count);
    template <class T>
    T read(std::uint64_t offset) {
        T value;
        read(offset, static_cast<void*>(&value), sizeof value);
        return value;
    }
    template <class Node>
    void read_node(std::uint64_t offset, std::vector<NvdbUnit>& memory) {
        memory.resize((sizeof(Node) + sizeof(NvdbUnit) - 1) / sizeof(NvdbUnit));
        read(offset, memory.data(), sizeof(Node));
    }

    // Returns what a grid says of itself, which must agree with its head. It must not be compressed but
    // by zip, in which case its bytes are held in memory from here on, and its leaves must be of a type
    // that skybake uses.
    nanovdb::GridData grid_data(const NvdbGrid& grid);
    // Returns where the root is in the grid, of which the tiles lie behind it.
    std::uint64_t root_of(const NvdbGrid& grid);
    // Returns the text that the first grid carries, or "".
    std::string description();

  private:
    std::uint64_t read_segment(std::uint64_t offset);
    std::uint64_t read_head(std::uint64_t offset);
    void inflate(const NvdbGrid& grid);

    FileInput file_;
    std::vector<NvdbGrid> grids_;
    // Bytes of grids that were compressed, by NvdbGrid::begin.
    std::map<std::uint64_t, std::pair<std::unique_ptr<char[]>, std::uint64_t>> inflated_;
};

// Returns `from + step`, where a record of `bytes` bytes must lie in the grid.
std::uint64_t checked_nvdb_offset(const NvdbGrid& grid, std::uint64_t from, std::int64_t step,
                                  std::uint64_t bytes);

// The place in a node of entry i of its table, in units of children.
constexpr std::array<int, 3> nvdb_place(std::uint32_t i, int log2_edge) {
    const auto entry = static_cast<int>(i);
    const int mask = (1 << log2_edge) - 1;
    return {entry >> 2 * log2_edge, entry >> log2_edge & mask, entry & mask};
}

// Reads the values of a leaf, whether they are active or not. `memory` keeps the leaf.
void read_nvdb_leaf(NvdbInput& file, nanovdb::GridType type, std::uint64_t offset,
                    std::vector<NvdbUnit>& memory, LeafValues& values);

// Returns what `work` returns of the file's NvdbInput, E0300 if the file cannot be read, or E0304 with
// the reason of an NvdbDamage.
template <class T, class Work>
config::Outcome<T> with_nvdb_file(const std::filesystem::path& path, const Work& work) {
    config::Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    try {
        NvdbInput opened(std::move(*file.value));
        return work(opened);
    } catch (const NvdbDamage& damage) {
        return damaged_file(path, "NanoVDB", damage.reason);
    }
}

// A half of a checksum that was not made.
inline constexpr std::uint32_t no_nvdb_checksum = 0xFFFFFFFF;

// The first bytes of a grid, magic number and checksum, are not in its checksum.
inline constexpr std::size_t nvdb_summed_from = 16;

std::uint32_t nvdb_crc(std::string_view bytes);

// Returns the half of nodes. The library sums their checksums as numbers of std::uint_fast32_t, which
// have 8 bytes on Linux and macOS and 4 on Windows.
template <class Number = std::uint64_t>
std::uint32_t nvdb_crc_of_nodes(const std::vector<std::uint32_t>& nodes) {
    if (nodes.empty()) return no_nvdb_checksum;
    const std::vector<Number> numbers(nodes.begin(), nodes.end());
    return nvdb_crc(
        {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

// Reads all nodes of a grid. Throws NvdbDamage if they do not match its checksum, as far as it has one.
void expect_nvdb_checksum(NvdbInput& file, const NvdbGrid& grid);

}  // namespace skybake
