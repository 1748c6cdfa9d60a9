// The chunks of an EXR file: its rows in groups, each packed on its own. Any number of threads
// packs them, one at a time writes them in the order of the file, and the bytes are the same for
// any number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/sheet.h"

namespace skybake {

struct ExrFacts;

// Chunks that follow each other, as the file has them.
struct ExrRun {
    std::string bytes;
    std::vector<std::size_t> starts;  // where each chunk begins in `bytes`
    std::exception_ptr failure;
};

// Some rows of the image as the file will have them. A chunk of which other pieces have rows too
// cannot be packed yet: its rows are `head` or `tail`, in which the channels of a row follow each
// other.
struct ExrPiece {
    int first = 0;  // row
    std::string head;
    std::vector<ExrRun> runs;  // the chunks between head and tail
    int tail_first = 0;        // row
    std::string tail;
};

class ExrChunks {
  public:
    // `facts` must outlive it.
    explicit ExrChunks(const ExrFacts& facts);

    int count() const;
    // Returns the first row of the chunk that has this row, and how many rows the chunk has.
    int first_row(int row) const { return row / chunk_rows_ * chunk_rows_; }
    int rows_of_chunk(int row) const;
    std::size_t row_bytes() const { return row_bytes_; }

    // Packs the rows on up to `threads` threads. Any thread may call it.
    void pack(const SheetRows& rows, int threads, ExrPiece& piece) const;

    // Appends the chunk that begins with a row. `texels` are its rows as in ExrPiece::head.
    void append(int row, const std::string& texels, ExrRun& run) const;

  private:
    class Deflate;
    void gather(const SheetRows& rows, std::int64_t first, std::int64_t end,
                std::string& texels) const;
    void append(int row, const std::string& texels, Deflate& deflate, ExrRun& run) const;
    void pack_run(const SheetRows& rows, std::int64_t first, std::int64_t end, ExrRun& run) const;

    const ExrFacts& facts_;
    const int chunk_rows_;
    const std::size_t channel_bytes_;  // of a row
    const std::size_t row_bytes_;
    std::vector<std::size_t> file_order_;  // of the channels: by name
};

// Writes an EXR file: its header, the positions of its chunks, and the chunks.
class ExrChunkWriter {
  public:
    ExrChunkWriter(const ExrChunks& chunks, const std::string& header, FileOutput& output);

    // Writes pieces, which must come in the order of rows. Throws what packing them threw, and if
    // the file cannot be written.
    void put(const ExrPiece& piece);
    // Writes the positions once all chunks are written.
    void finish();

  private:
    void join(int first, const std::string& texels);
    void write(const ExrRun& run);

    const ExrChunks& chunks_;
    FileOutput& output_;
    std::uint64_t table_at_ = 0;
    std::vector<std::uint64_t> positions_;
    std::string joined_;  // the rows so far of a chunk that several pieces have
    ExrRun joined_run_;
};

}  // namespace skybake
