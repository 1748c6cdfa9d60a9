#include "bakers/occupancy/distance_transform.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bakers/math/memory.h"
#include "bakers/math/parallel.h"
#include "bakers/occupancy/envelope_kernel.h"

namespace skybake::occupancy {
namespace {

constexpr float kNoCell = std::numeric_limits<float>::infinity();

// The cells of a kind in one row along x.
class CellRow {
  public:
    explicit CellRow(const VoxelBits& bits)
        : count_(bits.voxels()[0]),
          words_(bits.words()),
          before_(bits.words()),
          after_(bits.words()) {}

    bool read(const VoxelBits& bits, CellKind kind, int y, int z) {
        cells_between(bits, kind, y, z, words_.data());
        return std::ranges::any_of(words_, [](std::uint64_t w) { return w != 0; });
    }

    // Writes the squared distance from each point of the axis to the nearest cell of the row, which
    // has one.
    void write_squares(const EnvelopeAxis& axis, float* squares) {
        if (is_full()) {
            std::fill_n(squares, axis.points(), 0.0F);
            return;
        }
        if (axis.points() == count_) return write_at_voxels(axis, squares);
        find_neighbours();
        for (int point = 0; point < axis.points(); ++point) {
            const int at = axis.centre(point);
            const int k = (at - 1) / 2;
            const int below = std::max(0, at - (2 * last_until(k) + 3));
            const int above = std::max(0, 2 * first_from(k) + 1 - at);
            squares[point] = axis.of(std::min(below, above));
        }
    }

  private:
    // Point p is the middle of voxel p, between the cells p - 1 and p. So between two cells a and b of
    // the row, with none between them, distances rise from 0 at point a + 1 and fall to 0 at point b,
    // by a voxel from point to point.
    void write_at_voxels(const EnvelopeAxis& axis, float* squares) {
        if (rising_.empty()) {
            for (int i = 0; i <= count_ / 2; ++i) rising_.push_back(axis.of(2 * i));
        }
        const int first = first_of_all(false);
        const int last = first_of_all(true);
        std::fill(squares + first, squares + last + 1, 0.0F);
        for (int clear = next(first, false); clear < last;) {
            const int set = next(clear, true);
            float* from = squares + clear;
            const int points = set - clear + 1;
            std::copy_n(rising_.data(), (points + 1) / 2, from);
            std::reverse_copy(rising_.data(), rising_.data() + points / 2, from + (points + 1) / 2);
            clear = next(set, false);
        }
        // The last cells lie before the first ones of the next tile.
        const int points = first + count_ - last;
        for (int i = 0; i < points; ++i) {
            const int point = last + 1 + i;
            squares[point < count_ ? point : point - count_] =
                rising_[static_cast<std::size_t>(std::min(i, points - 1 - i))];
        }
    }

    // Returns the first cell at or after `k` that is set or clear, or the end of the words.
    int next(int k, bool is_set) const {
        for (std::size_t w = static_cast<std::size_t>(k / kWordBits); w < words_.size(); ++w) {
            std::uint64_t cells = is_set ? words_[w] : ~words_[w];
            if (static_cast<int>(w) == k / kWordBits) cells &= ~std::uint64_t{0} << (k % kWordBits);
            if (cells != 0) return first_in(w, cells);
        }
        return static_cast<int>(words_.size()) * kWordBits;
    }

    bool is_full() const {
        const std::uint64_t ends =
            count_ % kWordBits == 0 ? 0 : ~std::uint64_t{0} << (count_ % kWordBits);
        const auto is_full = [](std::uint64_t word) { return word == ~std::uint64_t{0}; };
        return is_full(words_.back() | ends) &&
               std::all_of(words_.begin(), words_.end() - 1, is_full);
    }

    // The last cell before each word and the first one after it, of the tiles beside this one too.
    void find_neighbours() {
        const std::size_t size = words_.size();
        int last = first_of_all(true) - count_;
        for (std::size_t w = 0; w < size; ++w) {
            before_[w] = last;
            if (words_[w] != 0) last = last_in(w, words_[w]);
        }
        int first = first_of_all(false) + count_;
        for (std::size_t w = size; w-- > 0;) {
            after_[w] = first;
            if (words_[w] != 0) first = first_in(w, words_[w]);
        }
    }

    // The first cell of the row, or the last one.
    int first_of_all(bool from_the_end) const {
        std::size_t w = from_the_end ? words_.size() - 1 : 0;
        while (words_[w] == 0) from_the_end ? --w : ++w;
        return from_the_end ? last_in(w, words_[w]) : first_in(w, words_[w]);
    }

    static int last_in(std::size_t word, std::uint64_t cells) {
        return static_cast<int>(word) * kWordBits + kWordBits - 1 - std::countl_zero(cells);
    }
    static int first_in(std::size_t word, std::uint64_t cells) {
        return static_cast<int>(word) * kWordBits + std::countr_zero(cells);
    }

    int last_until(int k) const {
        const auto word = static_cast<std::size_t>(k / kWordBits);
        const std::uint64_t cells =
            words_[word] & (~std::uint64_t{0} >> (kWordBits - 1 - k % kWordBits));
        return cells != 0 ? last_in(word, cells) : before_[word];
    }
    int first_from(int k) const {
        const auto word = static_cast<std::size_t>(k / kWordBits);
        const std::uint64_t cells = words_[word] & (~std::uint64_t{0} << (k % kWordBits));
        return cells != 0 ? first_in(word, cells) : after_[word];
    }

    int count_;
    std::vector<std::uint64_t> words_;
    std::vector<int> before_;
    std::vector<int> after_;
    std::vector<float> rising_;  // squares of 0, 1, 2 ... voxels
};

class Transform {
  public:
    Transform(const VoxelBits& bits, const DistanceGrid& grid, CellKind kind, ScratchFloats& planes)
        : bits_(bits),
          kind_(kind),
          x_(grid.grid.voxels[0], grid.grid.cell, grid.voxel_m[0], true),
          y_(grid.grid.voxels[1], grid.grid.cell, grid.voxel_m[1], true),
          z_(grid.grid.voxels[2], grid.grid.cell, grid.voxel_m[2], false),
          width_((static_cast<std::size_t>(x_.points()) + kColumns - 1) / kColumns * kColumns),
          layers_(static_cast<std::size_t>(z_.cells())),
          planes_(planes) {
        planes_.reserve(width_ * layers_ * static_cast<std::size_t>(y_.points()));
    }

    int layers() const { return z_.cells(); }
    int rows() const { return y_.points(); }

    // Along x and y, in one layer of cells.
    void run_layer(int z) {
        AlignedFloats plane(width_ * static_cast<std::size_t>(y_.cells()), kNoCell);
        CellRow row(bits_);
        bool any = false;
        for (int y = 0; y < y_.cells(); ++y) {
            if (!row.read(bits_, kind_, y, z)) continue;
            any = true;
            row.write_squares(x_, plane.data() + width_ * static_cast<std::size_t>(y));
        }
        float* out = planes_.data() + width_ * static_cast<std::size_t>(z);
        if (!any) {
            for (int y = 0; y < rows(); ++y, out += width_ * layers_) {
                std::fill_n(out, width_, kNoCell);
            }
            return;
        }
        EnvelopeScratch scratch(y_);
        for (std::size_t x = 0; x < width_; x += kColumns) {
            least_sums(plane.data() + x, width_, y_, scratch, out + x, width_ * layers_);
        }
    }

    // Along z, of one row of texels.
    void run_row(int y, const TexelSquares& take) {
        const float* in = planes_.data() + width_ * layers_ * static_cast<std::size_t>(y);
        EnvelopeScratch scratch(z_);
        AlignedFloats out(kColumns * static_cast<std::size_t>(z_.points()));
        for (std::size_t x = 0; x < width_; x += kColumns) {
            least_sums(in + x, width_, z_, scratch, out.data(), kColumns);
            const auto first = static_cast<int>(x);
            const int count = std::min(static_cast<int>(kColumns), x_.points() - first);
            for (int z = 0; z < z_.points(); ++z) {
                float* squares = out.data() + kColumns * static_cast<std::size_t>(z);
                if (kind_ == CellKind::holed) add_outside(z, squares);
                take(first, y, z, count, squares);
            }
        }
    }

  private:
    // Below the base and above the top there is no cloud.
    void add_outside(int z, float* squares) const {
        const int at = z_.centre(z);
        const int top = 2 * bits_.voxels()[2];
        const float outside = z_.of(std::max(0, std::min(at, top - at)));
        for (std::size_t c = 0; c < kColumns; ++c) squares[c] = std::min(squares[c], outside);
    }

    const VoxelBits& bits_;
    CellKind kind_;
    EnvelopeAxis x_;
    EnvelopeAxis y_;
    EnvelopeAxis z_;
    std::size_t width_;  // of a row of texels, in whole groups of columns
    std::size_t layers_;
    ScratchFloats& planes_;  // of each row of texels, all layers
};

}  // namespace

void distance_squares(const VoxelBits& bits, const DistanceGrid& grid, CellKind kind,
                      const BakeOptions& options, ScratchFloats& scratch,
                      const TexelSquares& take) {
    assert(grid.grid.voxels[0] % grid.grid.cell == 0 && grid.grid.voxels[1] % grid.grid.cell == 0);
    Transform transform(bits, grid, kind, scratch);
    for_each_tile(transform.layers(), options, "distances", [&](int z) { transform.run_layer(z); });
    for_each_tile(transform.rows(), options, "distances",
                  [&](int y) { transform.run_row(y, take); });
}

}  // namespace skybake::occupancy
