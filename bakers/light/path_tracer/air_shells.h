// Optical depths for paths through the air, accurate to 2e-7 at the cost of a table lookup, and
// their inversion.
//
// The air is divided into shells in which densities are polynomials in r^2. Along a line whose
// nearest point to the planet's centre is at distance p, r^2 = p^2 + s^2, where s is the distance
// from that point. The depth from (h, s >= 0) upwards to space is
//
//   U(h, s) = integral of extinction from h to the shell's upper level  +  A(s at that level),
//
// The first term is integrated by Gauss's rule on the polynomial; the second is read from a table
// that belongs to the level. A is smooth in s on a scale that is at least the length of a
// horizontal path through the shell above, and falls as 1 / s beyond, so intervals grow with s. A
// level lies on either side of each edge of a layer, so that nothing is interpolated across an
// edge. Depths along any other path are sums and differences of U.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"
#include "bakers/math/vectors.h"

namespace skybake {

// The tables, as kernels read them.
struct AirTables {
    static constexpr int kDegree = 5;
    // 2^5 intervals each time that s + k doubles: the upper bits of s + k count them.
    static constexpr int kIntervalBits = 5;
    static constexpr int kOffsetBits = 52 - kIntervalBits;

    // Polynomials are in t = (r^2 - r_middle^2) / half_width, which is -1 at the bottom and 1 at
    // the top. Lanes gather these numbers, so that all of them are doubles.
    struct alignas(64) AirShell {
        double bottom_km = 0;
        double top_km = 0;
        double top_radius_km = 0;
        double inverse_half_width = 0;  // of r^2
        double scale_km = 0;            // k of the upper level's table: a power of two
        double first_number = 0;        // in `nodes`, of the table's first node
        double extinction[kDegree + 1][kChannelSlots] = {};  // per km
    };
    static constexpr int kShellBits = 5;  // a shell has 2^5 numbers
    static_assert(sizeof(AirShell) == sizeof(double) << kShellBits);

    struct Node {
        double value[kChannelSlots] = {};
        double slope[kChannelSlots] = {};
    };
    static constexpr int kNodeBits = 3;
    static_assert(sizeof(Node) == sizeof(double) << kNodeBits);

    struct Polynomial {
        double coefficients[kDegree + 1] = {};
    };

    Shell planet;
    std::size_t layers = 0;
    std::vector<AirShell> shells;
    std::vector<Polynomial> densities;  // of all layers of the first shell, then of the second
    std::vector<Node> nodes;
    std::vector<int> guide;  // the shell at the bottom of each of equal slices of altitude

    // Vertical depths, as shares of that of all air, from which the search for a depth on a line
    // begins: above each level from the ground on, and the shell at the upper end of each step of
    // shares, of which there are four each time that a share doubles, from 2^-32 to 1.
    static constexpr int kShareBits = 2;
    static constexpr double kLeastShare = 0x1p-32;
    static constexpr std::size_t kShares = 32 << kShareBits;
    std::vector<double> vertical_shares;  // kChannelSlots for each level
    std::vector<double> shell_at_share;   // kShares for each channel
};

class AirShells {
  public:
    explicit AirShells(const SkyMedium& medium);

    // A point on a line, given by its shell and by its distance from the line's point nearest to
    // the planet's centre, on either side.
    struct Point {
        double altitude_km = 0;
        double s_km = 0;  // not negative
        std::size_t shell = 0;
    };

    // Returns the shell that contains an altitude in [0, thickness]; at a level between two shells,
    // the upper one.
    std::size_t shell_at(double altitude_km) const;

    // Returns U (see above), within 2e-7 of its value or of a millionth of the depth of all air,
    // and within 1e-6 for air very unlike a planet's.
    Spectrum depth_to_top(const Point& point) const;

    // Returns the transmittance to the top of the atmosphere at a point where r mu = `s_km` towards
    // the light. It is 0 in the planet's shadow, whose edge is exact.
    Spectrum sunlight(double altitude_km, double s_km, std::size_t shell) const;

    const AirTables& tables() const { return tables_; }
    const Shell& planet() const { return tables_.planet; }
    std::size_t count() const { return tables_.shells.size(); }

  private:
    void add_shell(const SkyMedium& medium, double bottom_km, double top_km);
    void add_level(const Medium& air, double thickness_above_km);
    void add_shares(std::size_t channel);

    AirTables tables_;
};

}  // namespace skybake
