// The tables of air_shells.h, as its kernels read them.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/math/vectors.h"

namespace skybake {

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

}  // namespace skybake
