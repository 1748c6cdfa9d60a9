#include "bakers/io/formats/ktx2/zstd_stream.h"

#include <zstd.h>

#include <algorithm>

namespace skybake {

ZstdWriter::ZstdWriter(FileOutput& output, std::uint64_t size)
    : output_(output), context_(ZSTD_createCCtx()), buffer_(ZSTD_CStreamOutSize(), '\0') {
    ZSTD_CCtx_setParameter(context_, ZSTD_c_compressionLevel, zstd_level);
    ZSTD_CCtx_setPledgedSrcSize(context_, size);
}

ZstdWriter::~ZstdWriter() { ZSTD_freeCCtx(context_); }

void ZstdWriter::compress(std::string_view bytes, bool is_end) {
    ZSTD_inBuffer input = {bytes.data(), bytes.size(), 0};
    std::size_t left = 1;
    while (is_end ? left != 0 : input.pos < input.size) {
        ZSTD_outBuffer out = {buffer_.data(), buffer_.size(), 0};
        left = ZSTD_compressStream2(context_, &out, &input, is_end ? ZSTD_e_end : ZSTD_e_continue);
        // The library fails only if its memory cannot be had, or if another number of bytes was
        // promised; the reader then finds the frame incomplete.
        if (ZSTD_isError(left) != 0) return;
        output_.write({buffer_.data(), out.pos});
    }
}

ZstdReader::ZstdReader(FileInput& file, std::uint64_t offset, std::uint64_t bytes)
    : file_(file), next_(offset), end_(offset + bytes), context_(ZSTD_createDCtx()) {}

ZstdReader::~ZstdReader() { ZSTD_freeDCtx(context_); }

// Decompresses what fits into `out` and returns how many bytes that is, or nothing if there are no
// more or the stream is damaged.
std::optional<std::size_t> ZstdReader::step(char* out, std::size_t count) {
    if (is_complete_) return std::nullopt;
    if (used_ == buffer_.size()) {
        if (next_ == end_) return std::nullopt;
        buffer_.resize(std::min<std::uint64_t>(ZSTD_DStreamInSize(), end_ - next_));
        const auto done = file_.read(next_, buffer_.data(), buffer_.size());
        if (!done || *done < buffer_.size()) return std::nullopt;
        next_ += buffer_.size();
        used_ = 0;
    }
    ZSTD_outBuffer made = {out, count, 0};
    ZSTD_inBuffer input = {buffer_.data(), buffer_.size(), used_};
    const std::size_t left = ZSTD_decompressStream(context_, &made, &input);
    if (ZSTD_isError(left) != 0) return std::nullopt;
    used_ = input.pos;
    is_complete_ = left == 0;
    return made.pos;
}

bool ZstdReader::read(char* out, std::size_t count) {
    for (std::size_t done = 0; done < count;) {
        const auto made = step(out + done, count - done);
        if (!made) return false;
        done += *made;
    }
    return true;
}

bool ZstdReader::is_at_end() {
    // The library may have given all bytes before it has read the end of the frame.
    char none = 0;
    while (!is_complete_) {
        if (!step(&none, 0)) return false;
    }
    return used_ == buffer_.size() && next_ == end_;
}

}  // namespace skybake
