// Texels as they lie in memory, one after the other: what files without compression hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bakers/io/files/file_input.h"
#include "bakers/io/files/file_output.h"
#include "bakers/io/formats/format.h"

namespace skybake {

enum class TexelPadding {
    none,
    three_to_four,  // three channels are stored as four, the fourth of which is 1
};

// Appends the texels of a level in the order x, y, z, channels interleaved, made in parallel. False
// once progress->cancelled(); errors are the output's.
bool write_texels(const FileContent& content, int level, TexelPadding padding, FileOutput& output);

// Where the texels of a level stand in a file.
struct StoredTexelRange {
    std::uint64_t offset = 0;
    std::array<int, 3> size{};
    std::size_t channels = 0;         // that are asked for, the first
    std::size_t stored_channels = 0;  // in the file
    config::PixelType type = config::PixelType::float32;

    std::uint64_t bytes() const;
};

// As Format::read. E0300 where the file ends early.
config::Outcome<bool> read_texels(FileInput& file, const StoredTexelRange& range,
                                  const VoxelVisitor& visit);

}  // namespace skybake
