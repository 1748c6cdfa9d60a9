// The functions of sun_axis.h for vectors of suns: their places between the columns of an axis.
//
// The weights here share their products, and multiplications replace the divisions by the axis's
// width. They therefore differ from sun_stencil's by rounding, and replacing one by the other would
// change the last bits of assets.
#if defined(SKYBAKE_BAKERS_LIGHT_SUN_AXIS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYBAKE_BAKERS_LIGHT_SUN_AXIS_INL_H_
#undef SKYBAKE_BAKERS_LIGHT_SUN_AXIS_INL_H_
#else
#define SKYBAKE_BAKERS_LIGHT_SUN_AXIS_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// Replaces the weights of those suns of a vector whose stencils are steep. Such suns are rare, so
// this is a function of its own, out of the way of the others. `falls` are between all columns
// (steep_weights).
HWY_NOINLINE inline void place_steep(const std::vector<double>& steep,
                                     const std::vector<double>& falls, Lanes fractions,
                                     const std::int64_t* columns, double* weights) {
    double beyond[Lanes::kCount];
    fractions.store(beyond);
    for (std::size_t k = 0; k < Lanes::kCount; ++k) {
        const auto first = static_cast<int>(columns[k]);
        if (!(steep[static_cast<std::size_t>(first)] > 0)) continue;
        steep_weights(beyond[k] + 1, falls.data() + first, weights + 4 * k);
    }
}

// Computes SolvedLight::stencil for a vector of suns with cosines in [axis.darkest, 1]: the first
// of four columns for each sun, and the four weights, sun by sun.
HWY_INLINE void place_on_axis(const SunAxis& axis, const std::vector<double>& steep,
                              const std::vector<double>& falls, Lanes cosines,
                              std::int64_t* columns, double* weights) {
    const hn::ScalableTag<std::int64_t> integers;
    const Lanes x = (cosines - Lanes(axis.centre)) * Lanes(1 / axis.width);
    const Lanes u = Lanes(axis.offset) + Lanes(axis.even) * cosines +
                    Lanes(axis.dense) * (x / square_root(Lanes(1.0) + x * x));
    const Lanes below = floor_of(u) - Lanes(1.0);
    const Lanes column =
        minimum(maximum(below, Lanes(0.0)), Lanes(static_cast<double>(axis.count() - 4)));
    const auto index = hn::ConvertTo(integers, column.v);
    hn::StoreU(index, integers, columns);
    const Lanes t = u - column - Lanes(1.0);
    const Lanes before = t - Lanes(1.0);
    const Lanes after = t + Lanes(1.0);
    const Lanes far = Lanes(2.0) - t;
    const Lanes inner = after * far;
    const Lanes outer = t * before;
    const Lanes w0 = outer * far * Lanes(1.0 / 6);
    const Lanes w1 = Lanes(0.0) - inner * before * Lanes(0.5);
    const Lanes w2 = inner * t * Lanes(0.5);
    const Lanes w3 = outer * after * Lanes(1.0 / 6);
    hn::StoreInterleaved4(w0.v, w1.v, w2.v, w3.v, Lanes::Tag(), weights);
    if (any(Lanes(hn::GatherIndex(Lanes::Tag(), steep.data(), index)) > Lanes(0.0))) {
        place_steep(steep, falls, t, columns, weights);
    }
}

// The recursion of sine^sine_power(m) cos(m phi) over m, from sine cos(phi) and sine^2, where the sine
// is that of a sun's zenith angle: Chebyshev's, and over every second order where powers rise no more
// (solved_light.h).
template <class Reals>
class AzimuthRecursion {
  public:
    // `orders` is the number of orders that are asked for.
    HWY_INLINE AzimuthRecursion(Reals along, Reals squared_sine, std::size_t orders)
        : twice_(along + along), squared_sine_(squared_sine), twice_cosine_(0.0) {
        if (orders <= kLargestSinePower + 1) return;
        // Twice the cosine of twice the azimuth. A sun at the zenith has none, and no light of these orders.
        const Reals squared = along * along;
        const Reals whole = maximum(maximum(squared_sine, squared), Reals(1e-30F));
        twice_cosine_ = Reals(4.0) * squared / whole - Reals(2.0);
    }
    // Returns the next order, m, from those that are one, two and four less.
    HWY_INLINE Reals next(std::size_t m, Reals less_1, Reals less_2, Reals less_4) const {
        if (m <= kLargestSinePower) return twice_ * less_1 - squared_sine_ * less_2;
        const bool rises = m <= kLargestSinePower + 2;
        return twice_cosine_ * less_2 - (rises ? squared_sine_ * less_4 : less_4);
    }

  private:
    Reals twice_;
    Reals squared_sine_;
    Reals twice_cosine_;
};

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYBAKE_BAKERS_LIGHT_SUN_AXIS_INL_H_
