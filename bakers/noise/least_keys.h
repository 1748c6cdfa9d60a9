// The least of many numbers, found again after each small change of them.
//
// The numbers lie in frames of rows. Each row remembers where its least number was and a bound that
// none of its numbers is below. A number that grows leaves the bound right, so a row is searched
// again only if its least number has grown and its bound is the least of the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace skybake::noise {

// A number and its place in a frame.
struct LeastKey {
    std::uint64_t key = 0;
    std::size_t row = 0;
    std::size_t column = 0;
};

class LeastKeys {
  public:
    // All numbers are unknown at first.
    LeastKeys(std::size_t width, std::size_t height, std::size_t frames)
        : width_(width), height_(height), rows_(height * frames), frames_(frames) {}

    // Says that numbers of a row, from `first` to `last`, have not become smaller.
    void grown(std::size_t frame, std::size_t row, std::size_t first, std::size_t last) {
        Bound& bound = rows_[frame * height_ + row];
        if (bound.place < first || bound.place > last) return;
        bound.is_exact = false;
        if (frames_[frame].place == row) frames_[frame].is_exact = false;
    }

    // Says that any number of a row may have changed.
    void forget(std::size_t frame, std::size_t row) {
        rows_[frame * height_ + row] = {};
        frames_[frame].is_exact = false;
    }

    // Returns the least number of a frame; of equal ones that of the lowest row, then of the lowest
    // column. key(row, column) are the frame's numbers.
    template <class Key>
    LeastKey find(std::size_t frame, const Key& key) {
        if (frames_[frame].is_exact) return result(frame);
        while (true) {
            const std::size_t row = lowest_row(frame);
            Bound& bound = rows_[frame * height_ + row];
            if (bound.is_exact) {
                frames_[frame] = {bound.least, row, true};
                return result(frame);
            }
            bound = {key(row, std::size_t{0}), 0, true};
            for (std::size_t x = 1; x < width_; ++x) {
                const std::uint64_t value = key(row, x);
                if (value >= bound.least) continue;
                bound.least = value;
                bound.place = x;
            }
        }
    }

  private:
    // All numbers are `least` or more. If it is exact, the first one that is equal is at `place`:
    // the column of a row, the row of a frame.
    struct Bound {
        std::uint64_t least = 0;
        std::size_t place = 0;
        bool is_exact = false;
    };

    LeastKey result(std::size_t frame) const {
        const std::size_t row = frames_[frame].place;
        const Bound& bound = rows_[frame * height_ + row];
        return {bound.least, row, bound.place};
    }

    std::size_t lowest_row(std::size_t frame) const {
        const Bound* rows = &rows_[frame * height_];
        std::size_t lowest = 0;
        for (std::size_t row = 1; row < height_; ++row) {
            if (rows[row].least < rows[lowest].least) lowest = row;
        }
        return lowest;
    }

    std::size_t width_;
    std::size_t height_;
    std::vector<Bound> rows_;
    std::vector<Bound> frames_;
};

}  // namespace skybake::noise
