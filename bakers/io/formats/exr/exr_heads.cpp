#include "bakers/io/formats/exr/exr_heads.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <exception>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_library.h"
#include "bakers/io/formats/exr/exr_stream.h"
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

}  // namespace

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
        if (auto failure = stream.failure()) return {{}, {*failure}};
        return {{}, {damaged_exr(path.string(), error.what())}};
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

}  // namespace skybake
