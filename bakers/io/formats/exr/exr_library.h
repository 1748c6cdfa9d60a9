// Between our words and OpenEXR's, for exr*.cpp alone: only they know the library.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/attribute_pieces.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

// What a file says of itself besides its pixels.
struct ExrFacts {
    int width = 0;
    int height = 0;
    std::vector<std::string> channel_names;
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Attributes attributes;
};

// The header of a file of our profile.
Imf::Header make_exr_header(const ExrFacts& facts);

// What an attribute's name breaks, in words, or nothing. Names are those of the file: of pieces.
std::optional<std::string> bad_attribute_name(const Attributes& attributes);

// What is in the header of a file of `bytes` bytes that our readers do not take, or that the file
// cannot hold, or nothing. The library believes a header, and allocates what it claims: call this
// before it opens the file. The stream stands at the file's beginning, and does so afterwards.
// Throws what the library and the stream throw.
std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes);

// Of a header that our readers take: channels as texels hold them, colours as R G B [A] rather than
// in the file's alphabetical order; texts whole.
ExrFacts facts_of(const Imf::Header& header);

// E0304.
config::Diagnostic damaged_exr(const std::string& name, const std::string& reason);

}  // namespace skybake
