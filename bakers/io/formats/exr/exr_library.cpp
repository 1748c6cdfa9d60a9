#include "bakers/io/formats/exr/exr_library.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <ImfXdr.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "bakers/io/files/file_io.h"
#include "config/text/key_path.h"

namespace skybake {

namespace {

using config::Compression;

constexpr std::size_t longest_attribute_name = 31;
// Deflate expands a byte to at most 1032 bytes, and PXR24 stores floats as 3 of their bytes. DWA keeps
// one value of 64 where they are equal. A header that promises more texels than that is damaged;
// without this limit, memory would be allocated for them.
constexpr double deflate_expansion = 1500;
constexpr double dwa_expansion = 64 * 1100;
constexpr double expansion_slack = 65536;
constexpr double block_slack = 64 << 20;  // a block may reach beyond a small image

struct Codec {
    const char* name;
    std::optional<Compression> ours;  // none if skybake reads it and does not write it
    int rows;                         // rows that it packs together
    double expansion = deflate_expansion;
};
// In the order of Imf::Compression.
constexpr std::array<Codec, Imf::NUM_COMPRESSION_METHODS> codecs = {{
    {"none", Compression::none, 1, 1},
    {"rle", std::nullopt, 1},
    {"zips", Compression::zips, 1},
    {"zip", Compression::zip, 16},
    {"piz", Compression::piz, 32},
    {"pxr24", std::nullopt, 16},
    {"b44", std::nullopt, 32},
    {"b44a", std::nullopt, 32},
    {"dwaa", std::nullopt, 32, dwa_expansion},
    {"dwab", std::nullopt, 256, dwa_expansion},
}};

std::size_t codec_of(Compression compression) {
    const auto found = std::ranges::find(codecs, compression, &Codec::ours);
    return static_cast<std::size_t>(found - codecs.begin());
}

// Returns null for a codec that is not known.
const Codec* codec_of(const Imf::Header& header) {
    const auto number = static_cast<std::size_t>(header.compression());
    return number < codecs.size() ? &codecs[number] : nullptr;
}

std::vector<std::string> texel_order(std::vector<std::string> names) {
    constexpr std::string_view letters = "RGBA";
    const std::size_t count = std::min(names.size(), letters.size());
    std::vector<std::string> order;
    for (const char letter : letters.substr(0, count)) order.emplace_back(1, letter);
    const bool is_of_colours =
        std::is_permutation(names.begin(), names.end(), order.begin(), order.end());
    return is_of_colours ? order : names;
}

std::optional<std::string> unknown_channels(const ExrPartHead& part) {
    if (const std::string subsampled = subsampled_channel({part}); !subsampled.empty()) {
        return subsampled;
    }
    if (part.channels.empty()) return "it has no channels";
    const bool has_integers = std::ranges::any_of(
        part.channels, [](const ExrChannelHead& channel) { return channel.type == "uint"; });
    return has_integers ? std::optional("integer channels are not read") : std::nullopt;
}

// Whether a name is so long that old readers could not hold it. Files must say so.
bool has_long_names(const Imf::Header& header) {
    const auto is_long = [](const char* name) {
        return std::strlen(name) > longest_attribute_name;
    };
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        if (is_long(attribute.name()) || is_long(attribute.attribute().typeName())) return true;
    }
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (is_long(channel.name())) return true;
    }
    return false;
}

// Reads a name up to the byte 0 that ends it.
std::string read_name(Imf::IStream& stream) {
    constexpr std::size_t longest_name = 255;  // the longest that EXR allows
    std::string name;
    for (char letter = 0; name.size() <= longest_name; name += letter) {
        stream.read(&letter, 1);
        if (letter == 0) return name;
    }
    throw std::runtime_error("a name in its header has no end");
}

int read_integer(Imf::IStream& stream) {
    int value = 0;
    Imf::Xdr::read<Imf::StreamIO>(stream, value);
    return value;
}

// Walks over the attributes to the end of the header. Returns the first one that claims more bytes
// than the file has, in words, or nothing.
std::optional<std::string> oversized_attribute(Imf::IStream& stream, std::uint64_t bytes) {
    for (std::string name; !(name = read_name(stream)).empty();) {
        read_name(stream);  // the name of its type
        const std::int32_t size = read_integer(stream);
        const std::uint64_t at = stream.tellg();
        if (size < 0 || at > bytes || static_cast<std::uint64_t>(size) > bytes - at) {
            return fmt::format("its attribute `{}` claims {} bytes, more than the file has",
                               config::printable(name), size);
        }
        stream.seekg(at + static_cast<std::uint64_t>(size));
    }
    return std::nullopt;
}

struct ImageSize {
    double width = 0;
    double height = 0;
};

ImageSize size_of_image(const Imf::Header& header) {
    const Imath::Box2i window = header.dataWindow();
    return {static_cast<double>(window.max.x) - window.min.x + 1,
            static_cast<double>(window.max.y) - window.min.y + 1};
}

double bytes_per_texel(const Imf::Header& header) {
    double bytes = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        const Imf::Channel& one = channel.channel();
        const double texels = std::max(1.0, double(one.xSampling) * one.ySampling);
        bytes += (one.type == Imf::HALF ? 2 : 4) / texels;
    }
    return bytes;
}

// The texels that are packed together: rows, or a tile.
ImageSize size_of_block(const Imf::Header& header, const Codec& codec) {
    if (!header.hasTileDescription()) return {size_of_image(header).width, double(codec.rows)};
    const Imf::TileDescription& tiles = header.tileDescription();
    return {static_cast<double>(tiles.xSize), static_cast<double>(tiles.ySize)};
}

// Whether a file of `bytes` bytes can hold the image. It has the texels and, for each block, the
// block's position in the file, the row's number, the length of the packed data, and at least one byte
// of data.
bool can_hold(std::uint64_t bytes, const Imf::Header& header, const Codec& codec) {
    const ImageSize size = size_of_image(header);
    const ImageSize block = size_of_block(header, codec);
    const double file = static_cast<double>(bytes);
    const double texel = bytes_per_texel(header);
    const double slack = codec.expansion == 1 ? 0 : expansion_slack;
    if (size.width * size.height * texel > codec.expansion * file + slack) return false;
    if (block.width * block.height * texel > deflate_expansion * file + block_slack) return false;
    constexpr double bytes_per_block = 8 + 4 + 4 + 1;
    const double blocks =
        std::ceil(size.width / block.width) * std::ceil(size.height / block.height);
    const bool counts_more = header.hasChunkCount() && header.chunkCount() * 8.0 > file;
    return blocks * bytes_per_block <= file && !counts_more;
}

// Returns what is wrong with a header, in words, or nothing. The header is not larger than its file.
std::optional<std::string> false_size(const Imf::Header& header, std::uint64_t bytes) {
    const Codec* codec = codec_of(header);
    if (codec == nullptr) return "its compression is not known";
    if (can_hold(bytes, header, *codec)) return std::nullopt;
    const ImageSize size = size_of_image(header);
    return fmt::format("its {} bytes cannot hold {} x {} texels", bytes, size.width, size.height);
}

}  // namespace

Imf::Header make_exr_header(const ExrFacts& facts) {
    Imf::Header header(facts.width, facts.height, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                       static_cast<Imf::Compression>(codec_of(facts.compression)));
    const Imf::PixelType type = facts.pixel_type == PixelType::half ? Imf::HALF : Imf::FLOAT;
    for (const std::string& name : facts.channel_names) {
        header.channels().insert(name, Imf::Channel(type));
    }
    for (const auto& [name, text] : split_attributes(facts.attributes)) {
        header.insert(name, Imf::StringAttribute(text));
    }
    return header;
}

std::string exr_file_head(const Imf::Header& header) {
    header.sanityCheck();
    Imf::StdOSStream file;
    Imf::Xdr::write<Imf::StreamIO>(file, Imf::MAGIC);
    Imf::Xdr::write<Imf::StreamIO>(
        file, Imf::EXR_VERSION | (has_long_names(header) ? Imf::LONG_NAMES_FLAG : 0));
    header.writeTo(file);
    return file.str();
}

int rows_of_exr_chunk(Compression compression) { return codecs[codec_of(compression)].rows; }

// The library packs the rows as an image of their own, of which they are the only chunk.
std::string chunk_of_library(const ExrFacts& facts, int rows, const std::string& texels) {
    const Imf::Header header = make_exr_header({facts.width, rows, facts.channel_names,
                                                facts.pixel_type, facts.compression, Attributes()});
    const std::size_t value = facts.pixel_type == PixelType::half ? 2 : 4;
    const std::size_t channel_bytes = value * static_cast<std::size_t>(facts.width);
    const std::size_t row_bytes = channel_bytes * facts.channel_names.size();
    Imf::FrameBuffer buffer;
    const char* from = texels.data();
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        buffer.insert(channel.name(), Imf::Slice(channel.channel().type, const_cast<char*>(from),
                                                 value, row_bytes));
        from += channel_bytes;
    }
    Imf::StdOSStream file;
    {
        Imf::OutputFile image(file, header, 0);  // 0: no further threads
        image.setFrameBuffer(buffer);
        image.writePixels(rows);
    }
    constexpr std::size_t position_and_chunk_head = 8 + 4 + 4;
    return file.str().substr(exr_file_head(header).size() + position_and_chunk_head);
}

std::vector<Imf::Header> exr_headers(Imf::IStream& stream, std::uint64_t bytes, int& version) {
    constexpr std::size_t most_parts = 1024;
    const std::int32_t magic = read_integer(stream);
    version = read_integer(stream);
    if (magic != Imf::MAGIC || !Imf::supportsFlags(Imf::getFlags(version))) {
        throw std::runtime_error("it is not an OpenEXR file");
    }
    std::vector<Imf::Header> headers;
    while (headers.size() < most_parts) {
        const std::uint64_t begin = stream.tellg();
        if (auto reason = oversized_attribute(stream, bytes)) throw std::runtime_error(*reason);
        const std::uint64_t end = stream.tellg();
        if (end == begin + 1) break;  // an empty header ends those of several parts
        stream.seekg(begin);
        headers.emplace_back().readFrom(stream, version);
        if (!Imf::isMultiPart(version)) break;
    }
    if (headers.empty()) throw std::runtime_error("its header is empty");
    return headers;
}

std::string codec_name(const Imf::Header& header) {
    const Codec* codec = codec_of(header);
    return codec == nullptr ? "unknown" : codec->name;
}

std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes, int part) {
    int version = 0;
    const std::vector<Imf::Header> headers = exr_headers(stream, bytes, version);
    stream.seekg(0);
    for (const Imf::Header& header : headers) {
        const bool has_type = header.hasType() && Imf::isImage(header.type());
        if (Imf::isNonImage(version) && !has_type) return "deep images are not read";
        if (auto reason = false_size(header, bytes)) return reason;
    }
    const auto number = static_cast<std::size_t>(part);
    if (number >= headers.size()) return "it has fewer parts";
    return unknown_channels(part_of(headers[number], version));
}

ExrFacts facts_of(const Imf::Header& header) {
    ExrFacts facts;
    const Imath::Box2i window = header.dataWindow();
    facts.width = window.max.x - window.min.x + 1;
    facts.height = window.max.y - window.min.y + 1;
    std::vector<std::string> names;
    bool is_half = true;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        names.emplace_back(channel.name());
        is_half = is_half && channel.channel().type == Imf::HALF;
    }
    facts.pixel_type = is_half ? PixelType::half : PixelType::float32;
    facts.channel_names = texel_order(std::move(names));
    facts.compression = codec_of(header)->ours.value_or(Compression::none);
    facts.codec = codec_of(header)->name;
    const Imath::Box2i display = header.displayWindow();
    if (window != display) {
        facts.window = fmt::format("({}, {}) to ({}, {}) of ({}, {}) to ({}, {})", window.min.x,
                                   window.min.y, window.max.x, window.max.y, display.min.x,
                                   display.min.y, display.max.x, display.max.y);
    }
    facts.attributes = header_texts(header);
    return facts;
}

Attributes header_texts(const Imf::Header& header) {
    Attributes texts;
    for (auto one = header.begin(); one != header.end(); ++one) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&one.attribute());
        const std::string name = one.name();
        if (text && name != "name" && name != "type") texts.emplace_back(name, text->value());
    }
    return joined_attributes(texts);
}

config::Diagnostic damaged_exr(const std::string& name, const std::string& reason) {
    return file_error("E0304", name,
                      fmt::format("cannot read `{}` as an OpenEXR image: {}", name, reason));
}

}  // namespace skybake
