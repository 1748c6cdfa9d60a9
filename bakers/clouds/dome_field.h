// Domes: towers that are solids over the ground plan of a cloud, with all their periodic images.
//
//   S(p) = max over domes, max over integer n:  a max(0, 1 - s^2 - u^2 - v^2)
//
// At the height z, t = (z - foot_z) / height is in [0, 1]; elsewhere the dome adds nothing. u and v
// are the distances from its axis along its own two axes, each over the radius there. The axis is
// at foot + lean t height. s goes from 0 at t = widest to 1 at the top, and to 1 at the foot:
//
//   s = (t - widest) / (1 - widest) above,   (widest - t) / widest below
//
// So the surface, where 1 = s^2 + u^2 + v^2, is an ellipsoid's or two halves of ellipsoids', and
// noise that S is multiplied by moves a surface of constant b along its normal: bumps of the noise
// become billows.
//
// Lobes are balls whose middles lie in the upper part of the dome: the next step of a hierarchy of
// spheres (Bouthors and Neyret 2004, "Modeling clouds shape").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "config/sections/cloud.h"

namespace skybake::cloud {

// Lengths are in metres.
struct Dome {
    std::array<double, 3> foot{};
    std::array<double, 2> radii{};      // along its own axes
    std::array<double, 2> direction{};  // cosine and sine of the angle from x to the first axis
    double height = 0;
    double widest = 0;
    std::array<double, 2> lean{};
    double amplitude = 0;
};

// Returns the domes that a cloud lists, then those that it scatters, each followed by its lobes: those
// that live at its time, as they are then (tower_life.h).
std::vector<Dome> domes_of(const config::Cloud& cloud);

// A range of places along y and z, in metres.
struct DomeRange {
    std::array<double, 2> y{};
    std::array<double, 2> z{};
};

class DomeField {
  public:
    DomeField() = default;
    // `extent_m` is the tile, and its height.
    DomeField(std::span<const Dome> domes, const std::array<double, 3>& extent_m);

    bool empty() const { return images_.empty(); }
    const std::array<double, 3>& extent_m() const { return extent_m_; }

    // Returns the images of domes that may reach places of a range within the tile.
    std::vector<Dome> near(const DomeRange& range) const;

  private:
    std::vector<Dome> images_;
    std::array<double, 3> extent_m_{};
};

// Raises values[i] to the field of `domes`, without other images, at (x[i], y, z) in metres. x
// ascends. Each value is a pure function of its place and does not depend on the other x, nor on
// domes that do not reach it.
void raise_row(std::span<const Dome> domes, double y, double z, std::span<const double> x,
               double* values);

}  // namespace skybake::cloud
