#include "bakers/io/formats/exr/exr_library.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
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
using config::PixelType;

constexpr std::size_t longest_attribute_name = 31;
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

const Codec& codec_of(Compression compression) {
    return *std::find_if(codecs.begin(), codecs.end(),
                         [compression](const Codec& codec) { return codec.ours == compression; });
}

// Returns null for a codec that skybake does not use.
const Codec* codec_of(Imf::Compression compression) {
    for (const Codec& codec : codecs) {
        if (codec.theirs == compression) return &codec;
    }
    return nullptr;
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

// A file in memory.
class MemoryFile : public Imf::OStream {
  public:
    MemoryFile() : Imf::OStream("memory") {}
    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
        std::memcpy(bytes_.data() + position_, bytes, size);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = static_cast<std::size_t>(position); }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

void write_integer(std::int32_t value, Imf::OStream& stream) {
    stream.write(std::bit_cast<std::array<char, 4>>(value).data(), 4);
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
                       codec_of(facts.compression).theirs);
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
    MemoryFile file;
    write_integer(Imf::MAGIC, file);
    write_integer(Imf::EXR_VERSION | (has_long_names(header) ? Imf::LONG_NAMES_FLAG : 0), file);
    header.writeTo(file);
    return file.bytes();
}

int rows_of_exr_chunk(Compression compression) { return codec_of(compression).rows; }

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
    MemoryFile file;
    {
        Imf::OutputFile image(file, header, 0);  // 0: no further threads
        image.setFrameBuffer(buffer);
        image.writePixels(rows);
    }
    constexpr std::size_t position_and_chunk_head = 8 + 4 + 4;
    return file.bytes().substr(exr_file_head(header).size() + position_and_chunk_head);
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

std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes) {
    int version = 0;
    const std::vector<Imf::Header> headers = exr_headers(stream, bytes, version);
    stream.seekg(0);
    return unknown_layout(headers.front(), version, bytes);
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
