#include "bakers/io/formats/nvdb/nvdb_input.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <new>
#include <string>

namespace skybake {

namespace {

constexpr std::uint16_t most_grids = 64;
constexpr std::uint32_t most_name = 4096;             // bytes
constexpr std::uint64_t most_description = 64 << 20;  // bytes
constexpr std::uint16_t zip_codec = 1;
constexpr std::uint64_t most_inflated = std::uint64_t{4} << 30;  // bytes of a grid
constexpr std::uint64_t most_deflated = 1032;  // no byte of a deflated stream makes more than these
// Grids that are compressed are read from beyond the end of any file.
constexpr std::uint64_t inflated_at = std::uint64_t{1} << 62;
constexpr const char* nvdb_way_on =
    "`nanovdb_convert FILE.nvdb FILE.vdb` makes an OpenVDB file of it, for format = \"vdb\"";

// Returns the bytes that a stream of zlib makes, or null if it is damaged or makes more or fewer of them.
// Memory is taken as it is written to.
std::unique_ptr<char[]> inflated_stream(std::string_view stream, std::size_t bytes) {
    auto made = std::make_unique_for_overwrite<char[]>(bytes);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        inflater(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!inflater) throw std::bad_alloc();
    // Without a place for the number of bytes, all of them must be made.
    const auto result = libdeflate_zlib_decompress(inflater.get(), stream.data(), stream.size(),
                                                   made.get(), bytes, nullptr);
    return result == LIBDEFLATE_SUCCESS ? std::move(made) : nullptr;
}

}  // namespace

NvdbInput::NvdbInput(FileInput file) : file_(std::move(file)) {
    std::uint64_t offset = 0;
    do {
        offset = read_segment(offset);
    } while (offset < file_.size());
}

void NvdbInput::read(std::uint64_t offset, void* bytes, std::size_t count) {
    const auto next = inflated_.upper_bound(offset);
    if (next != inflated_.begin()) {
        const auto& [begin, grid] = *std::prev(next);
        const std::uint64_t at = offset - begin;
        expect_nvdb(at <= grid.second && count <= grid.second - at, "it ends early");
        std::memcpy(bytes, grid.first.get() + at, count);
        return;
    }
    const auto done = file_.read(offset, static_cast<char*>(bytes), count);
    expect_nvdb(done && *done == count, "it ends early");
}

// Returns the offset behind its grids.
std::uint64_t NvdbInput::read_segment(std::uint64_t offset) {
    const auto segment = read<NvdbSegment>(offset);
    expect_nvdb(segment.magic != nvdb_new_grid_magic, "it is a grid without a file's head");
    if (segment.magic != nvdb_magic && segment.magic != nvdb_new_file_magic) {
        throw NvdbDamage{offset == 0 ? "it begins with neither `NanoVDB0` nor `NanoVDB2`"
                                     : "there is more behind its grids"};
    }
    if (segment.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
        throw NvdbDamage{fmt::format("its version is {}.{}, and {} is read; {}",
                                     segment.version.getMajor(), segment.version.getMinor(),
                                     NANOVDB_MAJOR_VERSION_NUMBER, nvdb_way_on)};
    }
    const std::size_t first = grids_.size();
    if (segment.grids == 0 || first + segment.grids > most_grids) {
        throw NvdbDamage{fmt::format("it has {} grids", first + segment.grids)};
    }
    offset += sizeof segment;
    for (int i = 0; i < segment.grids; ++i) offset = read_head(offset);
    for (std::size_t i = first; i < grids_.size(); ++i) {
        grids_[i].begin = offset;
        if (segment.codec == zip_codec) {
            grids_[i].zipped = offset;
            grids_[i].begin = inflated_at + i * 2 * most_inflated;
        } else if (segment.codec != 0) {
            const bool is_blosc = segment.codec == 2;
            grids_[i].unread = fmt::format("it is compressed by {}; {}",
                                           is_blosc ? "blosc" : "an unknown codec", nvdb_way_on);
        }
        const NvdbGridHead& head = grids_[i].head;
        const std::uint64_t bytes = segment.codec == 0 ? head.grid_size : head.file_size;
        expect_nvdb(bytes <= file_.size() - offset, "it ends within a grid");
        offset += bytes;
    }
    return offset;
}

// Returns the offset behind it.
std::uint64_t NvdbInput::read_head(std::uint64_t offset) {
    NvdbGrid grid;
    read(offset, static_cast<void*>(&grid.head), sizeof grid.head);
    expect_nvdb(grid.head.name_size > 0 && grid.head.name_size <= most_name, "a grid has no name");
    grid.name.resize(grid.head.name_size - 1);
    offset += sizeof grid.head;
    read(offset, grid.name.data(), grid.name.size());
    offset += grid.head.name_size;
    expect_nvdb(offset <= file_.size(), "it ends early");
    grids_.push_back(std::move(grid));
    return offset;
}

std::string nvdb_type_name(nanovdb::GridType type) {
    constexpr std::array names = {"unknown", "float", "double", "int16",  "int32", "int64", "vec3f",
                                  "vec3d",   "mask",  "half",   "uint32", "bool",  "rgba8", "fp4",
                                  "fp8",     "fp16",  "fpN",    "vec4f",  "vec4d", "index"};
    const auto number = static_cast<std::size_t>(type);
    return number < names.size() ? names[number] : fmt::format("type {}", number);
}

nanovdb::GridData NvdbInput::grid_data(const NvdbGrid& grid) {
    if (!grid.unread.empty()) throw NvdbDamage{grid.unread};
    if (nvdb_leaf_bytes(grid.head.type) == 0) {
        throw NvdbDamage{fmt::format("its grid `{}` holds {}; {}", grid.name,
                                     nvdb_type_name(grid.head.type), nvdb_way_on)};
    }
    if (grid.zipped != 0 && !inflated_.contains(grid.begin)) inflate(grid);
    const auto data = read<nanovdb::GridData>(grid.begin);
    const bool is_known = data.mMagic == nvdb_magic || data.mMagic == nvdb_new_grid_magic;
    expect_nvdb(
        is_known && data.mGridType == grid.head.type && data.mGridSize == grid.head.grid_size,
        "a grid contradicts its head");
    return data;
}

// A compressed grid is the length of a stream of zlib, and the stream.
void NvdbInput::inflate(const NvdbGrid& grid) try {
    const NvdbGridHead& head = grid.head;
    expect_nvdb(head.file_size > sizeof(std::uint64_t) &&
                    read<std::uint64_t>(grid.zipped) == head.file_size - sizeof(std::uint64_t),
                "a compressed grid contradicts its head");
    expect_nvdb(head.grid_size <= most_inflated, "a compressed grid is larger than 4 GiB");
    expect_nvdb(head.grid_size / most_deflated <= head.file_size,
                "a compressed grid is too short for its size");
    std::string stream(head.file_size - sizeof(std::uint64_t), '\0');
    read(grid.zipped + sizeof(std::uint64_t), stream.data(), stream.size());
    auto bytes = inflated_stream(stream, head.grid_size);
    expect_nvdb(bytes != nullptr, "a compressed grid is damaged");
    inflated_.emplace(grid.begin, std::pair(std::move(bytes), head.grid_size));
} catch (const std::bad_alloc&) {
    throw NvdbDamage{"a compressed grid does not fit in memory"};
}

std::uint64_t NvdbInput::root_of(const NvdbGrid& grid) {
    const auto tree = read<nanovdb::TreeData<3>>(grid.begin + nvdb_tree_at);
    const std::uint64_t root = checked_nvdb_offset(
        grid, nvdb_tree_at, static_cast<std::int64_t>(tree.mNodeOffset[3]), sizeof(NvdbRoot));
    const auto tiles = read<std::uint32_t>(grid.begin + root + nvdb_root_tiles);
    checked_nvdb_offset(grid, root, sizeof(NvdbRoot),
                        std::uint64_t{tiles} * sizeof(NvdbRoot::Tile));
    return root;
}

std::string NvdbInput::description() {
    const NvdbGrid& grid = grids_.front();
    if (!grid.unread.empty() || grid.zipped != 0) return "";
    const auto data = read<nanovdb::GridData>(grid.begin);
    if (data.mBlindMetadataCount == 0) return "";
    const auto at = static_cast<std::uint64_t>(data.mBlindMetadataOffset);
    expect_nvdb(at <= grid.head.grid_size, "its description lies beyond its grid");
    const auto blind = read<nanovdb::GridBlindMetaData>(grid.begin + at);
    if (std::strncmp(blind.mName, metadata_name, sizeof blind.mName) != 0) return "";
    const auto text_at = static_cast<std::uint64_t>(blind.mByteOffset);
    expect_nvdb(blind.mElementCount <= std::min(most_description, grid.head.grid_size) &&
                    text_at <= grid.head.grid_size,
                "its description lies beyond its grid");
    std::string text(blind.mElementCount, '\0');
    read(grid.begin + at + text_at, text.data(), text.size());
    return text;
}

std::uint64_t checked_nvdb_offset(const NvdbGrid& grid, std::uint64_t from, std::int64_t step,
                                  std::uint64_t bytes) {
    const std::uint64_t offset = from + static_cast<std::uint64_t>(step);
    const std::uint64_t size = grid.head.grid_size;
    expect_nvdb(offset >= nvdb_root_at && offset <= size && bytes <= size - offset,
                "a node lies beyond its grid");
    return offset;
}

void read_nvdb_leaf(NvdbInput& file, nanovdb::GridType type, std::uint64_t offset,
                    std::vector<NvdbUnit>& memory, LeafValues& values) {
    memory.resize(nvdb_aligned(nvdb_leaf_bytes(type)) / sizeof(NvdbUnit));
    file.read(offset, memory.data(), nvdb_leaf_bytes(type));
    const auto decode = [&]<class Build>(Build) {
        const auto& leaf = *reinterpret_cast<const NvdbLeaf<Build>*>(memory.data());
        for (std::size_t i = 0; i < nvdb_leaf_voxels; ++i) {
            values[i] = static_cast<float>(leaf.mCode[i]) * leaf.mQuantum + leaf.mMinimum;
        }
    };
    if (type == nanovdb::GridType::Fp8) return decode(nanovdb::Fp8{});
    if (type == nanovdb::GridType::Fp16) return decode(nanovdb::Fp16{});
    std::memcpy(values.data(), reinterpret_cast<const NvdbLeaf<float>*>(memory.data())->mValues,
                sizeof values);
}

namespace {

constexpr const char* kWrongChecksum = "its checksum does not match what it holds";

std::string bytes_at(NvdbInput& file, std::uint64_t offset, std::uint64_t count) {
    std::string bytes(count, '\0');
    file.read(offset, bytes.data(), bytes.size());
    return bytes;
}

}  // namespace

std::uint32_t nvdb_crc(std::string_view bytes) {
    return libdeflate_crc32(0, bytes.data(), bytes.size());
}

void expect_nvdb_checksum(NvdbInput& file, const NvdbGrid& grid) {
    const nanovdb::GridData data = file.grid_data(grid);
    const auto of_head = static_cast<std::uint32_t>(data.mChecksum);
    const auto of_nodes = static_cast<std::uint32_t>(data.mChecksum >> 32);
    const std::uint64_t root = file.root_of(grid);
    if (of_head == no_nvdb_checksum || root != nvdb_root_at) return;
    const auto tiles = file.read<std::uint32_t>(grid.begin + root + nvdb_root_tiles);
    const std::uint64_t end = nvdb_tiles_at + tiles * sizeof(NvdbRoot::Tile);
    const std::string head = bytes_at(file, grid.begin + nvdb_summed_from, end - nvdb_summed_from);
    expect_nvdb(nvdb_crc(head) == of_head, kWrongChecksum);
    const bool is_in_order =
        (data.mFlags & static_cast<std::uint32_t>(nanovdb::GridFlags::IsBreadthFirst)) != 0;
    if (of_nodes == no_nvdb_checksum || !is_in_order) return;
    const auto tree = file.read<nanovdb::TreeData<3>>(grid.begin + nvdb_tree_at);
    const std::array<std::size_t, 3> node_bytes = {nvdb_leaf_bytes(grid.head.type),
                                                   sizeof(NvdbLower), sizeof(NvdbUpper)};
    std::vector<std::uint32_t> nodes;
    for (std::size_t level = 3; level-- > 0;) {
        const std::uint64_t count = tree.mNodeCount[level];
        if (count == 0) continue;
        const std::uint64_t first = checked_nvdb_offset(
            grid, nvdb_tree_at, static_cast<std::int64_t>(tree.mNodeOffset[level]),
            count * node_bytes[level]);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t at = grid.begin + first + i * node_bytes[level];
            nodes.push_back(nvdb_crc(bytes_at(file, at, node_bytes[level])));
        }
    }
    expect_nvdb(of_nodes == nvdb_crc_of_nodes<std::uint64_t>(nodes) ||
                    of_nodes == nvdb_crc_of_nodes<std::uint32_t>(nodes),
                kWrongChecksum);
}

}  // namespace skybake
