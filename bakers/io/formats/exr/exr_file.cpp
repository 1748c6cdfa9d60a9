#include "bakers/io/formats/exr/exr_file.h"

#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bakers/field/pixel_type.h"
#include "bakers/io/files/file_output.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/formats/exr/exr_library.h"
#include "bakers/io/formats/metadata_name.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

using config::Outcome;
using config::PixelType;
namespace fs = std::filesystem;

class OutputStream : public Imf::OStream {
  public:
    explicit OutputStream(FileOutput& file) : Imf::OStream("file"), file_(file) {}
    void write(const char bytes[], int count) override {
        file_.write({bytes, static_cast<std::size_t>(count)});
        if (file_.error() != 0) throw std::runtime_error("the file cannot be written");
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

  private:
    FileOutput& file_;
};

// The library compresses on threads of its own, which all files share; with one thread it does so
// on the caller's.
class CompressionThreads {
  public:
    explicit CompressionThreads(int threads) : count_(threads > 1 ? threads : 0) {
        Imf::setGlobalThreadCount(count_);
    }
    ~CompressionThreads() { Imf::setGlobalThreadCount(0); }
    CompressionThreads(const CompressionThreads&) = delete;
    CompressionThreads& operator=(const CompressionThreads&) = delete;
    int count() const { return count_; }

  private:
    int count_;
};

void put(const SheetRows& rows, int width, const Baked& baked, Imf::OutputFile& file) {
    const auto value = static_cast<std::size_t>(bytes_per_value(baked.pixel_type));
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < baked.channel_names.size(); ++c) {
        buffer.insert(
            baked.channel_names[c],
            Imf::Slice::Make(baked.pixel_type == PixelType::half ? Imf::HALF : Imf::FLOAT,
                             rows.texels + c * rows.plane, Imath::V2i(0, rows.first), width,
                             rows.count, value, static_cast<std::size_t>(width) * value));
    }
    file.setFrameBuffer(buffer);
    file.writePixels(rows.count);
}

// What is asked for that EXR files cannot hold.
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
    if (const auto reason = exr_obstacle(baked, content.level)) {
        return {{}, {contradiction(path, *reason)}};
    }
    FileOutput output(path);
    bool complete = false;
    std::string reason;
    try {
        OutputStream stream(output);
        const CompressionThreads compression(thread_count(content.threads));
        SheetWriter sheet(baked, content.level, content.threads, content.progress);
        const ExrFacts facts = {sheet.width(),       sheet.height(),
                                baked.channel_names, baked.pixel_type,
                                baked.compression,   {{metadata_name, content.metadata}}};
        Imf::OutputFile file(stream, make_exr_header(facts), compression.count());
        complete =
            sheet.write([&](const SheetRows& rows) { put(rows, sheet.width(), baked, file); });
    } catch (const std::exception& error) {
        reason = error.what();
    }
    // The library's destructor, which writes the table of line offsets, keeps failures to itself.
    if (!output.finish()) return {{}, {output.diagnostic()}};
    if (!reason.empty()) {
        return {{},
                {contradiction(path, fmt::format("OpenEXR cannot encode the image: {}", reason))}};
    }
    return {complete, {}};
}

Outcome<FileFacts> inspect_exr(const fs::path& path) {
    const Outcome<ExrRows> image = ExrRows::open(path);
    if (!image.value) return {{}, image.diagnostics};
    FileFacts facts;
    facts.pixel_type = image.value->pixel_type();
    facts.names = image.value->channel_names();
    facts.channels = facts.names.size();
    facts.compression = spell(image.value->compression());
    facts.image_size = {image.value->width(), image.value->height()};
    for (const auto& [name, text] : image.value->attributes()) {
        if (name == metadata_name) facts.metadata = text;
    }
    return {std::move(facts), {}};
}

Outcome<bool> read_exr_file(const fs::path& path, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    Outcome<ExrRows> image = ExrRows::open(path);
    if (!image.value) return {{}, std::move(image.diagnostics)};
    const RowSource rows = rows_of(*image.value);
    const std::array<std::int64_t, 2> size = {rows.width, rows.height};
    if (size != image_size(shape.size, shape.grid) || rows.channels != shape.channels) {
        return {{}, {other_size(path)}};
    }
    return read_sheet(rows, shape.size, shape.grid, visit);
}

}  // namespace

Format exr_format() {
    return {
        .format = config::FileFormat::exr,
        .write = write_exr_file,
        .inspect = inspect_exr,
        .read = read_exr_file,
        .compression = [](const config::AssetFiles& files) { return spell(files.compression); }};
}

RowSource rows_of(ExrRows& file) {
    return {
        file.width(), file.height(), file.channel_names().size(), file.rows_per_piece(),
        [&file](int first, int count, float* texels) { return file.read(first, count, texels); }};
}

}  // namespace skybake
