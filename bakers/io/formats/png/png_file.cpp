// Assets as PNG images of 8 or 16 bits per channel: grey, grey with alpha, RGB or RGBA.
//
// Samples are the stored numbers, unorm8 or unorm16, not colours. The file names no gamma and no
// colour space, so readers do not convert the samples. Alpha is unassociated, a number like the
// others. The slices of volumes are arranged in the image as sheet.h says.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// This is zlib's own default. It is fixed so that the bytes of files do not change.
constexpr int deflate_level = 6;

constexpr std::array<int, 4> colour_types = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                             PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};

// The library expects that an error handler does not return. Throwing an exception is allowed,
// because the library is built to let exceptions pass.
[[noreturn]] void fail(png_structp, png_const_charp reason) { throw std::runtime_error(reason); }
void ignore(png_structp, png_const_charp) {}

// --- Writing ------------------------------------------------------------------------------------

void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& output = *static_cast<FileOutput*>(png_get_io_ptr(png));
    output.write({reinterpret_cast<const char*>(bytes), count});
    if (output.error() != 0) throw std::runtime_error("the file cannot be written");
}

class Writer {
  public:
    explicit Writer(FileOutput& output)
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)),
          info_(png_create_info_struct(png_)) {
        png_set_write_fn(png_, &output, write_bytes, [](png_structp) {});
    }
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    void begin(int width, int height, int bits, std::size_t channels, std::string metadata) {
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_compression_level(png_, deflate_level);
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                     bits, colour_types[channels - 1], PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        std::string name = metadata_name;
        png_text text{};
        text.compression = PNG_ITXT_COMPRESSION_NONE;
        text.key = name.data();
        text.text = metadata.data();
        text.itxt_length = metadata.size();
        png_set_text(png_, info_, &text, 1);
        png_write_info(png_, info_);
        if (bits == 16) png_set_swap(png_);  // samples are little-endian
    }
    void row(const char* samples) {
        png_write_row(png_, reinterpret_cast<png_const_bytep>(samples));
    }
    void end() { png_write_end(png_, nullptr); }

  private:
    png_structp png_;
    png_infop info_;
};

// Interleaves the channels of one row, given separate rows of each channel.
void interleave(const SheetRows& rows, int y, std::size_t width, std::size_t channels,
                std::size_t sample, std::string& row) {
    row.resize(width * channels * sample);
    for (std::size_t c = 0; c < channels; ++c) {
        const char* from =
            rows.texels + c * rows.plane + static_cast<std::size_t>(y) * width * sample;
        for (std::size_t x = 0; x < width; ++x) {
            std::memcpy(&row[(x * channels + c) * sample], from + x * sample, sample);
        }
    }
}

// Returns what PNG files cannot hold of the asset, in words, or nothing.
std::optional<std::string> png_obstacle(const Baked& baked, int level) {
    if (!config::facts_of(config::FileFormat::png).holds(baked.pixel_type)) {
        return "PNG files hold unorm8 and unorm16";
    }
    if (baked.channel_names.size() > colour_types.size()) {
        return "PNG files hold at most four channels";
    }
    const std::array<int, 3>& size = baked.levels[static_cast<std::size_t>(level)].size;
    const auto [width, height] = image_size(size, sheet_grid(size, baked));
    if (width <= PNG_UINT_31_MAX && height <= PNG_UINT_31_MAX) return std::nullopt;
    return fmt::format("an image of {} x {} texels is too large", width, height);
}

Outcome<bool> write_png_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    if (const auto reason = png_obstacle(baked, content.level)) return contradiction(path, *reason);
    const std::size_t channels = baked.channel_names.size();
    const auto sample = bytes_per_value(baked.pixel_type);
    FileOutput output(path);
    try {
        SheetWriter sheet(baked, content.level, content.threads, content.progress);
        Writer writer(output);
        writer.begin(sheet.width(), sheet.height(), static_cast<int>(8 * sample), channels,
                     content.metadata);
        std::string row;
        const bool complete = sheet.write([&](const SheetRows& rows, int) {
            for (int y = 0; y < rows.count; ++y) {
                interleave(rows, y, static_cast<std::size_t>(sheet.width()), channels, sample, row);
                writer.row(row.data());
            }
        });
        if (complete) writer.end();
        return output.finished(complete);
    } catch (const std::exception& error) {
        if (!output.finish()) return output.diagnostic();
        return contradiction(path, fmt::format("libpng cannot encode it: {}", error.what()));
    }
}

// --- Reading ------------------------------------------------------------------------------------

// Throws if a chunk is longer than what is left of its file: the library allocates what the chunk's
// head says before it reads on. What is no PNG file at all is left to the library to tell.
void check_chunk_lengths(FileInput& file) {
    std::array<unsigned char, 8> head{};
    const auto read_head = [&](std::uint64_t position) {
        const auto done = file.read(position, reinterpret_cast<char*>(head.data()), head.size());
        return done && *done == head.size();
    };
    if (!read_head(0) || png_sig_cmp(head.data(), 0, head.size()) != 0) return;
    std::uint64_t position = head.size();
    while (read_head(position) && std::memcmp(head.data() + 4, "IEND", 4) != 0) {
        position += 12 + std::uint64_t{png_get_uint_32(head.data())};  // and its name and checksum
        if (position > file.size()) throw std::runtime_error("a chunk is longer than the file");
    }
}

struct ReadPosition {
    FileInput& file;
    std::uint64_t position = 0;
};

void read_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& from = *static_cast<ReadPosition*>(png_get_io_ptr(png));
    const auto done = from.file.read(from.position, reinterpret_cast<char*>(bytes), count);
    if (!done || *done < count) throw std::runtime_error("it ends early");
    from.position += count;
}

class Reader {
  public:
    explicit Reader(FileInput& file)
        : position_{file},
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)),
          info_(png_create_info_struct(png_)) {
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_read_fn(png_, &position_, read_bytes);
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    // Throws if the header or a chunk before the samples is damaged.
    FileFacts open() {
        check_chunk_lengths(position_.file);
        png_read_info(png_, info_);
        FileFacts facts;
        facts.image_size = {png_get_image_width(png_, info_), png_get_image_height(png_, info_)};
        facts.channels = png_get_channels(png_, info_);
        const int bits = png_get_bit_depth(png_, info_);
        if (bits == 8) facts.pixel_type = PixelType::unorm8;
        if (bits == 16) facts.pixel_type = PixelType::unorm16;
        const int colours = png_get_color_type(png_, info_);
        if (!facts.pixel_type || colours == PNG_COLOR_TYPE_PALETTE) {
            throw std::runtime_error("its samples are not of 8 or 16 bits");
        }
        png_textp texts = nullptr;
        int count = 0;
        png_get_text(png_, info_, &texts, &count);
        for (int i = 0; i < count; ++i) {
            if (std::strcmp(texts[i].key, metadata_name) == 0) facts.metadata = texts[i].text;
        }
        if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE) {
            throw std::runtime_error("it is interlaced");
        }
        if (bits == 16) png_set_swap(png_);
        return facts;
    }
    void row(std::string& samples) {
        samples.resize(png_get_rowbytes(png_, info_));
        png_read_row(png_, reinterpret_cast<png_bytep>(samples.data()), nullptr);
    }
    void end() { png_read_end(png_, nullptr); }

  private:
    ReadPosition position_;
    png_structp png_;
    png_infop info_;
};

Outcome<FileFacts> inspect_png(FileInput& file) {
    try {
        return {Reader(file).open(), {}};
    } catch (const std::exception& error) {
        return damaged_file(file.path(), "PNG", error.what());
    }
}

// Holds the samples of all rows, as bytes, because the rows of an atlas are read repeatedly and a
// compressed stream cannot go back.
class HeldRows {
  public:
    explicit HeldRows(FileInput& file) {
        Reader reader(file);
        facts_ = reader.open();
        if (!can_hold(file.size())) throw std::runtime_error("it is shorter than its size asks");
        for (std::int64_t y = 0; y < facts_.image_size[1]; ++y) {
            rows_.emplace_back();
            reader.row(rows_.back());
        }
        reader.end();
    }
    const FileFacts& facts() const { return facts_; }

    RowSource source() const {
        const int width = static_cast<int>(facts_.image_size[0]);
        const std::size_t values = static_cast<std::size_t>(width) * facts_.channels;
        return {width, static_cast<int>(facts_.image_size[1]), facts_.channels, 16,
                [this, values](int first, int count,
                               float* texels) -> std::optional<config::Diagnostic> {
                    for (int y = first; y < first + count; ++y, texels += values) {
                        load_values(rows_[static_cast<std::size_t>(y)].data(), values,
                                    *facts_.pixel_type, texels);
                    }
                    return std::nullopt;
                }};
    }

  private:
    // Whether a file of `bytes` bytes can hold the samples. Deflate expands one byte to at most
    // 1032.
    bool can_hold(std::uint64_t bytes) const {
        const double samples =
            static_cast<double>(facts_.image_size[0]) * static_cast<double>(facts_.image_size[1]) *
            static_cast<double>(facts_.channels * bytes_per_value(*facts_.pixel_type));
        return samples <= 1032.0 * static_cast<double>(bytes);
    }

    FileFacts facts_;
    std::vector<std::string> rows_;
};

Outcome<bool> read_png_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    try {
        const HeldRows rows(file);
        if (rows.facts().image_size != image_size(shape.size, shape.grid) ||
            rows.facts().channels != shape.channels ||
            rows.facts().pixel_type != shape.pixel_type) {
            return other_size(file.path());
        }
        return read_sheet(rows.source(), shape.size, shape.grid, visit);
    } catch (const std::exception& error) {
        return damaged_file(file.path(), "PNG", error.what());
    }
}

}  // namespace

Format png_format() {
    return {.format = config::FileFormat::png,
            .write = write_png_file,
            .inspect = inspect_png,
            .read = read_png_file};
}

}  // namespace skybake
