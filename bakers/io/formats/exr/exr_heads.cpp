#include "bakers/io/formats/exr/exr_heads.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include "bakers/io/formats/exr/exr_library.h"
#include "config/text/key_path.h"

namespace skybake {

namespace {

std::string kind_of(const Imf::Header& header, int version) {
    const std::string type = header.hasType() ? header.type() : "";
    const bool is_deep = type == Imf::DEEPSCANLINE || type == Imf::DEEPTILE;
    const bool is_tiled =
        header.hasTileDescription() && (type.empty() ? Imf::isTiled(version) : Imf::isTiled(type));
    if (!is_tiled) return is_deep ? "deep scan lines" : "scan lines";
    const Imf::TileDescription& tiles = header.tileDescription();
    constexpr std::array levels = {"", ", one level after another", ", levels along both axes"};
    const auto mode = static_cast<std::size_t>(tiles.mode);
    return fmt::format("{}tiles of {} x {}{}", is_deep ? "deep " : "", tiles.xSize, tiles.ySize,
                       mode < levels.size() ? levels[mode] : "");
}

std::array<int, 4> window_of(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, box.max.x, box.max.y};
}

constexpr std::string_view own_names = "skybake/";

// Whether a byte is the second or a later one of a character of UTF-8.
bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// Returns how many of the first bytes of a text make its next piece. If the bytes are not UTF-8, so
// that a character seems to have more than four bytes, the piece has the greatest allowed length.
std::size_t piece_length(std::string_view text) {
    constexpr std::size_t most = longest_attribute - 1;
    constexpr std::size_t longest_character = 4;
    if (text.size() <= most) return text.size();
    std::size_t length = most;
    while (length > most - longest_character && continues_character(text[length])) --length;
    return continues_character(text[length]) ? most : length;
}

struct PieceName {
    std::string whole;  // the name of the whole text
    std::size_t index = 0;
};

// Parses a name such as "skybake/parameters.12". Returns nothing for a name that split_attributes
// does not make.
std::optional<PieceName> piece_name(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || name.substr(0, own_names.size()) != own_names) return {};
    const std::string_view digits = name.substr(dot + 1);
    PieceName piece{std::string(name.substr(0, dot)), 0};
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, piece.index);
    if (read.ec != std::errc{} || read.ptr != end) return {};
    if (std::to_string(piece.index) != digits) return {};  // "01"
    return piece;
}

using Pieces = std::map<std::size_t, std::string>;  // by index

// Whether the pieces are numbered from 0 on without a gap.
bool are_complete(const Pieces& pieces) { return pieces.rbegin()->first + 1 == pieces.size(); }

bool has_attribute(const Attributes& attributes, const std::string& name) {
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const auto& attribute) { return attribute.first == name; });
}

void append_joined(const std::string& name, const Pieces& pieces, Attributes& attributes) {
    std::string& whole = attributes.emplace_back(name, "").second;
    for (const auto& [index, text] : pieces) whole += text;
}

void append_as_they_are(const std::string& name, const Pieces& pieces, Attributes& attributes) {
    for (const auto& [index, text] : pieces) {
        attributes.emplace_back(fmt::format("{}.{}", name, index), text);
    }
}

}  // namespace

ExrPartHead part_of(const Imf::Header& header, int version) {
    ExrPartHead part;
    if (header.hasName()) part.name = header.name();
    part.kind = kind_of(header, version);
    part.compression = codec_name(header);
    part.data_window = window_of(header.dataWindow());
    part.display_window = window_of(header.displayWindow());
    constexpr std::array types = {"uint", "half", "float"};
    for (auto one = header.channels().begin(); one != header.channels().end(); ++one) {
        const Imf::Channel& channel = one.channel();
        const auto type = static_cast<std::size_t>(channel.type);
        part.channels.push_back({one.name(),
                                 type < types.size() ? types[type] : "unknown",
                                 {channel.xSampling, channel.ySampling}});
    }
    part.attributes = header_texts(header);
    return part;
}

config::Outcome<std::vector<ExrPartHead>> read_exr_heads(const std::filesystem::path& path) {
    config::Outcome<FileInput> input = FileInput::open(path);
    if (!input.value) return {{}, std::move(input.diagnostics)};
    ExrStream stream(path.string(), std::move(*input.value));
    try {
        int version = 0;
        std::vector<ExrPartHead> parts;
        for (const Imf::Header& header : exr_headers(stream, stream.size(), version)) {
            parts.push_back(part_of(header, version));
        }
        return {std::move(parts), {}};
    } catch (const std::exception& error) {
        if (auto failure = stream.failure()) return *failure;
        return damaged_exr(path.string(), error.what());
    }
}

std::string subsampled_channel(const std::vector<ExrPartHead>& parts) {
    for (const ExrPartHead& part : parts) {
        for (const ExrChannelHead& channel : part.channels) {
            if (channel.sampling == std::array{1, 1}) continue;
            return fmt::format("its channel `{}` is subsampled ({} x {})",
                               config::printable(channel.name), channel.sampling[0],
                               channel.sampling[1]);
        }
    }
    return "";
}

Attributes split_attributes(const Attributes& attributes) {
    Attributes result;
    for (const auto& [name, text] : attributes) {
        if (text.size() < longest_attribute) {
            result.emplace_back(name, text);
            continue;
        }
        std::string_view rest = text;
        for (std::size_t i = 0; !rest.empty(); ++i) {
            const std::size_t length = piece_length(rest);
            result.emplace_back(fmt::format("{}.{}", name, i), rest.substr(0, length));
            rest.remove_prefix(length);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

Attributes joined_attributes(const Attributes& attributes) {
    Attributes result;
    std::map<std::string, Pieces> split;
    for (const auto& [name, text] : attributes) {
        if (auto piece = piece_name(name)) {
            split[piece->whole][piece->index] = text;
        } else {
            result.emplace_back(name, text);
        }
    }
    for (const auto& [name, pieces] : split) {
        if (are_complete(pieces) && !has_attribute(attributes, name)) {
            append_joined(name, pieces, result);
        } else {
            append_as_they_are(name, pieces, result);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace skybake
