// Distances as a texture holds them, so that no step by a lookup goes too far.
//
// Let d(p) be the distance from p to the touched cells (cloud_bits.h), h half the diagonal of a texel, e
// its edge along z, and let a lookup at p blend the texels t about it with weights w that sum to 1. What
// a blend of exact distances is too large by, sum of w(t) d(t) - d(p), is at most
//   h                        as distances differ by no more than places do, and the sum of
//                            w(t) |t - p| is at most the root of that of w(t) |t - p|^2, which is at
//                            most a quarter of the squared edge along each axis.
//   (h^2 + e^2 / 8) / (2 r)  where d(p) is r or more. Let s be the nearest place of a touched cell, and
//                            u the direction from s to p. Then |t - s| <= |p - s| + u (t - p) +
//                            |t - p|^2 / (2 |p - s|), whose blend has h^2 / (2 r) from the last term.
//                            The middle one vanishes where the blend of the t is p. Below the middles
//                            of the lowest texels and above those of the highest, where lookups are
//                            clamped, p is up to e / 2 from it along z, and s is within base and top:
//                            there it is at most e^2 / (16 r).
// So a texel holds d less the smaller of the two, with r = d - 2 h, if no texel of the lookup is
// negative then. A texel that is 3 h away has only neighbours that are h away. A nearer one holds
// d - 2 h, or 0 if that is negative: as no place of the lookup is farther than 2 h from it, this is not
// above d(p) anywhere.
//
// Within the cloud the distance to the holed cells is taken in the same way, as a negative number.
// Every lookup D hence has -(distance to the nearest holed cell) <= D <= distance to the nearest
// touched cell; both are 0 in cells that are touched and holed.
//
// Allowed for besides: a lookup's place may be off by 1/256 texel along each axis (GPUs round the
// weights to 1/256, and places are floats), and its arithmetic by 2^-20 of the range. What is stored
// is rounded towards 0. Where the pixel type does not hold 0 itself, the next lower value that it has
// stands for it.
#pragma once

#include <array>
#include <cstddef>

#include "config/sections/pixel_types.h"

namespace skybake::occupancy {

class DistanceCode {
  public:
    // Distances from range_m[0] <= 0 to range_m[1] > 0 in metres, of texels with these edges. unorm
    // types store the range as [0, 1], others store metres.
    DistanceCode(const std::array<double, 2>& range_m, const std::array<double, 3>& texel_m,
                 PixelType type);

    // Return what a texel at this squared distance in m^2 from touched cells, or within touched
    // cells and at this one from holed cells, holds.
    float outside(float square) const;
    void outside(const float* squares, std::size_t count, float* out) const;
    float inside(float square) const;
    float surface() const { return surface_; }

    // Returns the metres that stand for a stored or looked-up value.
    double metres(double value) const;
    // Returns what a runtime takes 0 and 1 for, in metres.
    std::array<double, 2> ends() const { return ends_m_; }

    // Returns the range in metres.
    const std::array<double, 2>& range() const { return range_m_; }

    // Returns what the arithmetic of a lookup may add: 0 is looked up as some number within it.
    double rounding_m() const { return arithmetic_m_; }

    // Returns the largest amount by which a stored value's size is below the distance's, if that is
    // within the range.
    double most_lost() const;

  private:
    double shortened(float square) const;
    double steps() const { return type_ == PixelType::unorm8 ? 255 : 65535; }

    std::array<double, 2> range_m_;
    std::array<double, 2> ends_m_;
    PixelType type_;
    double half_diagonal_m_;
    double curvature_m2_;
    double arithmetic_m_;
    float surface_;
};

}  // namespace skybake::occupancy
