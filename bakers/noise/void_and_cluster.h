// Blue noise by void and cluster: an order of the pixels of a stack of frames, in which the pixels
// of each frame, and the frames of each pixel, keep as far apart as they can.
//
//   energy of p  =  sum over the chosen q of  exp(-|p - q|^2 / (2 sigma_s^2))  in the same frame,
//                                             exp(-|p - q|^2 / (2 sigma_t^2))  in the same pixel
//
// (Wolfe, Morrical, Akenine-Moeller and Ramamoorthi 2022, Spatiotemporal Blue Noise Masks). Pixels
// that share neither frame nor place do not interact. Distances are toroidal along x, y and t: all
// periodic images of q count. One frame gives the masks of Ulichney 1993, The void-and-cluster
// method for dither array generation.
//
// 1. Each frame begins with a tenth of its pixels, chosen by a hash. While that lowers the energy,
//    the tightest cluster, the chosen pixel of the greatest energy, moves to the largest void, the
//    free pixel of the least energy in its frame.
// 2. The tightest clusters are removed one by one. Each gets the highest rank that its frame has
//    left below a tenth.
// 3. From the pattern of step 1 on, the largest voids are filled one by one. Each gets the lowest
//    rank that its frame has left. (Ulichney's third phase, which looks for clusters of free
//    pixels, finds the same pixels, because on a torus the energies by chosen and by free pixels
//    add up to a constant.)
//
// The paper ranks all pixels of all frames in one order. Here, in steps 2 and 3, every frame has its
// turn before any has another one, and the frame with the greatest cluster or void goes first. So
// each frame has each rank once.
//
// Energies are sums of whole numbers, so no order of sums changes them. Equal energies are decided
// by the lower frame, then the lower row, then the lower column.
//
// The energies of void and cluster are kept up to date while pixels are chosen
// and freed, and the extreme pixels of each frame.
//
// The least of many numbers, found again after each small change of them.
//
// The numbers lie in frames of rows. Each row remembers where its least number was and a bound that
// none of its numbers is below. A number that grows leaves the bound right, so a row is searched
// again only if its least number has grown and its bound is the least of the frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/math/bake_options.h"

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

// Weights are whole multiples of 1 / kStampUnit. So pixels farther apart than 8.6 sigma do not
// interact, and a pixel's energy, at most (2 pi sigma_s^2 + sqrt(2 pi) sigma_t) kStampUnit, fits 63
// bits for sigmas up to 16.
inline constexpr double kStampUnit = 0x1p52;

// A pixel of a frame and its energy.
struct Extremum {
    std::uint64_t energy = 0;
    std::size_t pixel = 0;
};

class TorusEnergy {
  public:
    // `size` has the pixels along x and y, and the frames. Sigmas are in pixels and in frames. No
    // pixel is chosen at first.
    TorusEnergy(const std::array<int, 3>& size, double spatial_sigma, double temporal_sigma);

    // Chooses a free pixel, and frees a chosen one.
    void add(std::size_t frame, std::size_t pixel);
    void remove(std::size_t frame, std::size_t pixel);

    std::uint64_t at(std::size_t frame, std::size_t pixel) const {
        return energy_[frame * width_ * height_ + pixel];
    }

    // Return the chosen pixel of the greatest energy, and the free one of the least; of equal ones
    // the first. The frame must have such a pixel.
    Extremum tightest_cluster(std::size_t frame);
    Extremum largest_void(std::size_t frame);

  private:
    // Pixels first to last of a row.
    struct Span {
        std::size_t frame = 0;
        std::size_t row = 0;
        std::size_t first = 0;
        std::size_t last = 0;
    };

    // Adds the stamp of a pixel, or takes it away.
    void stamp(std::size_t frame, std::size_t pixel, bool is_raised);
    void stamp_row(std::size_t frame, std::size_t row, std::size_t column,
                   const std::uint64_t* weights, bool is_raised);
    void stamp_span(const Span& span, const std::uint64_t* weights, bool is_raised);
    void note(const Span& span, bool is_raised);

    std::uint64_t cluster_key(std::size_t voxel) const {
        return chosen_[voxel] ? ~energy_[voxel] : ~0ULL;
    }
    std::uint64_t void_key(std::size_t voxel) const {
        return chosen_[voxel] ? ~0ULL : energy_[voxel];
    }

    std::size_t width_;
    std::size_t height_;
    std::size_t frames_;
    int reach_;                // of the spatial stamp
    std::size_t columns_ = 0;  // of the spatial stamp, and its rows
    std::size_t rows_ = 0;
    std::vector<std::uint64_t> spatial_;   // row by row, from -reach_ on
    std::vector<std::uint64_t> temporal_;  // weights by the distance in frames; 0 of the own frame
    std::vector<std::uint64_t> energy_;
    std::vector<std::uint8_t> chosen_;
    LeastKeys clusters_, voids_;
};

struct MaskShape {
    std::array<int, 3> size{};    // pixels along x and y, and frames
    double spatial_sigma = 1.9;   // pixels
    double temporal_sigma = 1.9;  // frames
    std::uint64_t seed = 0;
};

// Returns the rank of each pixel in its frame, from 0 up, x fastest, then y, then t. Takes one
// thread. The result is empty after an interruption.
//
// Time: for each pixel one stamp of (17 sigma_s)^2 sums, and some rows that are
// searched again for their least energy.
std::vector<std::uint32_t> void_and_cluster_ranks(const MaskShape& shape,
                                                  const BakeOptions& options);

// How many of `pixels` a frame begins with.
std::size_t first_pixels(std::size_t pixels);

// The hash that chooses them: those with the lowest numbers, of equal numbers the lower pixels.
std::uint64_t first_hash(std::uint64_t seed, std::size_t frame, std::size_t pixel);

}  // namespace skybake::noise
