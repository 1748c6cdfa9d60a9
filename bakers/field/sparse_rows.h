// Rows of voxels in memory, of which only pieces that are not all zeros take any: most of a cloud's
// box is empty.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "config/sections/pixel_types.h"

namespace skybake {

// Memory for voxels. What all objects of this process have taken counts towards the most that each
// of them may take (BakeOptions::held_voxel_bytes); an object returns its share when it goes.
class VoxelMemory {
  public:
    explicit VoxelMemory(std::int64_t most_bytes);
    ~VoxelMemory();
    VoxelMemory(const VoxelMemory&) = delete;
    VoxelMemory& operator=(const VoxelMemory&) = delete;

    // Takes so many bytes, or none and returns false if they are too many.
    [[nodiscard]] bool take(std::int64_t bytes);

    // The bytes that all objects have taken.
    static std::int64_t total();

  private:
    const std::int64_t most_bytes_;
    std::atomic<std::int64_t> taken_ = 0;
};

// Any thread may call any member at any time.
class SparseRows {
  public:
    // So many voxels make one piece. Twice as many would take a sixth more memory for a cumulus.
    static constexpr std::size_t kPiece = 8;

    // Returns the bytes of `count` rows of `length` voxels, besides their pieces.
    static std::int64_t fixed_bytes(std::size_t count, std::size_t length);

    // The caller has taken fixed_bytes from `memory`, which must outlive the rows. No row is held. Voxels
    // are held as `type` has them, which is float32 or half.
    SparseRows(std::size_t count, std::size_t length, config::PixelType type, VoxelMemory& memory);

    bool holds(std::size_t row) const {
        return states_[row].load(std::memory_order_acquire) == State::held;
    }

    // Holds a row of `length` voxels, if there is memory for its pieces. A row that is held already
    // stays as it is.
    void put(std::size_t row, const float* voxels);

    // Writes `count` voxels of a row that is held, from voxel `first` on.
    void get(std::size_t row, std::size_t first, std::size_t count, float* out) const;

    // Whether the pieces that these voxels of a held row are in are all +0.
    bool is_zero(std::size_t row, std::size_t first, std::size_t count) const;

  private:
    enum class State : std::uint8_t { absent, in_the_making, held };

    // Bit i mod 64 of word i / 64 of a row tells whether its piece i is stored.
    const std::uint64_t* words_of_row(std::size_t row) const {
        return stored_.data() + row * words_;
    }
    char* allocate(std::size_t pieces);
    bool store(std::size_t row, const float* voxels);

    const std::size_t length_;
    const std::size_t words_;  // per row
    const config::PixelType type_;
    const std::size_t width_;  // bytes per voxel
    const std::size_t block_;  // bytes that are allocated at once
    VoxelMemory& memory_;
    std::vector<std::atomic<State>> states_;
    std::vector<std::uint64_t> stored_;
    std::vector<const char*> pieces_;  // of each row those that are stored, one after the other
    std::atomic<bool> full_ = false;   // no memory was left for some row
    std::mutex mutex_;                 // guards all below
    std::vector<std::unique_ptr<char[]>> blocks_;
    char* free_ = nullptr;  // in the last block
    std::size_t free_bytes_ = 0;
};

}  // namespace skybake
