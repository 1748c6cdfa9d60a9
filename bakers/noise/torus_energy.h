// The energies of blue noise (void_and_cluster.h), kept up to date while pixels are chosen and freed,
// and the extreme pixels of each frame.
//
// A pixel's key is its energy, less 2^63 while it is free, so that every free pixel has a lower key
// than every chosen one: the largest void has the least key of its frame, the tightest cluster the
// greatest. Keys lie in tiles of 8 x 8 pixels. To choose a pixel is to add its stamp to all tiles
// that it reaches, and what is read for that tells each tile's least and greatest key as well.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/math/memory.h"

namespace skybake::noise {

// Weights are whole multiples of 1 / kStampUnit. So pixels farther apart than 8.6 sigma do not
// interact, and a pixel's energy, at most (2 pi sigma_s^2 + sqrt(2 pi) sigma_t) kStampUnit, fits 63
// bits for sigmas up to 16.
inline constexpr double kStampUnit = 0x1p52;

inline constexpr std::size_t kTileEdge = 8;  // of a tile of keys, in pixels

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
    void add(std::size_t frame, std::size_t pixel) { stamp(frame, pixel, 1); }
    void remove(std::size_t frame, std::size_t pixel) { stamp(frame, pixel, -1); }

    std::uint64_t at(std::size_t frame, std::size_t pixel) const;

    // Return the chosen pixel of the greatest energy, and the free one of the least; of equal ones
    // the first. The frame must have such a pixel.
    Extremum tightest_cluster(std::size_t frame) { return extremum(frame, 1); }
    Extremum largest_void(std::size_t frame) { return extremum(frame, 0); }

  private:
    using Keys = std::vector<std::int64_t, CacheLineAllocator<std::int64_t>>;
    using Extremes =
        std::array<std::int64_t, 2>;  // the least key, and the complement of the greatest

    // A tile that a stamp reaches, along an axis, and the stamp's first weight in it.
    struct Reached {
        std::size_t tile, weight;
    };
    // The pixel of a frame's extreme key, unless it has to be found again.
    struct Found {
        bool is_known = false;
        std::int64_t key = 0;
        std::size_t pixel = 0;
    };

    static std::vector<std::vector<Reached>> reached(std::size_t reach, std::size_t count,
                                                     std::size_t size);
    std::size_t place_of(std::size_t pixel) const;  // of its key in its frame
    void stamp(std::size_t frame, std::size_t pixel, std::int64_t sign);
    void add_to_tile(std::size_t frame, std::size_t tile, const std::int64_t* weights);
    void change(std::size_t frame, std::size_t pixel, std::size_t place, std::int64_t by);
    Extremum extremum(std::size_t frame, std::size_t end);
    Found find(std::size_t frame, std::size_t end) const;

    std::size_t width_, height_, frames_;
    std::size_t tile_columns_, tiles_;                 // of a frame
    std::size_t stamp_stride_ = 0;                     // weights from row to row, with the zeros
    std::array<Keys, 2> stamps_;                       // what raises and lowers, within 8 zeros
    std::vector<std::int64_t> temporal_;               // by the distance in frames; 0 of the own
    std::vector<std::vector<Reached>> across_, down_;  // by the stamp's middle
    Keys keys_;                                        // [frame][tile][row][column]
    std::vector<Extremes> extremes_;                   // [frame][tile]
    std::vector<std::array<Found, 2>> found_;          // of each frame
};

}  // namespace skybake::noise
