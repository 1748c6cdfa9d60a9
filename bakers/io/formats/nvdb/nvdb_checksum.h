// The checksum of a NanoVDB grid, as the library's GridChecksum makes it: a CRC-32 of grid, tree and
// root, and one of the CRC-32 of each node, upper nodes first, then lower ones, then leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "bakers/io/formats/nvdb/nvdb_input.h"

namespace skybake {

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
    return nvdb_crc({reinterpret_cast<const char*>(numbers.data()),
                     numbers.size() * sizeof(Number)});
}

// Reads all nodes of a grid. Throws NvdbDamage if they do not match its checksum, as far as it has one.
void expect_nvdb_checksum(NvdbInput& file, const NvdbGrid& grid);

}  // namespace skybake
