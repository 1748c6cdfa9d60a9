#include "bakers/noise/least_keys.h"

namespace skybake::noise {

LeastKeys::LeastKeys(std::size_t width, std::size_t height, std::size_t frames)
    : width_(width), height_(height), rows_(height * frames), frames_(frames) {}

void LeastKeys::grown(std::size_t frame, std::size_t row, std::size_t first, std::size_t last) {
    Bound& bound = rows_[frame * height_ + row];
    if (bound.place < first || bound.place > last) return;
    bound.is_exact = false;
    if (frames_[frame].place == row) frames_[frame].is_exact = false;
}

void LeastKeys::forget(std::size_t frame, std::size_t row) {
    rows_[frame * height_ + row] = {};
    frames_[frame].is_exact = false;
}

LeastKey LeastKeys::result(std::size_t frame) const {
    const std::size_t row = frames_[frame].place;
    const Bound& bound = rows_[frame * height_ + row];
    return {bound.least, row, bound.place};
}

std::size_t LeastKeys::lowest_row(std::size_t frame) const {
    const Bound* rows = &rows_[frame * height_];
    std::size_t lowest = 0;
    for (std::size_t row = 1; row < height_; ++row) {
        if (rows[row].least < rows[lowest].least) lowest = row;
    }
    return lowest;
}

}  // namespace skybake::noise
