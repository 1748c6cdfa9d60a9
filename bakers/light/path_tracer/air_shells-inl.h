// The depths of air_shells.h, each formula once: for one point or for a vector of points, and of all
// wavelengths at once or of one.
//
// Real is double or Lanes. Indices of shells and channels are whole numbers in a Real, so that all
// masks are of one kind.
#if defined(SKYBAKE_BAKERS_LIGHT_PATH_TRACER_AIR_SHELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_AIR_SHELLS_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_PATH_TRACER_AIR_SHELLS_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_PATH_TRACER_AIR_SHELLS_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include "bakers/light/path_tracer/air_shells.h"
#include "bakers/math/channels-inl.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Gauss-Legendre on [0, 1].
constexpr int kShellNodes = 4;
constexpr double kShellPlaces[kShellNodes] = {0.069431844202973712, 0.33000947820757187,
                                              0.66999052179242813, 0.93056815579702629};
constexpr double kShellWeights[kShellNodes] = {0.17392742256872693, 0.32607257743127307,
                                               0.32607257743127307, 0.17392742256872693};

// The change of a length found from its depth at which the search ends: leaves less than 6e-8 of it.
constexpr double kLastChange = 4e-3;
constexpr int kMostLengthSteps = 64;

// --- Tables of levels ----------------------------------------------------------------------------

// Where a shifted distance s + k lies in its interval, in [0, 1).
template <class Real>
HWY_INLINE Real share_of_interval(Real shifted) {
    constexpr std::uint64_t kOne = std::uint64_t{0x3ff0000000000000};
    const Real offset = shift_bits_left<64 - AirTables::kOffsetBits>(shifted);
    return add_to_bits(shift_bits_right<12>(offset), kOne) - Real(1.0);
}

// The length of its interval: the power of two below it over 2^5.
template <class Real>
HWY_INLINE Real length_of_interval(Real shifted) {
    constexpr std::uint64_t kExponent = std::uint64_t{0x7ff0000000000000};
    return and_bits(shifted, kExponent) * Real(1.0 / (1 << AirTables::kIntervalBits));
}

// The number of its interval, from that of s = 0 on.
template <class Real>
HWY_INLINE auto number_of_interval(Real shifted, Real scale) {
    return shifted_right<AirTables::kOffsetBits>(integer_of_bits(shifted) - integer_of_bits(scale));
}

// A cubic through two values with their slopes, `share` of the way.
template <class Value>
HWY_INLINE Value cubic(Value value, Value slope, Value next_value, Value next_slope, Value length,
                       Value share) {
    const Value rise = next_value - value;
    const Value from = length * slope;
    const Value to = length * next_slope;
    return value + share * (from + share * ((Value(3.0) * rise - Value(2.0) * from - to) +
                                            share * (from + to - Value(2.0) * rise)));
}

// The depth above a shell's upper level, of one channel.
template <class Real>
HWY_INLINE Real level_depth(const AirTables& air, Real shell, Real channel, Real s_km) {
    const auto at = shifted_left<AirTables::kShellBits>(to_index(shell));
    const Real scale = gather(&air.shells[0].scale_km, at);
    const Real shifted = s_km + scale;
    const auto node = to_index(gather(&air.shells[0].first_number, at) + channel) +
                      shifted_left<AirTables::kNodeBits>(number_of_interval(shifted, scale));
    const double* nodes = air.nodes[0].value;
    return cubic(gather(nodes, node), gather(nodes + kChannelSlots, node),
                 gather(nodes + 2 * kChannelSlots, node), gather(nodes + 3 * kChannelSlots, node),
                 length_of_interval(shifted), share_of_interval(shifted));
}

// --- Shells --------------------------------------------------------------------------------------

// Degree 5, without a loop, which the compiler would keep in memory.
HWY_INLINE Channels polynomial(const double (*coefficients)[kChannelSlots], Channels t) {
    const auto c = [&](int n) { return Channels::load(coefficients[n]); };
    return ((((c(5) * t + c(4)) * t + c(3)) * t + c(2)) * t + c(1)) * t + c(0);
}

// t of a shell at an altitude.
HWY_INLINE double position_in_shell(const AirTables::AirShell& shell, double altitude_km) {
    const double drop = altitude_km - shell.top_km;
    return 1 + drop * (2 * shell.top_radius_km + drop) * shell.inverse_half_width;
}

HWY_INLINE Channels extinction_at(const AirTables& air, std::size_t shell, double altitude_km) {
    const AirTables::AirShell& at = air.shells[shell];
    return polynomial(at.extinction, Channels(position_in_shell(at, altitude_km)));
}

HWY_INLINE double density_at(const AirTables& air, std::size_t shell, std::size_t layer,
                             double altitude_km) {
    const double t = position_in_shell(air.shells[shell], altitude_km);
    const double* c = air.densities[shell * air.layers + layer].coefficients;
    return ((((c[5] * t + c[4]) * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0];
}

// U (air_shells.h).
HWY_INLINE Channels depth_to_top(const AirTables& air, double altitude_km, double s_km,
                                 std::size_t shell) {
    const AirTables::AirShell& at = air.shells[shell];
    const double gain = at.top_km - altitude_km;
    const double q = gain * (2 * (air.planet.ground_radius_km + altitude_km) + gain);
    const double s_top = std::sqrt(std::max(s_km * s_km + q, 0.0));
    const double sum_of_s = s_top + s_km;
    const double length = sum_of_s > 0 ? std::max(q, 0.0) / sum_of_s : 0;
    Channels within(0.0);
    HWY_UNROLL(kShellNodes)
    for (int i = 0; i < kShellNodes; ++i) {
        const double y = length * kShellPlaces[i];
        const Channels t(1 + y * (y - 2 * s_top) * at.inverse_half_width);
        within = within + kShellWeights[i] * polynomial(at.extinction, t);
    }
    const double shifted = s_top + at.scale_km;
    const AirTables::Node* node =
        air.nodes.data() + (static_cast<std::size_t>(at.first_number) >> AirTables::kNodeBits) +
        number_of_interval(shifted, at.scale_km);
    return length * within + cubic(Channels::load(node[0].value), Channels::load(node[0].slope),
                                   Channels::load(node[1].value), Channels::load(node[1].slope),
                                   Channels(length_of_interval(shifted)),
                                   Channels(share_of_interval(shifted)));
}

HWY_INLINE std::size_t shell_at(const AirTables& air, double altitude_km) {
    const auto slices = static_cast<int>(air.guide.size());
    const double slice = altitude_km / air.planet.thickness_km * slices;
    auto shell = static_cast<std::size_t>(
        air.guide[static_cast<std::size_t>(std::clamp(static_cast<int>(slice), 0, slices - 1))]);
    // The slice was found with rounding: a level at its beginning may be on either side.
    while (shell > 0 && altitude_km < air.shells[shell].bottom_km) --shell;
    while (shell + 1 < air.shells.size() && altitude_km >= air.shells[shell].top_km) ++shell;
    return shell;
}

// The transmittance to the top of the atmosphere where r mu = `s_km` towards the light.
HWY_INLINE Channels sunlight(const AirTables& air, double altitude_km, double s_km,
                             std::size_t shell) {
    if (s_km >= 0) return exponential(-depth_to_top(air, altitude_km, s_km, shell));
    if (s_km < -horizon_distance_km(air.planet, altitude_km)) return Channels(0.0);
    const double drop = drop_to_nearest_km(air.planet, altitude_km, s_km);
    const double nearest = std::max(altitude_km - drop, 0.0);  // rounding
    const Channels below = depth_to_top(air, nearest, 0, shell_at(air, nearest));
    return exponential(depth_to_top(air, altitude_km, -s_km, shell) - 2.0 * below);
}

// --- Points of a depth ---------------------------------------------------------------------------

// One channel's extinction in a shell.
template <class Real>
struct ExtinctionInShell {
    Real coefficients[AirTables::kDegree + 1];
    Real inverse_half_width;

    HWY_INLINE ExtinctionInShell(const AirTables& air, Real shell, Real channel) {
        const auto at = shifted_left<AirTables::kShellBits>(to_index(shell));
        inverse_half_width = gather(&air.shells[0].inverse_half_width, at);
        const auto first = at + to_index(channel);
        HWY_UNROLL(6)
        for (int n = 0; n <= AirTables::kDegree; ++n) {
            coefficients[n] = gather(air.shells[0].extinction[n], first);
        }
    }
    // At `y` below the top, where the line is at s_top.
    HWY_INLINE Real position(Real y, Real s_top) const {
        return Real(1.0) + y * (y - Real(2.0) * s_top) * inverse_half_width;
    }
    HWY_INLINE Real at(Real y, Real s_top) const {
        const Real t = position(y, s_top);
        const Real* c = coefficients;
        return ((((c[5] * t + c[4]) * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0];
    }
    // Returns the derivative of `at` with respect to y.
    HWY_INLINE Real growth(Real y, Real s_top) const {
        const Real t = position(y, s_top);
        const Real* c = coefficients;
        const Real by_t = (((Real(5.0) * c[5] * t + Real(4.0) * c[4]) * t + Real(3.0) * c[3]) * t +
                           Real(2.0) * c[2]) *
                              t +
                          c[1];
        return Real(2.0) * (y - s_top) * inverse_half_width * by_t;
    }
    // The depth of a length below the top.
    HWY_INLINE Real depth(Real length, Real s_top) const {
        Real sum = Real(0.0);
        HWY_UNROLL(kShellNodes)
        for (int i = 0; i < kShellNodes; ++i) {
            sum = sum + Real(kShellWeights[i]) * at(length * Real(kShellPlaces[i]), s_top);
        }
        return length * sum;
    }
};

// The length below a shell's top, where the line is at s_top, that has a depth: Halley's method
// within a bracket. The depth is a rising function with the extinction for its slope. It begins at
// the depth over the extinction in the middle of the length that follows from the top's.
template <class Real>
HWY_INLINE Real length_at_depth(const ExtinctionInShell<Real>& extinction, Real s_top, Real longest,
                                Real depth) {
    const Real zero = Real(0.0);
    Real low = zero;
    Real high = longest;
    const auto within = [&](Real length) {
        const Real not_longer = select(length < longest, length, longest);
        return select(not_longer >= zero, not_longer, zero);  // no extinction in this shell
    };
    const Real first = within(depth / extinction.at(zero, s_top));
    Real length = within(depth / extinction.at(Real(0.5) * first, s_top));
    auto going_on = longest >= longest;
    for (int i = 0; i < kMostLengthSteps && any(going_on); ++i) {
        const Real error = extinction.depth(length, s_top) - depth;
        const auto too_far = error > zero;
        high = select(going_on & too_far, length, high);
        low = select(and_not(going_on, too_far), length, low);
        const Real slope = extinction.at(length, s_top);
        const Real bend = Real(0.5) * extinction.growth(length, s_top);
        Real next = length - error * slope / (slope * slope - error * bend);
        // Steps end within rounding of either bracket where that is the answer.
        next = select((next > low) & (next < high), next, Real(0.5) * (low + high));
        const Real change = absolute(next - length);
        length = select(going_on, next, length);
        // Convergence is cubic: what is left is below the cube of the last change.
        going_on = and_not(going_on, change <= Real(kLastChange) * length);
    }
    return length;
}

template <class Real>
struct PointInShell {
    Real altitude_km;
    Real s_km;
    Real shell;
};

// The shell where the vertical depth is `times` that at a point, about: where a search begins. In
// the point's shell the vertical depth is taken as linear.
template <class Real>
HWY_INLINE Real shell_of_vertical(const AirTables& air, const PointInShell<Real>& point,
                                  Real channel, Real times) {
    constexpr int kOffsetBits = 52 - AirTables::kShareBits;
    const Real least = Real(AirTables::kLeastShare);
    const Real most = Real(1 - 0x1p-10);
    const auto at = shifted_left<AirTables::kShellBits>(to_index(point.shell));
    const Real bottom = gather(&air.shells[0].bottom_km, at);
    const Real top = gather(&air.shells[0].top_km, at);
    const double* below = air.vertical_shares.data();
    const double* above = below + kChannelSlots;
    const auto level = to_index(point.shell * Real(kChannelSlots) + channel);
    const Real above_point = gather(above, level);
    const Real rise = (gather(below, level) - above_point) / (top - bottom);
    Real share = (above_point + rise * (top - point.altitude_km)) * times;
    share = select(share > least, share, least);  // where there is no air above as well
    share = select(share < most, share, most);
    const auto number = shifted_right<kOffsetBits>(integer_of_bits(share) - integer_of_bits(least));
    const Real shell =
        gather(air.shell_at_share.data(), to_index(channel * Real(AirTables::kShares)) + number);
    const Real above_shell = gather(above, to_index(shell * Real(kChannelSlots) + channel));
    return select(above_shell > share, shell + Real(1.0), shell);
}

// Returns the point, at or above shell `lowest` and at or below shell `highest`, on the line through
// `on_line`, where U of one channel is `depth`; at `on_line` it is `depth_there`. If U is below
// `depth` everywhere on the line, returns the line's lowest point.
template <class Real>
HWY_INLINE PointInShell<Real> point_at_depth(const AirTables& air,
                                             const PointInShell<Real>& on_line, Real depth_there,
                                             Real channel, Real depth, Real lowest, Real highest) {
    const Real altitude_km = on_line.altitude_km;
    const Real s_km = on_line.s_km;
    const Real diameter = Real(2.0) * (Real(air.planet.ground_radius_km) + altitude_km);
    const auto square_of_s = [&](Real level_km) {
        const Real gain = level_km - altitude_km;
        return s_km * s_km + gain * (diameter + gain);
    };
    // The lowest shell whose upper level has no more depth above it than asked for. The search looks
    // where depths would lead that are as many times the vertical ones as at the start of the line,
    // then one and two shells further, and halves what is left then.
    Real middle = shell_of_vertical(air, on_line, channel, depth / depth_there);
    Real above_end = Real(-1.0);  // unknown
    int step = 0;
    for (auto apart = lowest < highest; any(apart); apart = lowest < highest) {
        middle = maximum(minimum(middle, highest - Real(1.0)), lowest);
        const auto at = shifted_left<AirTables::kShellBits>(to_index(middle));
        const Real square = square_of_s(gather(&air.shells[0].top_km, at));
        const auto reached = square >= Real(0.0);
        const Real above =
            level_depth(air, middle, channel, square_root(maximum(square, Real(0.0))));
        const auto enough = reached & (above <= depth);
        highest = select(apart & enough, middle, highest);
        above_end = select(apart & enough, above, above_end);
        lowest = select(and_not(apart, enough), middle + Real(1.0), lowest);
        const double further = ++step;
        middle = step < 3 ? select(enough, middle - Real(further), middle + Real(further))
                          : floor_of(Real(0.5) * (lowest + highest));
    }
    const auto at = shifted_left<AirTables::kShellBits>(to_index(lowest));
    const Real top = gather(&air.shells[0].top_km, at);
    const Real bottom = gather(&air.shells[0].bottom_km, at);
    const Real s_top = square_root(maximum(square_of_s(top), Real(0.0)));
    const Real longest = s_top - square_root(maximum(square_of_s(bottom), Real(0.0)));
    const auto unknown = above_end < Real(0.0);
    if (any(unknown)) {
        above_end = select(unknown, level_depth(air, lowest, channel, s_top), above_end);
    }
    const Real within = maximum(depth - above_end, Real(0.0));
    const Real length =
        length_at_depth(ExtinctionInShell<Real>(air, lowest, channel), s_top, longest, within);
    const Real q = length * (length - Real(2.0) * s_top);
    const Real r = gather(&air.shells[0].top_radius_km, at);
    const Real gain = q / (square_root(maximum(r * r + q, Real(0.0))) + r);
    return {minimum(maximum(top + gain, bottom), top), s_top - length, lowest};
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_PATH_TRACER_AIR_SHELLS_INL_H_
