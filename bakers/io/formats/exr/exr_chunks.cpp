#include "bakers/io/formats/exr/exr_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/exr/exr_library.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

static_assert(std::endian::native == std::endian::little,
              "texels are stored as they lie in memory");

// One of libdeflate's levels 1 to 12. Measured in cycles a byte, and in bytes of the file against
// those of zlib's level 4, with which OpenEXR 3.1 packs:
//
//                                  zlib 4     level 1        level 2        level 4
//   noise, half RGBA, 128^3          68      17.5, 1.025    27.7, 0.966    47.9, 0.956
//   cloud, half, 256^3 atlas         26      11.5, 0.966    13.0, 0.975    13.9, 0.972
//   sky view, float RGB, 192 x 324   79      24.1, 1.008    32.2, 1.000    32.2, 1.000
//   aerial perspective, half RGBA    62      21.4, 1.046    26.5, 1.005    29.7, 0.998
//
// Level 1 takes a quarter to a half of the time, and files are a hundredth larger in all. The level
// is fixed and the library is the system's: another release of it may write other bytes, with the
// same texels.
constexpr int libdeflate_level = 1;

constexpr std::size_t chunk_head_bytes = 8;  // the chunk's first row and the length of its data

template <class T>
void append_raw(T value, std::string& bytes) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// Arranges bytes as EXR files have them before they are deflated: the first, third, fifth ... and
// then the second, fourth ..., each as its difference from the one before, plus 128.
void split_and_subtract(std::string_view bytes, std::string& out) {
    out.resize(bytes.size());
    const std::size_t half = (bytes.size() + 1) / 2;
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    auto* even = reinterpret_cast<unsigned char*>(out.data());
    auto* odd = even + half;
    even[0] = from[0];
    for (std::size_t i = 1; i < half; ++i) {
        even[i] = static_cast<unsigned char>(from[2 * i] - from[2 * i - 2] + 128);
    }
    if (bytes.size() < 2) return;
    odd[0] = static_cast<unsigned char>(from[1] - from[2 * half - 2] + 128);
    for (std::size_t i = 1; i < bytes.size() - half; ++i) {
        odd[i] = static_cast<unsigned char>(from[2 * i + 1] - from[2 * i - 1] + 128);
    }
}

std::vector<std::size_t> order_in_file(const std::vector<std::string>& channel_names) {
    std::vector<std::size_t> order(channel_names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return channel_names[a] < channel_names[b]; });
    return order;
}

}  // namespace

// --- Packing ------------------------------------------------------------------------------------

// Deflates chunks, one at a time.
class ExrChunks::Deflate {
  public:
    // Appends packed texels. Returns false if they do not shrink; `bytes` is as it was.
    bool append(std::string_view texels, std::string& bytes) {
        if (!compressor_) compressor_.reset(libdeflate_alloc_compressor(libdeflate_level));
        if (!compressor_) throw std::bad_alloc();
        split_and_subtract(texels, split_);
        const std::size_t before = bytes.size();
        bytes.resize(before + libdeflate_zlib_compress_bound(compressor_.get(), split_.size()));
        const std::size_t packed = libdeflate_zlib_compress(
            compressor_.get(), split_.data(), split_.size(), &bytes[before], bytes.size() - before);
        const bool shrinks = packed > 0 && packed < texels.size();
        bytes.resize(before + (shrinks ? packed : 0));
        return shrinks;
    }

  private:
    struct Free {
        void operator()(libdeflate_compressor* compressor) const {
            libdeflate_free_compressor(compressor);
        }
    };
    std::unique_ptr<libdeflate_compressor, Free> compressor_;
    std::string split_;
};

ExrChunks::ExrChunks(const ExrFacts& facts)
    : facts_(facts),
      chunk_rows_(rows_of_exr_chunk(facts.compression)),
      channel_bytes_(static_cast<std::size_t>(facts.width) * bytes_per_value(facts.pixel_type)),
      row_bytes_(channel_bytes_ * facts.channel_names.size()),
      file_order_(order_in_file(facts.channel_names)) {}

int ExrChunks::count() const {
    return facts_.height / chunk_rows_ + (facts_.height % chunk_rows_ == 0 ? 0 : 1);
}

int ExrChunks::rows_of_chunk(int row) const {
    return std::min(chunk_rows_, facts_.height - first_row(row));
}

void ExrChunks::pack(const SheetRows& rows, int threads, ExrPiece& piece) const {
    const std::int64_t first = rows.first;
    const std::int64_t end = first + rows.count;
    const std::int64_t chunk = chunk_rows_;
    const std::int64_t whole_first = std::min(end, (first + chunk - 1) / chunk * chunk);
    const std::int64_t whole_end =
        end == facts_.height ? end : std::max(whole_first, end / chunk * chunk);
    piece.first = rows.first;
    piece.tail_first = static_cast<int>(whole_end);
    gather(rows, first, whole_first, piece.head);
    gather(rows, whole_end, end, piece.tail);
    const std::int64_t chunks = (whole_end - whole_first + chunk - 1) / chunk;
    const std::int64_t runs = std::min<std::int64_t>(threads, chunks);
    piece.runs.resize(static_cast<std::size_t>(runs));
    parallel_for(static_cast<int>(runs), threads, [&](int i) {
        const std::int64_t run_first = whole_first + chunks * i / runs * chunk;
        const std::int64_t run_end =
            std::min(whole_end, whole_first + chunks * (i + 1) / runs * chunk);
        pack_run(rows, run_first, run_end, piece.runs[static_cast<std::size_t>(i)]);
    });
}

void ExrChunks::pack_run(const SheetRows& rows, std::int64_t first, std::int64_t end,
                         ExrRun& run) const {
    run.bytes.clear();
    run.starts.clear();
    try {
        Deflate deflate;
        std::string texels;
        for (std::int64_t row = first; row < end; row += chunk_rows_) {
            gather(rows, row, std::min(end, row + chunk_rows_), texels);
            append(static_cast<int>(row), texels, deflate, run);
        }
    } catch (...) {
        run.failure = std::current_exception();
    }
}

// Returns rows first ... end - 1 with the channels of each row one after the other.
void ExrChunks::gather(const SheetRows& rows, std::int64_t first, std::int64_t end,
                       std::string& texels) const {
    texels.resize(static_cast<std::size_t>(end - first) * row_bytes_);
    char* to = texels.data();
    for (std::int64_t row = first; row < end; ++row) {
        const auto place = static_cast<std::size_t>(row - rows.first) * channel_bytes_;
        for (const std::size_t channel : file_order_) {
            to = std::copy_n(rows.texels + channel * rows.plane + place, channel_bytes_, to);
        }
    }
}

void ExrChunks::append(int row, const std::string& texels, ExrRun& run) const {
    Deflate deflate;
    append(row, texels, deflate, run);
}

void ExrChunks::append(int row, const std::string& texels, Deflate& deflate, ExrRun& run) const {
    const std::size_t start = run.bytes.size();
    run.starts.push_back(start);
    append_raw<std::int32_t>(row, run.bytes);
    append_raw<std::int32_t>(0, run.bytes);  // the length, set below
    switch (facts_.compression) {
        case config::Compression::zip:
        case config::Compression::zips:
            if (!deflate.append(texels, run.bytes)) run.bytes += texels;
            break;
        case config::Compression::piz:
            run.bytes += chunk_of_library(facts_, rows_of_chunk(row), texels);
            break;
        case config::Compression::none:
            run.bytes += texels;
            break;
    }
    const auto length = static_cast<std::int32_t>(run.bytes.size() - start - chunk_head_bytes);
    std::memcpy(&run.bytes[start + sizeof(std::int32_t)], &length, sizeof(length));
}

// --- Writing ------------------------------------------------------------------------------------

ExrChunkWriter::ExrChunkWriter(const ExrChunks& chunks, const std::string& header,
                               FileOutput& output)
    : chunks_(chunks), output_(output) {
    output_.write(header);
    table_at_ = output_.position();
    const auto count = static_cast<std::size_t>(chunks_.count());
    positions_.reserve(count);
    output_.seek(table_at_ + count * sizeof(std::uint64_t));
}

void ExrChunkWriter::put(const ExrPiece& piece) {
    if (!piece.head.empty()) join(piece.first, piece.head);
    for (const ExrRun& run : piece.runs) write(run);
    if (!piece.tail.empty()) join(piece.tail_first, piece.tail);
}

// Adds rows to the chunk that several pieces have, and writes it when all of them are there.
void ExrChunkWriter::join(int first, const std::string& texels) {
    joined_ += texels;
    const auto rows = static_cast<std::size_t>(chunks_.rows_of_chunk(first));
    if (joined_.size() < rows * chunks_.row_bytes()) return;
    joined_run_ = {};
    chunks_.append(chunks_.first_row(first), joined_, joined_run_);
    write(joined_run_);
    joined_.clear();
}

void ExrChunkWriter::write(const ExrRun& run) {
    if (run.failure) std::rethrow_exception(run.failure);
    const std::uint64_t position = output_.position();
    for (const std::size_t start : run.starts) positions_.push_back(position + start);
    output_.write(run.bytes);
    if (output_.error() != 0) throw std::runtime_error("the file cannot be written");
}

void ExrChunkWriter::finish() {
    output_.seek(table_at_);
    output_.write({reinterpret_cast<const char*>(positions_.data()),
                   positions_.size() * sizeof(std::uint64_t)});
}

}  // namespace skybake
