// Assets as EXR images, written and read in bounded memory. Pixel types float and half; an image
// has at most 2^31 - 1 rows or columns.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/attribute_pieces.h"
#include "bakers/io/formats/format.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/files.h"

namespace skybake {

// An EXR file that is read row by row: images may be larger than memory.
class ExrRows {
  public:
    // E0300 where the file cannot be read, E0304 where it is damaged or of another layout than
    // skybake writes: tiles, parts, deep data, subsampling, integers, mixed types, lossy codecs.
    // Takes no memory for what the header claims and the bytes cannot hold.
    static config::Outcome<ExrRows> open(const std::filesystem::path& path);
    ExrRows(ExrRows&&) noexcept;
    ExrRows& operator=(ExrRows&&) noexcept;
    ~ExrRows();

    int width() const;
    int height() const;
    const std::vector<std::string>& channel_names() const;  // in the order of texels
    config::PixelType pixel_type() const;
    config::Compression compression() const;
    const Attributes& attributes() const;

    // Reads rows first ... first + count - 1, row 0 being the topmost, channels interleaved: count
    // * width() * channels floats. Quick in increasing order. E0300, E0304.
    [[nodiscard]] std::optional<config::Diagnostic> read(int first, int count, float* texels);

    // How many rows make a piece of about 4 MiB.
    int rows_per_piece() const;

  private:
    struct File;
    explicit ExrRows(std::unique_ptr<File> file);
    std::unique_ptr<File> file_;
};

Format exr_format();

// The file must stay where it is.
RowSource rows_of(ExrRows& file);

}  // namespace skybake
