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
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/math/bake_options.h"

namespace skybake::noise {

struct MaskShape {
    std::array<int, 3> size{};    // pixels along x and y, and frames
    double spatial_sigma = 1.9;   // pixels
    double temporal_sigma = 1.9;  // frames
    std::uint64_t seed = 0;
};

// Returns the rank of each pixel in its frame, from 0 up, x fastest, then y, then t. Takes one
// thread. The result is empty after an interruption.
//
// Time: for each pixel one stamp of (17 sigma_s)^2 sums (torus_energy.h).
std::vector<std::uint32_t> void_and_cluster_ranks(const MaskShape& shape,
                                                  const BakeOptions& options);

// How many of `pixels` a frame begins with.
std::size_t first_pixels(std::size_t pixels);

// The hash that chooses them: those with the lowest numbers, of equal numbers the lower pixels.
std::uint64_t first_hash(std::uint64_t seed, std::size_t frame, std::size_t pixel);

}  // namespace skybake::noise
