#include "bakers/io/formats/exr/exr_file.h"

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/exr/exr_chunks.h"
#include "bakers/io/formats/exr/exr_library.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Returns what EXR files cannot hold of the asset, in words, or nothing.
std::optional<std::string> exr_obstacle(const Baked& baked, int level) {
    if (!config::facts_of(config::FileFormat::exr).holds(baked.pixel_type)) {
        return "EXR files hold float and half";
    }
    const std::array<int, 3>& size = baked.levels[static_cast<std::size_t>(level)].size;
    const auto [width, height] = image_size(size, sheet_grid(size, baked));
    constexpr std::int64_t largest = std::numeric_limits<int>::max();
    if (width <= largest && height <= largest) return std::nullopt;
    return fmt::format("an image of {} x {} texels is too large", width, height);
}

Outcome<bool> write_exr_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    if (const auto reason = exr_obstacle(baked, content.level)) return contradiction(path, *reason);
    FileOutput output(path);
    try {
        SheetWriter sheet(baked, content.level, content.threads, content.progress);
        const ExrFacts facts = {sheet.width(),       sheet.height(),
                                baked.channel_names, baked.pixel_type,
                                baked.compression,   {{metadata_name, content.metadata}}};
        const ExrChunks chunks(facts);
        ExrChunkWriter file(chunks, exr_file_head(make_exr_header(facts)), output);
        std::vector<ExrPiece> pieces(static_cast<std::size_t>(sheet.slots()));
        const auto piece = [&](int slot) -> ExrPiece& {
            return pieces[static_cast<std::size_t>(slot)];
        };
        const bool complete =
            sheet.write([&](const SheetRows&, int slot) { file.put(piece(slot)); },
                        [&](const SheetRows& rows, int slot) {
                            chunks.pack(rows, sheet.threads_per_box(), piece(slot));
                        });
        if (complete) file.finish();
        return output.finished(complete);
    } catch (const std::exception& error) {
        if (!output.finish()) return output.diagnostic();
        return contradiction(path,
                             fmt::format("OpenEXR cannot encode the image: {}", error.what()));
    }
}

Outcome<FileFacts> inspect_exr(FileInput& file) {
    const Outcome<ExrRows> image = ExrRows::open(file.path());
    if (!image.value) return {{}, image.diagnostics};
    const std::string& window = image.value->facts().window;
    if (!window.empty()) return damaged_exr(file.path().string(), "it is cropped to " + window);
    FileFacts facts;
    facts.pixel_type = image.value->facts().pixel_type;
    facts.names = image.value->facts().channel_names;
    facts.channels = facts.names.size();
    facts.compression = image.value->facts().codec;
    facts.image_size = {image.value->facts().width, image.value->facts().height};
    for (const auto& [name, text] : image.value->facts().attributes) {
        if (name == metadata_name) facts.metadata = text;
    }
    return {std::move(facts), {}};
}

Outcome<bool> read_exr_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    Outcome<ExrRows> image = ExrRows::open(file.path());
    if (!image.value) return {{}, std::move(image.diagnostics)};
    const RowSource rows = rows_of(*image.value);
    const std::array<std::int64_t, 2> size = {rows.width, rows.height};
    if (size != image_size(shape.size, shape.grid) || rows.channels != shape.channels) {
        return other_size(file.path());
    }
    return read_sheet(rows, shape.size, shape.grid, visit);
}

}  // namespace

Format exr_format() {
    return {.format = config::FileFormat::exr,
            .write = write_exr_file,
            .inspect = inspect_exr,
            .read = read_exr_file,
            .compression = [](const config::AssetFiles& files) {
                return to_string(files.compression);
            }};
}

RowSource rows_of(ExrRows& file) {
    return {file.facts().width, file.facts().height, file.facts().channel_names.size(),
            file.rows_per_piece(), [&file](int first, int count, float* texels) {
                return file.read(first, count, texels);
            }};
}

struct ExrRows::File {
    File(std::string name_, FileInput input)
        : name(std::move(name_)), stream(name, std::move(input)) {}

    config::Diagnostic diagnostic(const std::string& reason) const {
        if (auto failure = stream.failure()) return *failure;
        return damaged_exr(name, reason);
    }

    std::string name;
    ExrStream stream;
    std::unique_ptr<Imf::MultiPartInputFile> parts;
    std::unique_ptr<Imf::InputPart> image;
    ExrFacts facts;
};

ExrRows::ExrRows(std::unique_ptr<File> file) : file_(std::move(file)) {}
ExrRows::ExrRows(ExrRows&&) noexcept = default;
ExrRows& ExrRows::operator=(ExrRows&&) noexcept = default;
ExrRows::~ExrRows() = default;

const ExrFacts& ExrRows::facts() const { return file_->facts; }

config::Outcome<ExrRows> ExrRows::open(const std::filesystem::path& path, int part) {
    config::Outcome<FileInput> input = FileInput::open(path);
    if (!input.value) return {{}, std::move(input.diagnostics)};
    if (input.value->size() == 0) return damaged_exr(path.string(), "it is empty");
    auto file = std::make_unique<File>(path.string(), std::move(*input.value));
    try {
        if (const auto reason = unreadable_header(file->stream, file->stream.size(), part)) {
            return damaged_exr(file->name, *reason);
        }
        file->parts = std::make_unique<Imf::MultiPartInputFile>(file->stream, 0);  // 0: one thread
        file->image = std::make_unique<Imf::InputPart>(*file->parts, part);
        file->facts = facts_of(file->image->header());
    } catch (const std::exception& error) {
        return file->diagnostic(error.what());
    }
    return {ExrRows(std::move(file)), {}};
}

std::optional<config::Diagnostic> ExrRows::read(int first, int count, float* texels) {
    try {
        const Imath::Box2i window = file_->image->header().dataWindow();
        const std::size_t texel = sizeof(float) * facts().channel_names.size();
        const std::size_t row = texel * static_cast<std::size_t>(facts().width);
        const Imath::V2i origin(window.min.x, window.min.y + first);
        Imf::FrameBuffer buffer;
        for (std::size_t channel = 0; channel < facts().channel_names.size(); ++channel) {
            buffer.insert(facts().channel_names[channel],
                          Imf::Slice::Make(Imf::FLOAT, texels + channel, origin, facts().width,
                                           count, texel, row));
        }
        file_->image->setFrameBuffer(buffer);
        file_->image->readPixels(origin.y, origin.y + count - 1);
    } catch (const std::exception& error) {
        return file_->diagnostic(error.what());
    }
    return std::nullopt;
}

int ExrRows::rows_per_piece() const {
    constexpr std::size_t floats = std::size_t{1} << 20;
    constexpr std::size_t block = 32;  // the most rows that a codec unpacks together
    const std::size_t row = static_cast<std::size_t>(facts().width) * facts().channel_names.size();
    const std::size_t rows = std::max<std::size_t>(1, floats / row / block) * block;
    return static_cast<int>(std::min<std::size_t>(rows, static_cast<std::size_t>(facts().height)));
}

}  // namespace skybake
