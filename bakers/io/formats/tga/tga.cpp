// Assets as Targa images of unorm8 without compression: grey, RGB or RGBA, which the file stores as
// BGR and BGRA. Rows stand from the top. Alpha is a number like the others and multiplies nothing,
// which the extension area of the format's version 2.0 says. The slices of volumes are arranged in
// the image as sheet.h says.
//
// The developer area has one entry, of the tag 32768, the first that programs may use: the
// description of the asset, as text.
//
// Source: Truevision, "TGA File Format Specification", version 2.0, 1991.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/little_endian.h"
#include "bakers/io/formats/sheet.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t head_size = 18;
constexpr std::size_t extension_size = 495;
constexpr std::size_t alpha_kind_at = 494;  // in the extension area
constexpr char alpha_of_data = 3;           // present, and not multiplied with
constexpr std::string_view signature("TRUEVISION-XFILE.\0", 18);
constexpr std::size_t foot_size = 8 + signature.size();
constexpr std::uint16_t description_tag = 32768;
constexpr int largest_tga_edge = 65535;

std::string tga_head(int width, int height, std::size_t channels) {
    constexpr char true_colour = 2;
    constexpr char grey = 3;
    constexpr char from_top = 0x20;
    std::string head = {0, 0, channels == 1 ? grey : true_colour};
    head.resize(12);  // no palette, and the origin is (0, 0)
    append_little(static_cast<std::uint64_t>(width), 2, head);
    append_little(static_cast<std::uint64_t>(height), 2, head);
    head += static_cast<char>(8 * channels);
    head += static_cast<char>(from_top | (channels == 4 ? 8 : 0));  // bits of alpha
    return head;
}

// Returns what follows the image: description, developer area, extension area and foot.
std::string tga_tail(std::uint64_t offset, const std::string& description, bool has_alpha) {
    std::string tail = description;
    const std::uint64_t directory = offset + tail.size();
    append_little(1, 2, tail);
    append_little(description_tag, 2, tail);
    append_little(offset, 4, tail);
    append_little(description.size(), 4, tail);
    const std::uint64_t extension = offset + tail.size();
    std::string area;
    append_little(extension_size, 2, area);
    area.resize(extension_size);
    constexpr std::string_view program = "skybake";
    constexpr std::size_t program_at = 426;
    std::copy(program.begin(), program.end(), area.begin() + program_at);
    area[alpha_kind_at] = has_alpha ? alpha_of_data : '\0';
    tail += area;
    append_little(extension, 4, tail);
    append_little(directory, 4, tail);
    return tail + std::string(signature);
}

// Interleaves the channels of a row in the order of the format.
void interleave_row(const SheetRows& rows, int y, std::size_t width, std::size_t channels,
                    std::string& row) {
    row.resize(width * channels);
    for (std::size_t c = 0; c < channels; ++c) {
        const std::size_t at = channels >= 3 && c < 3 ? 2 - c : c;
        const char* from = rows.texels + c * rows.plane + static_cast<std::size_t>(y) * width;
        for (std::size_t x = 0; x < width; ++x) row[x * channels + at] = from[x];
    }
}

// Returns what TGA files cannot hold of the asset, in words, or nothing.
std::optional<std::string> tga_obstacle(const Baked& baked, int level) {
    const std::size_t channels = baked.channel_names.size();
    if (channels != 1 && channels != 3 && channels != 4) {
        return "TGA files hold one, three or four channels";
    }
    if (baked.pixel_type != PixelType::unorm8) return "TGA files hold unorm8";
    const std::array<int, 3>& size = baked.levels[static_cast<std::size_t>(level)].size;
    const auto [width, height] = image_size(size, sheet_grid(size, baked));
    if (width <= largest_tga_edge && height <= largest_tga_edge) return std::nullopt;
    return fmt::format("an image of {} x {} texels is too large", width, height);
}

Outcome<bool> write_tga_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    if (const auto reason = tga_obstacle(baked, content.level)) return contradiction(path, *reason);
    const std::size_t channels = baked.channel_names.size();
    SheetWriter sheet(baked, content.level, content.threads, content.progress);
    FileOutput output(path);
    output.write(tga_head(sheet.width(), sheet.height(), channels));
    std::string row;
    const bool complete = sheet.write([&](const SheetRows& rows, int) {
        for (int y = 0; y < rows.count; ++y) {
            interleave_row(rows, y, static_cast<std::size_t>(sheet.width()), channels, row);
            output.write(row);
        }
    });
    output.write(tga_tail(output.position(), content.metadata, channels == 4));
    return output.finished(complete);
}

// Returns the description, or nothing if the areas behind the image are not those of skybake.
std::optional<std::string> tga_description(FileInput& file) {
    if (file.size() < foot_size) return std::nullopt;
    const auto foot = file_part(file, file.size() - foot_size, foot_size);
    if (!foot || foot->substr(8) != signature) return std::nullopt;
    const auto directory = file_part(file, little(*foot, 4, 4), 12);
    if (!directory || little(*directory, 0, 2) != 1 ||
        little(*directory, 2, 2) != description_tag) {
        return std::nullopt;
    }
    return file_part(file, little(*directory, 4, 4), little(*directory, 8, 4));
}

Outcome<FileFacts> inspect_tga(FileInput& file) {
    const auto head = file_part(file, 0, head_size);
    if (!head) return damaged_file(file.path(), "TGA", "it ends within its head");
    FileFacts facts;
    facts.pixel_type = PixelType::unorm8;
    facts.image_size = {little(*head, 12, 2), little(*head, 14, 2)};
    facts.channels = little(*head, 16, 1) / 8;
    if (*head != tga_head(static_cast<int>(facts.image_size[0]),
                          static_cast<int>(facts.image_size[1]), facts.channels)) {
        return damaged_file(file.path(), "TGA", "its head is that of another kind of image");
    }
    const auto description = tga_description(file);
    if (!description) return damaged_file(file.path(), "TGA", "it ends early");
    facts.metadata = *description;
    return {std::move(facts), {}};
}

Outcome<bool> read_tga_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    const Outcome<FileFacts> facts = inspect_tga(file);
    if (!facts.value) return {{}, facts.diagnostics};
    const auto [width, height] = image_size(shape.size, shape.grid);
    const std::uint64_t row =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(shape.channels);
    if (facts.value->image_size != std::array{width, height} ||
        facts.value->channels != shape.channels || shape.pixel_type != PixelType::unorm8 ||
        file.size() < head_size + row * static_cast<std::uint64_t>(height)) {
        return other_size(file.path());
    }
    std::string bytes;
    const auto read = [&](int first, int count,
                          float* texels) -> std::optional<config::Diagnostic> {
        bytes.resize(row * static_cast<std::uint64_t>(count));
        const auto done = file.read(head_size + row * static_cast<std::uint64_t>(first),
                                    bytes.data(), bytes.size());
        if (!done || *done < bytes.size()) return file.diagnostic();
        for (std::size_t i = 0; shape.channels >= 3 && i < bytes.size(); i += shape.channels) {
            std::swap(bytes[i], bytes[i + 2]);
        }
        load_values(bytes.data(), bytes.size(), PixelType::unorm8, texels);
        return std::nullopt;
    };
    return read_sheet({static_cast<int>(width), static_cast<int>(height), shape.channels, 16, read},
                      shape.size, shape.grid, visit);
}

}  // namespace

Format tga_format() {
    return {.format = config::FileFormat::tga,
            .write = write_tga_file,
            .inspect = inspect_tga,
            .read = read_tga_file};
}

}  // namespace skybake
