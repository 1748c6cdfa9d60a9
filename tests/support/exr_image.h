// OpenEXR images in memory and in files, in the one profile that every reader tried understands:
// single part, scanlines in increasing Y, no lossy codec, no date. It shares the header of files
// with the product, and no code that writes or reads texels.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

struct ExrImage {
    Image2<float> pixels;  // row 0 is the first scanline; with PixelType::half already rounded
    std::vector<std::string>
        channel_names;  // as in a texel: {"R", "G", "B"}, {"R", ..., "A"}, {"Y"}
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Attributes attributes;  // texts, sorted by name; a file holds long ones in pieces
};

// The bytes of the file, the same for equal images. Throws what the library throws.
config::Outcome<std::string> encode_exr(const ExrImage& image);

// Reads an image of the profile; `name` stands for the file in diagnostics. Lines in decreasing Y
// and a data window off the origin are accepted, other layouts (tiles, parts, deep data,
// subsampling, integers, mixed types, lossy codecs) and damaged bytes are E0304. Never throws,
// never crashes, and takes no memory for what the header claims and the bytes cannot hold.
config::Outcome<ExrImage> decode_exr(std::string_view bytes, const std::string& name);

// The same from a file. E0300 where it cannot be read.
config::Outcome<ExrImage> read_exr(const std::filesystem::path& path);

// The texels as a file stores them: row by row, channels interleaved, little-endian, of the given
// type. This is what skybake/content_hash is taken of, whatever the compression.
std::string stored_bytes(const Image2<float>& image, config::PixelType type);

}  // namespace skybake
