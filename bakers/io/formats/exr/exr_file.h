// Assets as EXR images, written and read in bounded memory. Pixel types are float and half. An
// image has at most 2^31 - 1 rows and columns.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/attribute_pieces.h"
#include "bakers/io/formats/format.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// An EXR file that is read row by row, because images may be larger than memory.
class ExrRows {
  public:
    // E0300 if the file cannot be read, E0304 if it is damaged or has a layout that skybake does
    // not write: tiles, parts, deep data, subsampling, integers, mixed types, lossy codecs. No
    // memory is allocated for texels that the header claims but the file is too short to hold.
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
    // * width() * channels floats. Reading is fast in increasing order. E0300, E0304.
    [[nodiscard]] std::optional<config::Diagnostic> read(int first, int count, float* texels);

    // Returns the number of rows in a piece of about 4 MiB.
    int rows_per_piece() const;

  private:
    struct File;
    explicit ExrRows(std::unique_ptr<File> file);
    std::unique_ptr<File> file_;
};

Format exr_format();

// The result refers to `file`, which must not be moved.
RowSource rows_of(ExrRows& file);

}  // namespace skybake
