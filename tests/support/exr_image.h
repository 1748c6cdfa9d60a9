// OpenEXR images in memory and in files, in the one profile that every reader tried understands:
// single part, scanlines in increasing Y, no lossy codec, no date. They share the header of files with
// the product, and no code that writes or reads texels. What the library throws fails the test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/io/formats/exr/exr_heads.h"
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

// The bytes of the file, the same for equal images.
std::string encode_exr(const ExrImage& image);

// Reads an image of the profile.
ExrImage read_exr(const std::filesystem::path& path);

// The texels as a file stores them: row by row, channels interleaved, little-endian, of the given
// type. This is what skybake/content_hash is taken of, whatever the compression.
std::string stored_bytes(const Image2<float>& image, config::PixelType type);

}  // namespace skybake
