// Translates between skybake's types and OpenEXR's. Only exr*.cpp include this file and know the
// library.
//
// A file as the library reads it.
#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

// Makes the header of a file as skybake writes it.
Imf::Header make_exr_header(const ExrFacts& facts);

// Returns the bytes of a file with this header up to the table of its chunks' positions. Throws
// what the library throws if files cannot have this header.
std::string exr_file_head(const Imf::Header& header);

// Returns how many rows are packed together.
int rows_of_exr_chunk(config::Compression compression);

// Packs a chunk by the library, which is the only one to know PIZ, and returns its data. `texels`
// has the chunk's rows, the channels of each row one after the other in the order of their names.
// Throws what the library throws. Any thread may call it.
std::string chunk_of_library(const ExrFacts& facts, int rows, const std::string& texels);

// Reads the headers of all parts of a file of `bytes` bytes, at least one, and its version with its
// flags. Throws what the library and the stream throw, and std::runtime_error with the reason if they
// claim more bytes than the file has.
std::vector<Imf::Header> exr_headers(Imf::IStream& stream, std::uint64_t bytes, int& version);

// Returns "zip", "dwaa" or "unknown".
std::string codec_name(const Imf::Header& header);

// Returns the head of a part of a file of this version.
ExrPartHead part_of(const Imf::Header& header, int version);

// Returns what a part of a file of `bytes` bytes contains that skybake does not read or that the file is
// too short to hold, in words, or nothing. Call this before the library opens the file, because the
// library trusts the header and allocates what it claims. The stream is at the file's beginning before
// and after the call. Throws what the library and the stream throw.
std::optional<std::string> unreadable_header(Imf::IStream& stream, std::uint64_t bytes,
                                             int part = 0);

// Returns the texts of a header by name, joined, without the name and the type of a part.
Attributes header_texts(const Imf::Header& header);

// Returns the facts of a header that skybake reads.
ExrFacts facts_of(const Imf::Header& header);

// Returns E0304 for a damaged file.
config::Diagnostic damaged_exr(const std::string& name, const std::string& reason);

class ExrStream : public Imf::IStream {
  public:
    ExrStream(const std::string& name, FileInput file)
        : Imf::IStream(name.c_str()), file_(std::move(file)) {}
    bool read(char out[], int count) override {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        const std::size_t done =
            wanted < kPiece ? read_of_piece(out, wanted) : read_of_file(out, wanted);
        if (done < wanted) throw std::runtime_error("it ends early");
        position_ += wanted;
        return position_ < file_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }
    std::uint64_t size() const { return file_.size(); }
    // Returns why the file could not be read, if the system gave a reason.
    std::optional<config::Diagnostic> failure() const {
        return failed_ ? std::optional(file_.diagnostic()) : std::nullopt;
    }

  private:
    // The library reads texts of a header byte by byte: a system call for each cost most of the time.
    static constexpr std::size_t kPiece = 1 << 14;

    std::size_t read_of_file(char* bytes, std::size_t count) {
        const auto done = file_.read(position_, bytes, count);
        failed_ = failed_ || !done;
        if (!done) throw std::runtime_error("it cannot be read");
        return *done;
    }
    std::size_t read_of_piece(char* bytes, std::size_t count) {
        const std::uint64_t skipped =
            position_ - begin_;  // great where the position is before the piece
        if (skipped > piece_.size() || count > piece_.size() - skipped) {
            std::string piece(kPiece, '\0');
            piece.resize(read_of_file(piece.data(), kPiece));
            piece_ = std::move(piece);
            begin_ = position_;
        }
        return piece_.copy(bytes, count, position_ - begin_);
    }

    FileInput file_;
    std::string piece_;
    std::uint64_t begin_ = 0;  // of the piece in the file
    std::uint64_t position_ = 0;
    bool failed_ = false;
};

}  // namespace skybake
