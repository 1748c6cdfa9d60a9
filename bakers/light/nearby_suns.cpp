#include "bakers/light/nearby_suns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/nearby_suns.cpp"
#include <hwy/foreach_target.h>

#include <utility>

#include "bakers/light/solver/sun_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

void SendColumn(const SolvedLight& light, const LevelPlace& at, int sun, int degree,
                const Spectrum* factors, Spectrum* sent) {
    send_column(light, at, sun, degree, factors, data(*sent));
}

// Computes the light for a sun between four columns, whose values stand one after the other.
void BetweenColumns(const SunStencil& stencil, const Spectrum* columns, std::size_t orders,
                    double sun_cos_zenith, double azimuth_cosine, Spectrum& sent) {
    const SinePowers powers = powers_of(std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith)));
    Channels sum(0.0);
    double last = 1;  // cos(m phi), by Chebyshev's recursion
    double before = azimuth_cosine;
    for (std::size_t m = 0; m < orders; ++m) {
        const double* of = data(columns[m]);
        Channels light = Channels(stencil.weights[0]) * Channels::load(of);
        for (std::size_t k = 1; k < 4; ++k) {
            const Channels column = Channels::load(of + k * orders * kChannelSlots);
            light = light + Channels(stencil.weights[k]) * column;
        }
        const double power = powers[static_cast<std::size_t>(sine_power(static_cast<int>(m)))];
        sum = sum + Channels(power * last) * light;
        const double next = 2 * azimuth_cosine * last - before;
        before = last;
        last = next;
    }
    sum.store(data(sent));
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(SendColumn);
HWY_EXPORT(BetweenColumns);

NearbySuns::NearbySuns(const SolvedLight& light, int degree, LevelPlace at,
                       std::vector<Spectrum> factors)
    : light_(light),
      degree_(degree),
      at_(at),
      factors_(std::move(factors)),
      known_(static_cast<std::size_t>(light.suns.count())),
      values_(std::make_unique_for_overwrite<Spectrum[]>(known_.size() * orders())) {}

Spectrum NearbySuns::scattered(double sun_cos_zenith, double azimuth_cosine) {
    const SunStencil stencil = light_.stencil(at_, sun_cos_zenith);
    const auto first = static_cast<std::size_t>(stencil.column);
    for (std::size_t column = first; column < first + 4; ++column) {
        if (known_[column]) continue;
        known_[column] = true;
        HWY_DYNAMIC_DISPATCH(SendColumn)
        (light_, at_, static_cast<int>(column), degree_, factors_.data(),
         values_.get() + column * orders());
    }
    Spectrum sent;
    HWY_DYNAMIC_DISPATCH(BetweenColumns)
    (stencil, values_.get() + first * orders(), orders(), sun_cos_zenith, azimuth_cosine, sent);
    return sent;
}

}  // namespace skybake
#endif  // HWY_ONCE
