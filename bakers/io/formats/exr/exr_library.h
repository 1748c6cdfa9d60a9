// Translates between skybake's types and OpenEXR's. Only exr*.cpp include this file and know the
// library.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/attribute_pieces.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

// Makes the header of a file as skybake writes it.
Imf::Header make_exr_header(const ExrFacts& facts);

// Returns the bytes of a file with this header up to the table of its chunks' positions. Throws
// what the library throws if files cannot have this header.
std::string exr_file_head(const Imf::Header& header);

// Returns how many rows are packed together.
int rows_of_exr_chunk(config::Compression compression);

// Packs a chunk by the library, which is the only one to know PIZ, and returns its data. `texels`
// has the chunk's rows, the channels of each row one after the other in the order of their names.
// Throws what the library throws. Any thread may call it.
std::string chunk_of_library(const ExrFacts& facts, int rows, const std::string& texels);

// Returns which rule an attribute's name breaks, in words, or nothing. The names are those in the
// file, so long texts are already in pieces.
std::optional<std::string> bad_attribute_name(const Attributes& attributes);

// Reads the headers of all parts of a file of `bytes` bytes, at least one, and its version with its
// flags. Throws what the library and the stream throw, and std::runtime_error with the reason if they
// claim more bytes than the file has.
std::vector<Imf::Header> exr_headers(Imf::IStream& stream, std::uint64_t bytes, int& version);

// Returns "zip", "dwaa" or "unknown".
std::string codec_name(const Imf::Header& header);

// Returns what a part of a file of `bytes` bytes contains that skybake does not read or that the file is
// too short to hold, in words, or nothing. Call this before the library opens the file, because the
// library trusts the header and allocates what it claims. The stream is at the file's beginning before
// and after the call. Throws what the library and the stream throw.
std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes,
                                             int part = 0);

// Returns the texts of a header by name, joined, without the name and the type of a part.
Attributes header_texts(const Imf::Header& header);

// Returns the facts of a header that skybake reads.
ExrFacts facts_of(const Imf::Header& header);

// Returns E0304 for a damaged file.
config::Diagnostic damaged_exr(const std::string& name, const std::string& reason);

}  // namespace skybake
