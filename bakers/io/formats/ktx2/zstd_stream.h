// Zstandard streams of one frame, written and read piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bakers/io/files/file_io.h"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace skybake {

// The level and the release of the library, 1.5.4 on Debian 12, define the bytes of a compressed
// file: another release may find a shorter encoding of the same texels. The manifest's hash of the
// content does not depend on either. The preset nubis_shape, 128^3 RGBA, takes 69 % of its 16 MiB as
// half, 76 % of 32 MiB as float and 88 % of 8 MiB as unorm8. Level 3 leaves 73, 82 and 88 %, level 19
// in several times the time 69, 75 and 87 %.
inline constexpr int zstd_level = 9;

// Compresses one frame. The frame states its size, so that readers can reserve memory.
class ZstdWriter {
  public:
    // `size` is the number of bytes that will be written.
    ZstdWriter(FileOutput& output, std::uint64_t size);
    ~ZstdWriter();
    ZstdWriter(const ZstdWriter&) = delete;
    ZstdWriter& operator=(const ZstdWriter&) = delete;

    // The pieces must be the same in each run, because the library's bytes may depend on them.
    void write(std::string_view bytes) { compress(bytes, false); }
    void finish() { compress({}, true); }

  private:
    void compress(std::string_view bytes, bool is_end);

    FileOutput& output_;
    ZSTD_CCtx_s* context_;
    std::string buffer_;
};

// Decompresses `bytes` bytes of a file from `offset` on.
class ZstdReader {
  public:
    ZstdReader(FileInput& file, std::uint64_t offset, std::uint64_t bytes);
    ~ZstdReader();
    ZstdReader(const ZstdReader&) = delete;
    ZstdReader& operator=(const ZstdReader&) = delete;

    // Fills `out`. Returns false if the stream is damaged, ends early or cannot be read.
    bool read(char* out, std::size_t count);
    // Whether the frame and the file's bytes end here.
    bool is_at_end();

  private:
    std::optional<std::size_t> step(char* out, std::size_t count);

    FileInput& file_;
    std::uint64_t next_;
    std::uint64_t end_;
    ZSTD_DCtx_s* context_;
    std::string buffer_;
    std::size_t used_ = 0;  // of the buffer
    bool is_complete_ = false;
};

}  // namespace skybake
