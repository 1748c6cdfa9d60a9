// Assets as EXR images, written and read in bounded memory. Pixel types are float and half. An
// image has at most 2^31 - 1 rows and columns.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/io/formats/format.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

// The facts that a part of a file states, besides its pixels.
struct ExrFacts {
    int width = 0;
    int height = 0;
    std::vector<std::string> channel_names;  // in the order of texels: colours as R G B [A]
    config::PixelType pixel_type = config::PixelType::float32;   // half if all channels are
    config::Compression compression = config::Compression::zip;  // none for codecs of others
    Attributes attributes;                                       // texts by name
    std::string codec = {};                                      // "zip", "dwaa"
    // "(-10, 5) to (20, 30) of (0, 0) to (99, 49)", the data window of the display window, or "" where
    // they are equal.
    std::string window = {};
};

// An EXR file that is read row by row, because images may be larger than memory.
class ExrRows {
  public:
    // Opens a part of a file: its data window, of tiles the largest level. E0300 if the file cannot be
    // read, E0304 if it is damaged, or deep, or has subsampled or integer channels. No memory is
    // allocated for texels that the header claims but the file is too short to hold.
    static config::Outcome<ExrRows> open(const std::filesystem::path& path, int part = 0);
    ExrRows(ExrRows&&) noexcept;
    ExrRows& operator=(ExrRows&&) noexcept;
    ~ExrRows();

    const ExrFacts& facts() const;

    // Reads rows first ... first + count - 1, row 0 being the topmost, channels interleaved: count
    // * width * channels floats. Reading is fast in increasing order. E0300, E0304.
    [[nodiscard]] std::optional<config::Diagnostic> read(int first, int count, float* texels);

    // Returns the number of rows in a piece of about 4 MiB.
    int rows_per_piece() const;

  private:
    struct File;
    explicit ExrRows(std::unique_ptr<File> file);
    std::unique_ptr<File> file_;
};

// The result refers to `file`, which must not be moved.
RowSource rows_of(ExrRows& file);

}  // namespace skybake
