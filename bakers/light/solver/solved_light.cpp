#include "bakers/light/solver/solved_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/solver/solved_light.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cassert>
#include <numbers>

#include "bakers/math/channels-inl.h"
#include "bakers/math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

template <class Vector>
HWY_INLINE void sum_at(const WeightedRows& rows, std::size_t i, double* sums) {
    Vector sum(0.0);
    for (std::size_t k = 0; k < rows.count; ++k) {
        sum = sum + Vector(rows.weights[k]) * Vector::load(rows.rows[k] + i);
    }
    sum.store(sums + i);
}

// Computes the weighted sums of `size` numbers of rows: whole groups of channels.
void SumRows(const WeightedRows& rows, std::size_t size, double* sums) {
    std::size_t i = 0;
    for (; i + Lanes::kCount <= size; i += Lanes::kCount) sum_at<Lanes>(rows, i, sums);
    for (; i < size; i += kChannelSlots) sum_at<Channels>(rows, i, sums);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(SumRows);

namespace {

// Factors of the associated Legendre functions' recursions: by moment_index(l, m), of the function
// before and of the one before that, and of the sectoral one of each order.
struct RecursionFactors {
    static constexpr int kDegree = 64;  // beyond that of any solution or of its reference
    std::array<double, (kDegree + 1) * (kDegree + 2) / 2> last, before;
    std::array<double, kDegree + 1> sectoral;
};

const RecursionFactors& recursion_factors() {
    static const RecursionFactors factors = [] {
        RecursionFactors made{};
        for (int m = 0; m <= RecursionFactors::kDegree; ++m) {
            made.sectoral[static_cast<std::size_t>(m)] =
                m > 0 ? std::sqrt((2.0 * m + 1) / (2.0 * m)) : 1;
            for (int l = m + 1; l <= RecursionFactors::kDegree; ++l) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                made.last[lm] = std::sqrt((4.0 * l * l - 1) / (1.0 * l * l - 1.0 * m * m));
                made.before[lm] = std::sqrt(((l - 1.0) * (l - 1.0) - 1.0 * m * m) /
                                            (4.0 * (l - 1.0) * (l - 1.0) - 1));
            }
        }
        return made;
    }();
    return factors;
}

// `factor(m)` is the ratio of the sectoral functions of orders m and m - 1, without their norms.
template <class Factor>
void harmonics(int degree, double mu, const Factor& factor, double* values) {
    // Uses the associated Legendre functions' recursions that are stable for increasing l, with
    // norms (2 - delta_m0) (2 l + 1) / 4pi (l - m)! / (l + m)!.
    assert(degree <= RecursionFactors::kDegree);
    const RecursionFactors& factors = recursion_factors();
    double sectoral = std::sqrt(0.25 / std::numbers::pi);  // l = m, normed as for m = 0
    for (int m = 0; m <= degree; ++m) {
        if (m > 0) sectoral *= factor(m) * factors.sectoral[static_cast<std::size_t>(m)];
        const double first = m > 0 ? std::numbers::sqrt2 * sectoral : sectoral;
        values[moment_index(m, m)] = first;
        double before = 0;
        double last = first;
        for (int l = m + 1; l <= degree; ++l) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            const double next = factors.last[lm] * (mu * last - factors.before[lm] * before);
            values[lm] = next;
            before = last;
            last = next;
        }
    }
}

// `mean_of` returns the mean of a column.
template <class MeanOf>
SunStencil stencil_of(const SolvedLight& light, double sun_cos_zenith, const MeanOf& mean_of) {
    const SunStencil cubic = sun_stencil(light.suns, sun_cos_zenith);
    if (!(light.steep[static_cast<std::size_t>(cubic.column)] > 0)) return cubic;
    double means[4];
    for (int j = 0; j < 4; ++j) means[j] = mean_of(cubic.column + j);
    return steep_stencil(light.suns, sun_cos_zenith, cubic.column, means);
}

double sum_of_channels(const double* values) {
    double sum = 0;
    for (std::size_t c = 0; c < kMaxChannels; ++c) sum += values[c];
    return sum;
}

}  // namespace

void zenith_harmonics(int degree, double mu, double* values) {
    assert(degree >= 0);
    const double sine = std::sqrt(std::fmax(0.0, (1 - mu) * (1 + mu)));
    harmonics(
        degree, mu, [sine](int) { return sine; }, values);
}

void harmonics_over_sines(int degree, double mu, double* values) {
    assert(degree >= 0);
    const double squared_sine = std::fmax(0.0, (1 - mu) * (1 + mu));
    const auto left = [](int m) { return m - sine_power(m); };
    const auto factor = [&](int m) { return left(m) > left(m - 1) ? squared_sine : 1.0; };
    harmonics(degree, mu, factor, values);
}

SinePowers powers_of(double sine) {
    SinePowers powers = {1};
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] * sine;
    return powers;
}

SinePowers inverse_powers_of(double sine) {
    SinePowers powers = {1};
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] / sine;
    return powers;
}

double harmonic_norm(int l, int m) {
    double squared = (m == 0 ? 1.0 : 2.0) * (2.0 * l + 1) / (4 * std::numbers::pi);
    for (int k = l - m + 1; k <= l + m; ++k) squared /= k;
    return std::sqrt(squared);
}

void copy_moments(const LightField& from, LightField& to) {
    assert(from.levels == to.levels && from.suns == to.suns);
    const std::size_t count = std::min(from.sun_size(), to.sun_size());
    for (int level = 0; level < to.levels; ++level) {
        for (int sun = 0; sun < to.suns; ++sun) {
            std::copy_n(from.at(level, sun), count, to.at(level, sun));
        }
    }
    to.sky_irradiance = from.sky_irradiance;
}

void add_light_about_sun(const std::vector<Spectrum>& light, double sun_cos_zenith,
                         double* moments) {
    const auto degree = static_cast<int>(light.size()) - 1;
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    zenith_harmonics(degree, sun_cos_zenith, harmonics.data());
    const SinePowers inverse =
        inverse_powers_of(std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith)));
    for (int m = 0; m <= degree; ++m) {
        const double factor = inverse[static_cast<std::size_t>(sine_power(m))];
        for (int l = m; l <= degree; ++l) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                moments[lm * kChannelSlots + c] +=
                    factor * harmonics[lm] * light[static_cast<std::size_t>(l)][c];
            }
        }
    }
}

LevelPlace SolvedLight::level_at(double altitude_km) const {
    const auto above = std::ranges::upper_bound(altitudes_km, altitude_km);
    const int last = static_cast<int>(altitudes_km.size()) - 2;
    const int level = std::clamp(static_cast<int>(above - altitudes_km.begin()) - 1, 0, last);
    const auto i = static_cast<std::size_t>(level);
    return {level, (altitude_km - altitudes_km[i]) / (altitudes_km[i + 1] - altitudes_km[i])};
}

double SolvedLight::mean_of(const LevelPlace& at, int column) const {
    return (1 - at.fraction) * sum_of_channels(light.at(at.level, column)) +
           at.fraction * sum_of_channels(light.at(at.level + 1, column));
}

SunStencil SolvedLight::stencil(const LevelPlace& at, double sun_cos_zenith) const {
    return stencil_of(*this, sun_cos_zenith, [&](int column) { return mean_of(at, column); });
}

WeightedRows SolvedLight::rows_at(double altitude_km, double sun_cos_zenith) const {
    const LevelPlace place = level_at(altitude_km);
    const SunStencil around = stencil(place, sun_cos_zenith);
    WeightedRows found;
    for (int side = 0; side < 2; ++side) {
        const double share = side == 0 ? 1 - place.fraction : place.fraction;
        if (share == 0) continue;
        for (int j = 0; j < 4; ++j) {
            found.weights[found.count] = share * around.weights[j];
            found.rows[found.count++] = light.at(place.level + side, around.column + j);
        }
    }
    return found;
}

Spectrum SolvedLight::moment_at(double altitude_km, double sun_cos_zenith, int l, int m) const {
    WeightedRows rows = rows_at(altitude_km, sun_cos_zenith);
    const std::size_t first = static_cast<std::size_t>(moment_index(l, m)) * kChannelSlots;
    for (std::size_t k = 0; k < rows.count; ++k) rows.rows[k] += first;
    Spectrum value{};
    HWY_DYNAMIC_DISPATCH(SumRows)(rows, kChannelSlots, data(value));
    const double sine = std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith));
    return value * powers_of(sine)[static_cast<std::size_t>(sine_power(m))];
}

void SolvedLight::moments_at(double altitude_km, double sun_cos_zenith, Spectrum* values) const {
    const SinePowers powers = powers_of(std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith)));
    HWY_DYNAMIC_DISPATCH(SumRows)
    (rows_at(altitude_km, sun_cos_zenith), light.sun_size(), data(*values));
    for (int m = 0; m <= light.degree; ++m) {
        for (int l = m; l <= light.degree; ++l) {
            values[moment_index(l, m)] *= powers[static_cast<std::size_t>(sine_power(m))];
        }
    }
}

Spectrum SolvedLight::mean_radiance_at(double altitude_km, double sun_cos_zenith) const {
    const LevelPlace place = level_at(altitude_km);
    const SunStencil around = stencil(place, sun_cos_zenith);
    Spectrum mean{};
    for (int j = 0; j < 4; ++j) {
        const Spectrum low = packet_at(light.at(place.level, around.column + j));
        const Spectrum high = packet_at(light.at(place.level + 1, around.column + j));
        mean += around.weights[j] * ((1 - place.fraction) * low + place.fraction * high);
    }
    return mean * (0.5 / std::sqrt(std::numbers::pi));
}

Spectrum SolvedLight::sky_irradiance_at(double sun_cos_zenith) const {
    const auto of_column = [this](int column) {
        return light.sky_irradiance.data() + static_cast<std::size_t>(column) * kChannelSlots;
    };
    const SunStencil around = stencil_of(
        *this, sun_cos_zenith, [&](int column) { return sum_of_channels(of_column(column)); });
    Spectrum sum{};
    for (int j = 0; j < 4; ++j) {
        sum += around.weights[j] * packet_at(of_column(around.column + j));
    }
    return sum;
}

}  // namespace skybake
#endif  // HWY_ONCE
