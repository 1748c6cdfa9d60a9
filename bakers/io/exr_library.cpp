#include "bakers/io/exr_library.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bakers/io/file_diagnostic.h"

namespace skybake {
namespace {

using config::Compression;
using config::PixelType;

constexpr std::size_t longest_attribute_name = 31;
// Pinned, since the library's default has changed between releases and bytes must not.
constexpr int deflate_level = 4;
// No codec of the profile makes more of a byte than deflate, 1032. A header that promises more
// texels than that is damaged, and would otherwise have them allocated.
constexpr double largest_expansion = 1100;
constexpr double expansion_slack = 65536;

struct CompressionName {
    Compression ours;
    Imf::Compression theirs;
};
constexpr std::array<CompressionName, 4> compression_names = {{
    {Compression::none, Imf::NO_COMPRESSION},
    {Compression::zip, Imf::ZIP_COMPRESSION},
    {Compression::zips, Imf::ZIPS_COMPRESSION},
    {Compression::piz, Imf::PIZ_COMPRESSION},
}};

Imf::Compression to_library(Compression compression) {
    for (const CompressionName& name : compression_names) {
        if (name.ours == compression) return name.theirs;
    }
    return Imf::NO_COMPRESSION;
}

std::optional<Compression> from_library(Imf::Compression compression) {
    for (const CompressionName& name : compression_names) {
        if (name.theirs == compression) return name.ours;
    }
    return std::nullopt;
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

}  // namespace

Imf::Header make_exr_header(const ExrFacts& facts) {
    Imf::Header header(facts.width, facts.height, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y,
                       to_library(facts.compression));
    header.zipCompressionLevel() = deflate_level;
    const Imf::PixelType type = facts.pixel_type == PixelType::half ? Imf::HALF : Imf::FLOAT;
    for (const std::string& name : facts.channel_names) {
        header.channels().insert(name, Imf::Channel(type));
    }
    for (const auto& [name, text] : facts.attributes) {
        header.insert(name, Imf::StringAttribute(text));
    }
    return header;
}

std::optional<std::string> bad_attribute_name(const Attributes& attributes) {
    for (const auto& [name, text] : attributes) {
        if (name.empty() || name.size() > longest_attribute_name) {
            return fmt::format("the attribute name `{}` has {} characters, {} are the most", name,
                               name.size(), longest_attribute_name);
        }
    }
    return std::nullopt;
}

std::optional<std::string> unknown_layout(const Imf::Header& header, int version,
                                          std::uint64_t bytes) {
    if (Imf::isTiled(version)) return "tiled images are not read";
    if (Imf::isMultiPart(version)) return "images of several parts are not read";
    if (Imf::isNonImage(version)) return "deep images are not read";
    if (!from_library(header.compression()))
        return "its compression is not one of none, zip, zips, piz";
    if (auto reason = unknown_channels(header.channels())) return reason;
    const Imath::Box2i window = header.dataWindow();
    // A part of an image, or one with a margin: its first texel is not where the axes begin.
    if (window != header.displayWindow()) {
        return "its data window is not its display window: cropped images are not read";
    }
    const double width = static_cast<double>(window.max.x) - window.min.x + 1;
    const double height = static_cast<double>(window.max.y) - window.min.y + 1;
    double bytes_per_texel = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        bytes_per_texel += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    if (width * height * bytes_per_texel >
        largest_expansion * static_cast<double>(bytes) + expansion_slack) {
        return fmt::format("its {} bytes cannot hold {} x {} texels", bytes, width, height);
    }
    return std::nullopt;
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
    facts.compression = *from_library(header.compression());
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text != nullptr) facts.attributes.emplace_back(attribute.name(), text->value());
    }
    return facts;
}

config::Diagnostic damaged_exr(const std::string& name, const std::string& reason) {
    return file_error("E0304", name,
                      fmt::format("cannot read `{}` as an OpenEXR image: {}", name, reason));
}

}  // namespace skybake
