#include "bakers/field/sparse_rows.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "bakers/field/pixel_type.h"
#include "bakers/field/value_kernel.h"

namespace skybake {
namespace {

std::atomic<std::int64_t>& bytes_taken() {
    static std::atomic<std::int64_t> bytes = 0;
    return bytes;
}

constexpr std::size_t kWordBits = 64;
constexpr std::size_t kMostAtOnce = std::size_t{1} << 20;  // bytes

std::size_t words_of(std::size_t length) {
    const std::size_t pieces = (length + SparseRows::kPiece - 1) / SparseRows::kPiece;
    return (pieces + kWordBits - 1) / kWordBits;
}

// How many of the pieces before this one are stored.
std::size_t stored_before(const std::uint64_t* words, std::size_t piece) {
    std::size_t count = 0;
    for (std::size_t word = 0; word < piece / kWordBits; ++word) {
        count += static_cast<std::size_t>(std::popcount(words[word]));
    }
    if (piece % kWordBits == 0) return count;
    const std::uint64_t before = words[piece / kWordBits] << (kWordBits - piece % kWordBits);
    return count + static_cast<std::size_t>(std::popcount(before));
}

// Neighbouring pieces that are all stored, or all zeros, as far as one word tells.
struct Run {
    bool stored = false;
    std::size_t end = 0;
};

Run run_from(const std::uint64_t* words, std::size_t piece) {
    const std::size_t bit = piece % kWordBits;
    const std::uint64_t rest = words[piece / kWordBits] >> bit;
    const bool stored = (rest & 1) != 0;
    const auto length = static_cast<std::size_t>(std::countr_zero(stored ? ~rest : rest));
    return {stored, piece + std::min(length, kWordBits - bit)};
}

// Whether all values are +0. A -0 is not, so that rows come back bit for bit.
bool is_zero_piece(const float* values, std::size_t count) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) bits |= std::bit_cast<std::uint32_t>(values[i]);
    return bits == 0;
}

}  // namespace

VoxelMemory::VoxelMemory(std::int64_t most_bytes) : most_bytes_(most_bytes) {
    assert(most_bytes >= 0);
}

VoxelMemory::~VoxelMemory() { bytes_taken() -= taken_; }

bool VoxelMemory::take(std::int64_t bytes) {
    assert(bytes >= 0);
    // They are counted before they are compared, so that bakes on other threads see them.
    if ((bytes_taken() += bytes) > most_bytes_) {
        bytes_taken() -= bytes;
        return false;
    }
    taken_ += bytes;
    return true;
}

std::int64_t VoxelMemory::total() { return bytes_taken(); }

std::int64_t SparseRows::fixed_bytes(std::size_t count, std::size_t length) {
    const std::size_t row =
        sizeof(State) + sizeof(char*) + words_of(length) * sizeof(std::uint64_t);
    return static_cast<std::int64_t>(count * row);
}

SparseRows::SparseRows(std::size_t count, std::size_t length, config::PixelType type,
                       VoxelMemory& memory)
    : length_(length),
      words_(words_of(length)),
      type_(type),
      width_(bytes_per_value(type)),
      block_(std::min(kMostAtOnce, count * length * width_)),
      memory_(memory),
      states_(count),
      stored_(count * words_),
      pieces_(count) {}

void SparseRows::put(std::size_t row, const float* voxels) {
    if (full_) return;
    State absent = State::absent;
    if (!states_[row].compare_exchange_strong(absent, State::in_the_making)) return;
    const bool held = store(row, voxels);
    states_[row].store(held ? State::held : State::absent, std::memory_order_release);
}

// Returns false, with nothing stored, if there is no memory left.
bool SparseRows::store(std::size_t row, const float* voxels) {
    std::uint64_t* words = stored_.data() + row * words_;
    std::fill_n(words, words_, std::uint64_t{0});
    std::size_t count = 0;
    // Most of a row is empty, which is seen from many pieces at once.
    constexpr std::size_t kManyPieces = 16 * kPiece;
    for (std::size_t first = 0; first < length_; first += kManyPieces) {
        const std::size_t end = std::min(first + kManyPieces, length_);
        if (are_zeros(voxels + first, end - first)) continue;
        for (std::size_t at = first; at < end; at += kPiece) {
            if (is_zero_piece(voxels + at, std::min(kPiece, end - at))) continue;
            const std::size_t piece = at / kPiece;
            words[piece / kWordBits] |= std::uint64_t{1} << piece % kWordBits;
            ++count;
        }
    }
    if (count == 0) return true;
    char* to = allocate(count);
    if (to == nullptr) return false;
    pieces_[row] = to;
    for (std::size_t at = 0; at < length_;) {
        const Run run = run_from(words, at / kPiece);
        const std::size_t part = std::min(run.end * kPiece, length_) - at;
        if (run.stored) {
            store_values(voxels + at, part, type_, to);
            to += part * width_;
        }
        at += part;
    }
    return true;
}

// Returns memory for so many pieces of one row, or null.
char* SparseRows::allocate(std::size_t pieces) {
    const std::size_t bytes = pieces * kPiece * width_;
    const std::lock_guard lock(mutex_);
    if (free_bytes_ < bytes) {
        const std::size_t block = std::max(block_, bytes);
        if (!memory_.take(static_cast<std::int64_t>(block))) {
            full_ = true;
            return nullptr;
        }
        free_ = blocks_.emplace_back(new char[block]).get();
        free_bytes_ = block;
    }
    char* const from = free_;
    free_ += bytes;
    free_bytes_ -= bytes;
    return from;
}

void SparseRows::get(std::size_t row, std::size_t first, std::size_t count, float* out) const {
    assert(holds(row) && first + count <= length_);
    const std::uint64_t* words = words_of_row(row);
    const char* from = pieces_[row] + stored_before(words, first / kPiece) * kPiece * width_;
    const std::size_t end = first + count;
    for (std::size_t at = first; at < end;) {
        const Run run = run_from(words, at / kPiece);
        const std::size_t part = std::min(run.end * kPiece, end) - at;
        if (run.stored) {
            load_values(from + at % kPiece * width_, part, type_, out);
            from += (run.end - at / kPiece) * kPiece * width_;
        } else {
            std::memset(out, 0, part * sizeof(float));
        }
        out += part;
        at += part;
    }
}

bool SparseRows::is_zero(std::size_t row, std::size_t first, std::size_t count) const {
    assert(holds(row) && count > 0 && first + count <= length_);
    const std::uint64_t* words = words_of_row(row);
    const std::size_t last = (first + count - 1) / kPiece;
    return stored_before(words, first / kPiece) == stored_before(words, last + 1);
}

}  // namespace skybake
