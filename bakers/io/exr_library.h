// Between our words and OpenEXR's, for exr*.cpp alone: only they know the library.
#pragma once

#include <ImfHeader.h>

#include <optional>
#include <string>
#include <vector>

#include "bakers/io/exr.h"

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

// What an attribute's name breaks, in words, or nothing.
std::optional<std::string> bad_attribute_name(const Attributes& attributes);

// Everything about the header of a file of `bytes` bytes that our readers do not take, or nothing.
// `version` is the file's.
std::optional<std::string> unknown_layout(const Imf::Header& header, int version,
                                          std::uint64_t bytes);

// Of a header that our readers take: channels as texels hold them, colours as R G B [A] rather than
// in the file's alphabetical order.
ExrFacts facts_of(const Imf::Header& header);

// E0304.
config::Diagnostic damaged_exr(const std::string& name, const std::string& reason);

}  // namespace skybake
