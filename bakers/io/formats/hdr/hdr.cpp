#include "bakers/io/formats/hdr/hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/formats/png/map_image.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view entry_line = "\n# skybake/asset ";  // and the entry's length
constexpr std::size_t hdr_foot_size = entry_line.size() + 11;

std::string hdr_head(std::int64_t width, std::int64_t height) {
    return fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
}

std::string hdr_foot(const std::string& entry) {
    return fmt::format("{}{:010}\n", entry_line, entry.size());
}

Outcome<bool> write_hdr_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    if (baked.channel_names.size() != 3 || baked.pixel_type != PixelType::rgbe) {
        return contradiction(path, "Radiance files hold three channels of rgbe");
    }
    const LoadedCodec<ImageCodec>& loaded = image_codec();
    if (loaded.codec == nullptr) return file_error("E0301", path.string(), loaded.reason);
    SheetWriter sheet(baked, content.level, content.threads, content.progress);
    std::vector<float> texels;
    const bool complete = sheet.write([&](const SheetRows& rows, int) {
        const auto* values = reinterpret_cast<const float*>(rows.texels);
        const std::size_t plane = rows.plane / sizeof(float);
        for (std::size_t i = 0; i < plane; ++i) {
            for (std::size_t c = 0; c < 3; ++c) texels.push_back(values[c * plane + i]);
        }
    });
    FileOutput output(path);
    if (complete) {
        const auto picture = loaded.codec->encode_hdr(sheet.width(), sheet.height(), texels);
        if (!picture.problem.empty()) return contradiction(path, picture.problem);
        output.write(picture.bytes);
        output.write(content.metadata + hdr_foot(content.metadata));
    }
    return output.finished(complete);
}

std::optional<std::string> entry_behind(FileInput& file) {
    const std::uint64_t end = file.size() - std::min<std::uint64_t>(file.size(), hdr_foot_size);
    const auto foot = file_part(file, end, hdr_foot_size);
    if (!foot || !foot->starts_with(entry_line)) return std::nullopt;
    const std::size_t length = std::strtoull(foot->c_str() + entry_line.size(), nullptr, 10);
    auto entry = length > end ? std::nullopt : file_part(file, end - length, length);
    if (entry && *foot != hdr_foot(*entry)) return std::nullopt;
    return entry;
}

Outcome<FileFacts> inspect_hdr(FileInput& file) {
    constexpr std::uint64_t most_head_bytes = 64;
    const auto head = file_part(file, 0, std::min(file.size(), most_head_bytes));
    FileFacts facts;
    auto& [width, height] = facts.image_size;
    const std::string first = hdr_head(0, 0);  // but for the size
    const std::size_t size_at = first.find("-Y") + 3;
    if (head && head->starts_with(first.substr(0, size_at))) {
        char* next = nullptr;
        height = std::strtoll(head->c_str() + size_at, &next, 10);
        width = std::strtoll(next + std::string_view(" +X ").size(), nullptr, 10);
    }
    if (!head || !head->starts_with(hdr_head(width, height))) {
        return damaged_file(file.path(), "Radiance", "its head is that of another program");
    }
    auto entry = entry_behind(file);
    if (!entry) return damaged_file(file.path(), "Radiance", "it ends early");
    facts.pixel_type = PixelType::rgbe;
    facts.channels = 3;
    facts.metadata = std::move(*entry);
    return {std::move(facts), {}};
}

Outcome<bool> read_hdr_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    const Outcome<FileFacts> facts = inspect_hdr(file);
    if (!facts.value) return {{}, facts.diagnostics};
    if (facts.value->image_size != image_size(shape.size, shape.grid) || shape.channels != 3 ||
        shape.pixel_type != PixelType::rgbe) {
        return other_size(file.path());
    }
    const Outcome<HdrPicture> picture = read_hdr_picture(file.path());
    if (!picture.value) return {{}, picture.diagnostics};
    return read_sheet(picture.value->rows, shape.size, shape.grid, visit);
}

}  // namespace

Outcome<HdrPicture> read_hdr_picture(const fs::path& path) {
    Outcome<FileInput> file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const LoadedCodec<ImageCodec>& loaded = image_codec();
    if (loaded.codec == nullptr) return file_error("E0300", path.string(), loaded.reason);
    const auto pixels = std::make_shared<const MapPixels>(loaded.codec->read(path, "R", 3));
    if (!pixels->problem.empty() || pixels->values.empty()) {
        return damaged_file(
            path, "Radiance",
            pixels->problem.empty() ? "it has no channels R, G and B" : pixels->problem);
    }
    const std::size_t row = 3 * static_cast<std::size_t>(pixels->width);
    const auto read = [pixels, row](int first, int count,
                                    float* texels) -> std::optional<config::Diagnostic> {
        std::copy_n(&pixels->values[static_cast<std::size_t>(first) * row],
                    static_cast<std::size_t>(count) * row, texels);
        return std::nullopt;
    };
    return {HdrPicture{{pixels->width, pixels->height, 3, 16, read},
                       entry_behind(*file.value).value_or("")},
            {}};
}

Format hdr_format() {
    return {.format = config::FileFormat::hdr,
            .write = write_hdr_file,
            .inspect = inspect_hdr,
            .read = read_hdr_file};
}

}  // namespace skybake
