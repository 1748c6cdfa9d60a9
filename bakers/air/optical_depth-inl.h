// Optical depth along straight rays through spherical shells, without cancellation.
//
//   tau = sum over layers of extinction * column,   column = integral of density ds
//
// Notation (Bruneton & Neyret 2008, section 2): r is the distance from the planet's centre, mu the
// cosine of the zenith angle, s = r mu the signed distance from the ray's point nearest to the
// centre, p^2 = r^2 - s^2, and dr / ds = s / r. Every ray consists of one or two *climbs*: paths
// along which r grows, from a lower end (r, s >= 0) through a gain of altitude c.
//
// Let z = s + r = z_a (1 + e), where z_a belongs to the lower end, and y = r_a - s_a = p^2 / z_a:
//
//   ds = r dz / z = 1/2 (z_a + y / (1 + e)^2) de
//   r - r_a = 1/2 e (2 s_a + z_a e) / (1 + e)
//
// Both are rational in e, hold for vertical rays (p = 0) and for horizontal ones (s_a = 0) alike,
// and lose no digits however thin the layer and however large the planet, since r - r_a is never
// computed as a difference of radii. The only singularity, e = -1, is far from e >= 0.
//
// Real is double or Lanes: the same formulas give the same bits for both.
#if defined(SKYBAKE_BAKERS_ATMOSPHERE_OPTICAL_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_ATMOSPHERE_OPTICAL_DEPTH_INL_H_
#undef SKYBAKE_BAKERS_ATMOSPHERE_OPTICAL_DEPTH_INL_H_
#else
#define SKYBAKE_BAKERS_ATMOSPHERE_OPTICAL_DEPTH_INL_H_
#endif

#include "bakers/air/medium.h"
#include "bakers/air/quadrature_rules.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The lower end of a climb.
template <class Real>
struct ClimbStart {
    Real altitude_km;
    Real r_km;  // > 0
    Real s_km;  // in [0, r_km]
};

// Returns the length of the climb through `gain_km`: the positive root x of x (x + 2 s) = c (c + 2
// r).
template <class Real>
HWY_INLINE Real climb_length(Real r_km, Real s_km, Real gain_km) {
    const Real q = gain_km * (r_km + r_km + gain_km);
    const Real length = q / (square_root(s_km * s_km + q) + s_km);
    return select(q > Real(0.0), length, Real(0.0));  // 0 / 0 for no gain from the nearest point
}

// Returns the column of exp(-h / H) by Gauss-Legendre panels in e. The panels end where the density
// has fallen by kClimbPanelEnds scale heights, and 1 + e grows at most fourfold in each. The
// relative error is about 1e-14 for planets like Earth, and below 2e-11 where the air is at least
// as deep as the planet is large.
template <class Real>
HWY_INLINE Real exponential_column(const ClimbStart<Real>& start, Real gain_km,
                                   double scale_height_km) {
    const Real z = start.s_km + start.r_km;
    const Real y = start.r_km - start.s_km;
    const Real s2 = start.s_km + start.s_km;
    const Real per_scale_height(1.0 / scale_height_km);
    Real sum(0.0);
    Real e(0.0);
    for (const double panel_end : kClimbPanelEnds) {
        const Real c = minimum(gain_km, Real(panel_end * scale_height_km));
        const Real end = (climb_length(start.r_km, start.s_km, c) + c) / z;
        while (any(e < end)) {
            const Real next = minimum(end, Real(4.0) * e + Real(3.0));
            const Real width = maximum(next - e, Real(0.0));
            Real panel(0.0);
            for (int j = 0; j < kClimbNodes; ++j) {
                const Real x = e + width * Real(climb_rule().nodes[j]);
                const Real inverse = Real(1.0) / (Real(1.0) + x);
                const Real climbed = Real(0.5) * x * (s2 + z * x) * inverse;
                const Real ds = z + y * (inverse * inverse);
                panel = panel + Real(climb_rule().half_weights[j]) * ds *
                                    exponential(-climbed * per_scale_height);
            }
            sum = sum + width * panel;
            e = maximum(e, next);
        }
    }
    return sum * exponential(-start.altitude_km * per_scale_height);
}

// The part of a climb within a piece's altitudes.
template <class Real>
struct PieceClimb {
    Real length;
    Real climbed;  // integral of the gain of altitude since the piece's lower end
    Real gain;     // of altitude, >= 0
};

// Returns sum_k k / (2 k + 1) z^(k - 1) for k = 1 to kTerms, in two chains.
template <int kTerms, class Real>
HWY_INLINE Real climb_series(Real z) {
    const Real square = z * z;
    Real odd(kTerms / (2.0 * kTerms + 1.0));
    Real even((kTerms - 1) / (2.0 * kTerms - 1.0));
    for (int k = kTerms - 2; k >= 1; k -= 2) odd = odd * square + Real(k / (2.0 * k + 1.0));
    for (int k = kTerms - 3; k >= 2; k -= 2) even = even * square + Real(k / (2.0 * k + 1.0));
    return odd + z * even;
}

// Returns sinh(theta) - theta, given w = tanh(theta / 2), sinh(theta) and e^theta as a quotient.
template <class Real>
HWY_INLINE Real sinh_minus_argument(Real w, Real sinh_theta, Real dividend, Real divisor) {
    // 2 w / (1 - w^2) - 2 artanh(w) = 4 w^3 sum_k k / (2 k + 1) w^(2 k - 2) is a sum of positive
    // terms: up to w = 1/16, 7 of them are all that a double shows, up to 1/4, 13. Beyond, the
    // difference itself loses less than five bits.
    const Real z = w * w;
    const Real cube = Real(4.0) * w * z;
    const Real of_few = cube * climb_series<7>(z);
    const auto many = w > Real(1.0 / 16);
    if (!any(many)) return of_few;
    const Real series = select(many, cube * climb_series<13>(z), of_few);
    const auto large = w > Real(0.25);
    if (!any(large)) return series;
    return select(large, sinh_theta - logarithm(dividend / divisor), series);
}

// Returns the climb between gains `low` and `high` from its start, where s is `s_low` and `s_high`.
// With theta = ln(1 + e),
//
//   integral of (r - r_a) ds = r^2 f1 + r s f2 + s^2 f3,
//   f1 = integral of (cosh - 1) cosh = (S C - d) / 2,   f2 = (C^2 + S^2) / 2,   f3 = (S C + d) / 2,
//   S = sinh theta, C = cosh theta - 1, d = sinh theta - theta,
//
// which is 1/2 [s r + p^2 arsinh(s / p)] - r_a s without its cancellation. With q = r_b^2 - r_a^2 and
// D = s_a + s_b the length is q / D, and e = A / (D z) with A = q + (r_b - r_a) D. All quotients share
// one division. The relative error is below 1e-14.
template <class Real>
HWY_INLINE PieceClimb<Real> climb_between(const ClimbStart<Real>& start, Real low, Real high,
                                          Real s_low, Real s_high) {
    const Real r = start.r_km + low;
    const Real c = high - low;
    const Real q = c * (r + r + c);
    const Real sum_of_s = s_low + s_high;
    const Real a = q + c * sum_of_s;
    const Real z = s_low + r;
    const Real m = sum_of_s * z;
    const Real grown = m + a;  // (1 + e) m
    const Real zg = z * grown;
    const Real twice = grown + m;  // (2 + e) m
    const Real inverse = Real(1.0) / (sum_of_s * zg * twice);
    const Real w = a * sum_of_s * zg * inverse;           // e / (2 + e)
    const Real half = Real(0.5) * a * (twice * inverse);  // e / (2 (1 + e)) / m
    const Real big_s = half * twice;
    const Real big_c = half * a;
    const Real d = sinh_minus_argument(w, big_s, grown, m);
    const Real product = big_s * big_c;
    const Real climbed =
        Real(0.5) * (r * r * (product - d) + r * s_low * (big_c * big_c + big_s * big_s) +
                     s_low * s_low * (product + d));
    // 0 / 0 for no gain from the nearest point.
    const auto climbs = c > Real(0.0);
    const Real zero(0.0);
    return {select(climbs, q * zg * twice * inverse, zero), select(climbs, climbed, zero), c};
}

// Returns the column of a linear piece of density over its part of a climb.
template <class Real>
HWY_INLINE Real linear_piece_column(const ClimbStart<Real>& start, Real gain_km,
                                    const PieceClimb<Real>& climb, const LinearPiece& piece) {
    if (piece.density_per_km == 0) return Real(piece.density_at_bottom) * climb.length;
    const Real zero(0.0);
    const Real slope(piece.density_per_km < 0 ? -piece.density_per_km : piece.density_per_km);
    // The density is measured from the end where it is smaller, so that no term is negative.
    if (piece.density_per_km > 0) {
        const Real rising = Real(piece.density_at_bottom) +
                            slope * maximum(start.altitude_km - Real(piece.bottom_km), zero);
        return rising * climb.length + slope * climb.climbed;
    }
    const Real falling = Real(piece.density_at_top) +
                         slope * maximum(Real(piece.top_km) - (start.altitude_km + gain_km), zero);
    return falling * climb.length + slope * (climb.gain * climb.length - climb.climbed);
}

// The climbs through the pieces of layers. Neighbouring pieces share a square root, and later tables
// share the climbs of the first one where they have its altitudes.
template <class Real>
class PieceClimbs {
  public:
    HWY_INLINE PieceClimbs(const ClimbStart<Real>& start, Real gain_km)
        : start_(start), gain_km_(gain_km) {}

    HWY_INLINE void begin_layer() {
        is_first_ = count_ < kLeast;
        if (is_first_) count_ = 0;
        next_ = 0;
    }

    // The pieces of a layer must come in ascending order. Returns false if the climb does not touch
    // the piece.
    HWY_INLINE bool find(const LinearPiece& piece, PieceClimb<Real>& climb) {
        while (!is_first_ && next_ < count_ && bottoms_km_[next_] < piece.bottom_km) ++next_;
        if (!is_first_ && next_ < count_ && bottoms_km_[next_] == piece.bottom_km &&
            tops_km_[next_] == piece.top_km) {
            climb = climbs_[next_];
            return true;
        }
        const Real low = gain_at(piece.bottom_km);
        const Real high = gain_at(piece.top_km);
        if (!any(high > low)) return false;
        const Real s_low = piece.bottom_km == s_at_km_ ? s_ : s_at(low);
        s_ = s_at(high);
        s_at_km_ = piece.top_km;
        climb = climb_between(start_, low, high, s_low, s_);
        if (!is_first_ || count_ == kMost) return true;
        bottoms_km_[count_] = piece.bottom_km;
        tops_km_[count_] = piece.top_km;
        climbs_[count_++] = climb;
        return true;
    }

  private:
    static constexpr std::size_t kLeast = 3;  // pieces of a table; slabs and tents have fewer
    static constexpr std::size_t kMost = 48;

    HWY_INLINE Real gain_at(double altitude_km) const {
        return minimum(maximum(Real(altitude_km) - start_.altitude_km, Real(0.0)), gain_km_);
    }
    HWY_INLINE Real s_at(Real gain_km) const {
        return square_root(start_.s_km * start_.s_km +
                           gain_km * (start_.r_km + start_.r_km + gain_km));
    }

    const ClimbStart<Real>& start_;
    Real gain_km_;
    Real s_ = Real(0.0);  // at the top of the piece before
    double s_at_km_ = -1;
    bool is_first_ = true;
    std::size_t count_ = 0;
    std::size_t next_ = 0;
    double bottoms_km_[kMost];
    double tops_km_[kMost];
    PieceClimb<Real> climbs_[kMost];
};

// Adds the optical depth of a climb to tau[0] to tau[channels - 1].
template <class Real>
HWY_INLINE void add_climb(const Medium& medium, const ClimbStart<Real>& start, Real gain_km,
                          Real* tau) {
    const auto add = [&](Real column, const Spectrum& extinction_per_km) HWY_ATTR {
        for (int c = 0; c < medium.channels; ++c) {
            tau[c] = tau[c] + column * Real(extinction_per_km[static_cast<std::size_t>(c)]);
        }
    };
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        add(exponential_column(start, gain_km, layer.scale_height_km), layer.extinction_per_km);
    }
    PieceClimbs<Real> climbs(start, gain_km);
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        Real column(0.0);
        climbs.begin_layer();
        for (const LinearPiece& piece : layer.pieces) {
            PieceClimb<Real> climb;
            if (!climbs.find(piece, climb)) continue;
            column = column + linear_piece_column(start, gain_km, climb, piece);
        }
        add(column, layer.extinction_per_km);
    }
}

// Returns drop_to_nearest_km (ray.h) of a ray with s <= 0.
template <class Real>
HWY_INLINE Real drop_to_nearest(Real r_km, Real s_km) {
    return s_km * s_km / (r_km + square_root((r_km - s_km) * (r_km + s_km)));
}

// Computes the optical depth from (altitude, s = r mu) to the top of the shell. The ray must not
// hit the ground. A downward ray is twice the climb from its lowest point to its start, plus the
// climb from there to the top.
template <class Real>
HWY_INLINE void optical_depth_to_top(const Medium& medium, Real altitude_km, Real s_km, Real* tau) {
    const Real zero(0.0);
    const Real r = altitude_km + Real(medium.ground_radius_km);
    for (int c = 0; c < medium.channels; ++c) tau[c] = zero;
    if (any(s_km < zero)) {
        const Real drop = select(s_km < zero, drop_to_nearest(r, s_km), zero);
        const Real lowest = maximum(altitude_km - drop, zero);  // grazing rays touch the ground
        add_climb(medium, ClimbStart<Real>{lowest, r - drop, zero}, drop, tau);
        for (int c = 0; c < medium.channels; ++c) tau[c] = tau[c] + tau[c];
    }
    const Real gain = maximum(Real(medium.thickness_km) - altitude_km, zero);
    add_climb(medium, ClimbStart<Real>{altitude_km, r, absolute(s_km)}, gain, tau);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_ATMOSPHERE_OPTICAL_DEPTH_INL_H_
