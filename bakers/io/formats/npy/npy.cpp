// Assets as arrays of NumPy, which `numpy.load` reads and maps into memory: a head that tells the
// type and the shape, then texels as in bin files (bin.cpp). The shape is (z, y, x, channels), of a
// table (y, x, channels). unorm8 and unorm16 are integers, to be divided by 255 or 65535.
//
// Source: NumPy, "numpy.lib.format", version 1.0 of the format.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

struct NpyType {
    PixelType type;
    std::string_view word;
};
constexpr std::array<NpyType, 4> npy_types = {{{PixelType::float32, "<f4"},
                                               {PixelType::half, "<f2"},
                                               {PixelType::unorm8, "|u1"},
                                               {PixelType::unorm16, "<u2"}}};

// Returns what stands before the texels, padded to a multiple of 64 bytes.
std::string npy_head(const std::array<int, 3>& size, bool is_flat, std::size_t channels,
                     PixelType type) {
    const auto row = std::ranges::find(npy_types, type, &NpyType::type);
    const std::string slices = is_flat ? "" : fmt::format("{}, ", size[2]);
    std::string text =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}, {}, {}), }}",
                    row->word, slices, size[1], size[0], channels);
    constexpr std::size_t before_text = 10;
    text.resize((before_text + text.size() + 1 + 63) / 64 * 64 - before_text - 1, ' ');
    text += '\n';
    std::string head = {'\x93', 'N', 'U', 'M', 'P', 'Y', '\1', '\0'};
    head += static_cast<char>(text.size() & 0xFF);
    head += static_cast<char>(text.size() >> 8);
    return head + text;
}

Outcome<bool> write_npy_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    FileOutput output(path);
    output.write(npy_head(baked.levels[static_cast<std::size_t>(content.level)].size,
                          baked.is_table(), baked.channel_names.size(), baked.pixel_type));
    const bool complete = write_texels(content, content.level, texel_sink(output));
    return output.finished(complete);
}

// A file of another program may say the same in other words; skybake reads its own.
Outcome<bool> read_npy_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    for (const bool is_flat : {false, true}) {
        const std::string head = npy_head(shape.size, is_flat, shape.channels, shape.pixel_type);
        std::string found(head.size(), '\0');
        const auto done = file.read(0, found.data(), found.size());
        if (!done) return file.diagnostic();
        if (found != head || (is_flat && shape.size[2] != 1)) continue;
        const StoredTexelRange texels = {shape.size, shape.channels, shape.channels,
                                         shape.pixel_type};
        if (file.size() != head.size() + texels.bytes()) break;
        return read_texels(texel_input(file, head.size()), texels, visit);
    }
    return other_size(file.path());
}

}  // namespace

Format npy_format() {
    return {.format = config::FileFormat::npy,
            .has_metadata = false,
            .write = write_npy_file,
            .inspect = nullptr,
            .read = read_npy_file};
}

}  // namespace skybake
