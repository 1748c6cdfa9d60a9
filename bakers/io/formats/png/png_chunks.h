// The chunks of a PNG file, before its library reads them.
#pragma once

#include <png.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "bakers/io/files/file_io.h"

namespace skybake {

// Throws if a chunk is longer than what is left of its file: the library allocates what the chunk's
// head says before it reads on. What is no PNG file at all is left to the library to tell.
inline void check_chunk_lengths(FileInput& file) {
    std::array<unsigned char, 8> head{};
    const auto read_head = [&](std::uint64_t position) {
        const auto done = file.read(position, reinterpret_cast<char*>(head.data()), head.size());
        return done && *done == head.size();
    };
    if (!read_head(0) || png_sig_cmp(head.data(), 0, head.size()) != 0) return;
    std::uint64_t position = head.size();
    while (read_head(position) && std::memcmp(head.data() + 4, "IEND", 4) != 0) {
        position += 12 + std::uint64_t{png_get_uint_32(head.data())};  // and its name and checksum
        if (position > file.size()) throw std::runtime_error("a chunk is longer than the file");
    }
}

}  // namespace skybake
