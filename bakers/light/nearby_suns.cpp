#include "bakers/light/nearby_suns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/nearby_suns.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "bakers/light/solver/sun_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

void SendColumn(const SolvedLight& light, const LevelPlace& at, int sun, int degree,
                const Spectrum* factors, double* sent) {
    send_column(light, at, sun, degree, factors, sent);
}

void PlaceSuns(const SolvedLight& light, const PointOfRay& point, const std::vector<double>& falls,
               const SunBundle& suns, PlacedSuns& placed) {
    const SunAxis& axis = light.suns;
    const Lanes mu(point.view_cosine);
    const Lanes squared_view_sine = (Lanes(1.0) - mu) * (Lanes(1.0) + mu);
    for (std::size_t i = 0; i < static_cast<std::size_t>(suns.wanted); i += Lanes::kCount) {
        const Lanes nu = Lanes::load(suns.nu.data() + i);
        const Lanes s_km = Lanes(point.begin_radius_km) * Lanes::load(suns.sun_cosines.data() + i) +
                           Lanes(point.distance_km) * nu;
        // Suns that there are not may leave the range.
        const Lanes cosine =
            maximum(minimum(s_km * Lanes(1 / point.radius_km), Lanes(1.0)), Lanes(-1.0));
        place_on_axis(axis, light.steep, falls, maximum(cosine, Lanes(axis.darkest)),
                      placed.columns.data() + i, placed.weights.data() + 4 * i);
        const Lanes along = nu - mu * cosine;
        const Lanes squared_sines =
            squared_view_sine * ((Lanes(1.0) - cosine) * (Lanes(1.0) + cosine));
        const AzimuthRecursion<Lanes> powers(along, squared_sines, placed.orders);
        const auto of_order = [&](std::size_t m) {
            return placed.powers.data() + m * placed.room + i;
        };
        Lanes(1.0).store(of_order(0));
        if (placed.orders > 1) along.store(of_order(1));
        for (std::size_t m = 2; m < placed.orders; ++m) {
            powers
                .next(m, Lanes::load(of_order(m - 1)), Lanes::load(of_order(m - 2)),
                      m < 4 ? Lanes(0.0) : Lanes::load(of_order(m - 4)))
                .store(of_order(m));
        }
    }
}

void AddColumns(const double* rows, const PlacedSuns& placed, std::size_t count, double* sums) {
    add_columns({rows, placed.orders, placed.columns.data(), placed.weights.data(),
                 placed.powers.data(), placed.room, count},
                sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(SendColumn);
HWY_EXPORT(PlaceSuns);
HWY_EXPORT(AddColumns);

NearbySuns::NearbySuns(const SolvedLight& light, const PointOfRay& point,
                       const std::vector<Spectrum>& scattered_moments)
    : light_(light),
      point_(point),
      degree_(static_cast<int>(scattered_moments.size()) - 1),
      at_(light.level_at(point.altitude_km)),
      factors_(static_cast<std::size_t>(moment_count(degree_))),
      known_(static_cast<std::size_t>(light.suns.count())),
      rows_(std::make_unique_for_overwrite<double[]>(known_.size() * orders() * kChannelSlots)) {
    std::vector<double> harmonics(factors_.size());
    harmonics_over_sines(degree_, point.view_cosine, harmonics.data());
    for (int l = 0; l <= degree_; ++l) {
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            factors_[lm] = harmonics[lm] * scattered_moments[static_cast<std::size_t>(l)];
        }
    }
    if (std::ranges::none_of(light.steep, [](double steep) { return steep > 0; })) return;
    double darker = light.mean_of(at_, 0);
    for (int k = 1; k < light.suns.count(); ++k) {
        const double brighter = light.mean_of(at_, k);
        falls_.push_back(fall_between(darker, brighter));
        darker = brighter;
    }
}

void NearbySuns::add(const SunBundle& suns, double* sums) {
    const auto wanted = static_cast<std::size_t>(suns.wanted);
    placed_.orders = orders();
    placed_.room = static_cast<std::size_t>(suns.count);
    placed_.columns.resize(placed_.room);
    placed_.weights.resize(4 * placed_.room);
    placed_.powers.resize(orders() * placed_.room);
    HWY_DYNAMIC_DISPATCH(PlaceSuns)(light_, point_, falls_, suns, placed_);
    for (std::size_t i = 0; i < wanted; ++i) {
        const auto first = static_cast<std::size_t>(placed_.columns[i]);
        for (std::size_t column = first; column < first + 4; ++column) {
            if (known_[column]) continue;
            known_[column] = true;
            HWY_DYNAMIC_DISPATCH(SendColumn)
            (light_, at_, static_cast<int>(column), degree_, factors_.data(),
             rows_.get() + column * orders() * kChannelSlots);
        }
    }
    HWY_DYNAMIC_DISPATCH(AddColumns)(rows_.get(), placed_, wanted, sums);
}

}  // namespace skybake
#endif  // HWY_ONCE
