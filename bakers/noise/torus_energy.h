// The energies of void and cluster (void_and_cluster.h), kept up to date while pixels are chosen
// and freed, and the extreme pixels of each frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/noise/least_keys.h"

namespace skybake::noise {

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

}  // namespace skybake::noise
