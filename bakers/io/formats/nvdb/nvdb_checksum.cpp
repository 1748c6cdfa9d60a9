#include "bakers/io/formats/nvdb/nvdb_checksum.h"

#include <libdeflate.h>

#include <array>
#include <string>

namespace skybake {
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
    const std::string head =
        bytes_at(file, grid.begin + nvdb_summed_from, end - nvdb_summed_from);
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
