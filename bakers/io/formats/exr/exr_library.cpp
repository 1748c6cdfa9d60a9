#include "bakers/io/formats/exr/exr_library.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "bakers/io/files/file_io.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

using config::Compression;
using config::PixelType;

constexpr std::size_t longest_attribute_name = 31;
// The level is fixed, because the library's default has changed between releases but files must not
// change.
constexpr int deflate_level = 4;
// No codec that skybake reads expands a byte to more than deflate's 1032 bytes. A header that
// promises more texels than that is damaged; without this limit, memory would be allocated for
// them.
constexpr double largest_expansion = 1100;
constexpr double expansion_slack = 65536;

struct Codec {
    Compression ours;
    Imf::Compression theirs;
    int rows;  // rows that it packs together
};
constexpr std::array<Codec, 4> codecs = {{
    {Compression::none, Imf::NO_COMPRESSION, 1},
    {Compression::zip, Imf::ZIP_COMPRESSION, 16},
    {Compression::zips, Imf::ZIPS_COMPRESSION, 1},
    {Compression::piz, Imf::PIZ_COMPRESSION, 32},
}};

Imf::Compression to_library(Compression compression) {
    for (const Codec& codec : codecs) {
        if (codec.ours == compression) return codec.theirs;
    }
    return Imf::NO_COMPRESSION;
}

// Returns null for a codec that skybake does not use.
const Codec* codec_of(Imf::Compression compression) {
    for (const Codec& codec : codecs) {
        if (codec.theirs == compression) return &codec;
    }
    return nullptr;
}

std::vector<std::string> texel_order(std::vector<std::string> names) {
    const std::vector<std::string> rgba = {"R", "G", "B", "A"};
    const std::vector<std::string> rgb = {"R", "G", "B"};
    for (const auto& order : {rgba, rgb}) {
        if (std::is_permutation(names.begin(), names.end(), order.begin(), order.end()))
            return order;
    }
    return names;
}

std::optional<std::string> unknown_channels(const Imf::ChannelList& channels) {
    std::optional<Imf::PixelType> type;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
            return "subsampled channels are not read";
        }
        if (channel.channel().type == Imf::UINT) return "integer channels are not read";
        if (type.value_or(channel.channel().type) != channel.channel().type) {
            return "channels of different types are not read";
        }
        type = channel.channel().type;
    }
    if (!type) return "it has no channels";
    return std::nullopt;
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

std::int32_t read_integer(Imf::IStream& stream) {
    std::array<char, 4> bytes{};
    stream.read(bytes.data(), 4);
    return std::bit_cast<std::int32_t>(bytes);
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
        bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    return bytes;
}

// Whether a file of `bytes` bytes can hold the image. It has the texels and, for each block of
// rows, the block's position in the file, the row's number, the length of the packed data, and at
// least one byte of data.
bool can_hold(std::uint64_t bytes, const Imf::Header& header, const Codec& codec) {
    const ImageSize size = size_of_image(header);
    const double file = static_cast<double>(bytes);
    const double texels = size.width * size.height * bytes_per_texel(header);
    const bool is_plain = codec.ours == Compression::none;
    if (texels > (is_plain ? file : largest_expansion * file + expansion_slack)) return false;
    constexpr double bytes_per_block = 8 + 4 + 4 + 1;
    return std::ceil(size.height / codec.rows) * bytes_per_block <= file;
}

// Returns what is unknown in a header, in words, or nothing. The header is not larger than its
// file.
std::optional<std::string> unknown_layout(const Imf::Header& header, int version,
                                          std::uint64_t bytes) {
    if (Imf::isTiled(version)) return "tiled images are not read";
    if (Imf::isMultiPart(version)) return "images of several parts are not read";
    if (Imf::isNonImage(version)) return "deep images are not read";
    const Codec* codec = codec_of(header.compression());
    if (codec == nullptr) return "its compression is not one of none, zip, zips, piz";
    if (auto reason = unknown_channels(header.channels())) return reason;
    // This is a part of an image, or an image with a margin, so its first texel is not where the
    // axes begin.
    if (header.dataWindow() != header.displayWindow()) {
        return "its data window is not its display window: cropped images are not read";
    }
    if (can_hold(bytes, header, *codec)) return std::nullopt;
    const ImageSize size = size_of_image(header);
    return fmt::format("its {} bytes cannot hold {} x {} texels", bytes, size.width, size.height);
}

}  // namespace

Imf::Header make_exr_header(const ExrFacts& facts) {
    Imf::Header header(facts.width, facts.height, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                       to_library(facts.compression));
    header.zipCompressionLevel() = deflate_level;
    const Imf::PixelType type = facts.pixel_type == PixelType::half ? Imf::HALF : Imf::FLOAT;
    for (const std::string& name : facts.channel_names) {
        header.channels().insert(name, Imf::Channel(type));
    }
    for (const auto& [name, text] : split_attributes(facts.attributes)) {
        header.insert(name, Imf::StringAttribute(text));
    }
    return header;
}

std::optional<std::string> bad_attribute_name(const Attributes& attributes) {
    for (const auto& [name, text] : split_attributes(attributes)) {
        if (name.empty() || name.size() > longest_attribute_name) {
            return fmt::format("the attribute name `{}` has {} characters, {} are the most", name,
                               name.size(), longest_attribute_name);
        }
    }
    return std::nullopt;
}

std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes) {
    constexpr std::uint64_t first_attribute = 8;
    const std::int32_t magic = read_integer(stream);
    int version = read_integer(stream);
    if (magic != Imf::MAGIC || !Imf::supportsFlags(Imf::getFlags(version))) {
        return "it is not an OpenEXR file";
    }
    if (auto reason = oversized_attribute(stream, bytes)) return reason;
    stream.seekg(first_attribute);
    Imf::Header header;
    header.readFrom(stream, version);
    stream.seekg(0);
    return unknown_layout(header, version, bytes);
}

ExrFacts facts_of(const Imf::Header& header) {
    ExrFacts facts;
    const Imath::Box2i window = header.dataWindow();
    facts.width = window.max.x - window.min.x + 1;
    facts.height = window.max.y - window.min.y + 1;
    std::vector<std::string> names;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        names.emplace_back(channel.name());
        facts.pixel_type =
            channel.channel().type == Imf::HALF ? PixelType::half : PixelType::float32;
    }
    facts.channel_names = texel_order(std::move(names));
    facts.compression = codec_of(header.compression())->ours;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text != nullptr) facts.attributes.emplace_back(attribute.name(), text->value());
    }
    facts.attributes = joined_attributes(facts.attributes);
    return facts;
}

config::Diagnostic damaged_exr(const std::string& name, const std::string& reason) {
    return file_error("E0304", name,
                      fmt::format("cannot read `{}` as an OpenEXR image: {}", name, reason));
}

}  // namespace skybake
