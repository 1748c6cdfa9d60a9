#include "bakers/light/nearby_suns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/nearby_suns.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "bakers/light/solver/sun_axis-inl.h"
#include "bakers/math/channels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The moments of one column at both levels about a point, by moment_index, and their factors.
struct ColumnOfMoments {
    const double* under;
    const double* over;
    const double* factors;
    double fraction;  // of the way from one level to the other
};

// Returns what moments send that are so many numbers behind the column's first.
template <class Vector>
HWY_INLINE Vector sent_from(const ColumnOfMoments& column, std::size_t i) {
    const Vector near(1 - column.fraction);
    const Vector far(column.fraction);
    return Vector::load(column.factors + i) *
           (near * Vector::load(column.under + i) + far * Vector::load(column.over + i));
}

// Computes what the light of one column sends, by azimuthal order: sent[m * kChannelSlots + channel].
// `factors` multiply the moments up to `degree`, by moment_index. Neighbouring orders of a degree lie beside
// each other, and wide vectors hold two.
void SendColumn(const SolvedLight& light, const LevelPlace& at, int sun, int degree,
                const Spectrum* factors, double* sent) {
    const ColumnOfMoments column = {light.light.at(at.level, sun),
                                    light.light.at(at.level + 1, sun), data(*factors), at.fraction};
    const auto slot = [](int l, int m) {
        return static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots;
    };
    int m = 0;
    if constexpr (Lanes::kCount == 2 * kChannelSlots) {
        const auto first_order = hn::FirstN(Lanes::Tag(), kChannelSlots);
        for (; m < degree; m += 2) {
            const Lanes own = sent_from<Lanes>(column, slot(m, m));
            Lanes sum = Lanes(0.0) + Lanes(hn::IfThenElseZero(first_order, own.v));
            for (int l = m + 1; l <= degree; ++l) {
                sum = sum + sent_from<Lanes>(column, slot(l, m));
            }
            sum.store(sent + static_cast<std::size_t>(m) * kChannelSlots);
        }
    }
    for (; m <= degree; ++m) {
        Channels sum(0.0);
        for (int l = m; l <= degree; ++l) sum = sum + sent_from<Channels>(column, slot(l, m));
        sum.store(sent + static_cast<std::size_t>(m) * kChannelSlots);
    }
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

// Adds the light of the first `count` suns to sums[sun * kChannelSlots + channel]. `rows` has that of
// columns: [(column * orders + m) * kChannelSlots + channel].
void AddColumns(const double* rows, const PlacedSuns& placed, std::size_t count, double* sums) {
    const std::size_t row_size = placed.orders * kChannelSlots;
    for (std::size_t i = 0; i < count; ++i) {
        const double* row = rows + static_cast<std::size_t>(placed.columns[i]) * row_size;
        const double* weights = placed.weights.data() + 4 * i;
        const Channels w0(weights[0]);
        const Channels w1(weights[1]);
        const Channels w2(weights[2]);
        const Channels w3(weights[3]);
        Channels total = Channels::load(sums + i * kChannelSlots);
        for (std::size_t m = 0; m < placed.orders; ++m) {
            const double* at = row + m * kChannelSlots;
            const Channels value =
                (w0 * Channels::load(at) + w1 * Channels::load(at + row_size)) +
                (w2 * Channels::load(at + 2 * row_size) + w3 * Channels::load(at + 3 * row_size));
            total = total + Channels(placed.powers[m * placed.room + i]) * value;
        }
        total.store(sums + i * kChannelSlots);
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(SendColumn);
HWY_EXPORT(PlaceSuns);
HWY_EXPORT(AddColumns);

NearbySuns::NearbySuns(const SolvedLight& light, const PointOfRay& point,
                       const std::vector<Spectrum>& scattering,
                       const std::vector<std::vector<Spectrum>>& phase_moments, int degree)
    : light_(light),
      point_(point),
      degree_(degree),
      at_(light.level_at(point.altitude_km)),
      factors_(static_cast<std::size_t>(moment_count(degree_))),
      known_(static_cast<std::size_t>(light.suns.count())),
      rows_(std::make_unique_for_overwrite<double[]>(known_.size() * orders() * kChannelSlots)) {
    std::vector<double> harmonics(factors_.size());
    harmonics_over_sines(degree_, point.view_cosine, harmonics.data());
    for (int l = 0; l <= degree_; ++l) {
        Spectrum scattered{};
        for (std::size_t k = 0; k < scattering.size(); ++k) {
            scattered += scattering[k] * phase_moments[k][static_cast<std::size_t>(l)];
        }
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            factors_[lm] = harmonics[lm] * scattered;
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
