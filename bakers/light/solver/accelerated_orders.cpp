#include "bakers/light/solver/accelerated_orders.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace skybake {

namespace {

using PerChannel = std::array<double, kChannelSlots>;

constexpr PerChannel kOne = {1, 1, 1, 1};
constexpr PerChannel kMinusOne = {-1, -1, -1, -1};

// Below this share of a channel's brightest light errors are shares of that.
constexpr double kDarkest = 1e-12;
// A night sky without a moon, as a share of the day's.
constexpr double kStarlight = 1e-8;
// Where directions are sought, of light darker than this share of the brightest at another
// altitude.
constexpr double kDeepest = 1e-3;
// Directions that are kept before a fresh start.
constexpr std::size_t kMostDirections = 100;

// Calls visit(value index, scale index) for the first slot of each group.
template <class Visit>
void for_each_group(const LightField& field, const Visit& visit) {
    const auto groups = static_cast<std::size_t>(moment_count(field.degree));
    const std::size_t points = field.moments.size() / (groups * kChannelSlots);
    for (std::size_t p = 0; p < points; ++p) {
        for (std::size_t g = 0; g < groups; ++g) {
            visit(true, (p * groups + g) * kChannelSlots, p * kChannelSlots);
        }
    }
    const std::size_t suns = field.sky_irradiance.size() / kChannelSlots;
    for (std::size_t i = 0; i < suns; ++i) {
        visit(false, i * kChannelSlots, (points + i) * kChannelSlots);
    }
}

// The mean light at each point, then the sky's irradiance for each sun: what errors are shares of.
std::vector<double> brightness(const LightField& field) {
    const std::size_t size = field.sun_size();
    std::vector<double> values;
    for (std::size_t i = 0; i < field.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) values.push_back(field.moments[i + c]);
    }
    values.insert(values.end(), field.sky_irradiance.begin(), field.sky_irradiance.end());
    return values;
}

// As a scale: not below kDarkest of the channel's brightest, so that it divides.
std::vector<double> scale_of(const LightField& field) {
    std::vector<double> scale = brightness(field);
    PerChannel brightest{};
    for (std::size_t i = 0; i < scale.size(); ++i) {
        brightest[i % kChannelSlots] = std::max(brightest[i % kChannelSlots], scale[i]);
    }
    for (std::size_t i = 0; i < scale.size(); ++i) {
        const double least = kDarkest * brightest[i % kChannelSlots];
        scale[i] = std::max(scale[i], least > 0 ? least : 1.0);
    }
    return scale;
}

PerChannel scaled_dot(const LightField& a, const LightField& b, const std::vector<double>& scale) {
    PerChannel sum{};
    for_each_group(a, [&](bool moments, std::size_t i, std::size_t s) {
        const double* x = moments ? a.moments.data() + i : a.sky_irradiance.data() + i;
        const double* y = moments ? b.moments.data() + i : b.sky_irradiance.data() + i;
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            const double weight = 1 / scale[s + c];
            sum[c] += (x[c] * weight) * (y[c] * weight);
        }
    });
    return sum;
}

double largest_share(const LightField& field, const std::vector<double>& scale) {
    double largest = 0;
    for_each_group(field, [&](bool moments, std::size_t i, std::size_t s) {
        const double* x = moments ? field.moments.data() + i : field.sky_irradiance.data() + i;
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            largest = std::max(largest, std::fabs(x[c]) / scale[s + c]);
        }
    });
    return largest;
}

// to += factor * from
void add(const LightField& from, const PerChannel& factor, LightField& to) {
    for (std::size_t i = 0; i < from.moments.size(); ++i) {
        to.moments[i] += factor[i % kChannelSlots] * from.moments[i];
    }
    for (std::size_t i = 0; i < from.sky_irradiance.size(); ++i) {
        to.sky_irradiance[i] += factor[i % kChannelSlots] * from.sky_irradiance[i];
    }
}

void multiply(LightField& field, const PerChannel& factor) {
    for (std::size_t i = 0; i < field.moments.size(); ++i) {
        field.moments[i] *= factor[i % kChannelSlots];
    }
    for (std::size_t i = 0; i < field.sky_irradiance.size(); ++i) {
        field.sky_irradiance[i] *= factor[i % kChannelSlots];
    }
}

PerChannel norm(const LightField& field, const std::vector<double>& scale) {
    PerChannel squares = scaled_dot(field, field, scale);
    for (double& value : squares) value = std::sqrt(value);
    return squares;
}

PerChannel inverse_or_zero(const PerChannel& values) {
    PerChannel inverse{};
    for (std::size_t c = 0; c < values.size(); ++c) {
        if (values[c] > 0) inverse[c] = 1 / values[c];
    }
    return inverse;
}

PerChannel negative(PerChannel values) {
    for (double& value : values) value = -value;
    return values;
}

// Hessenberg's matrix of one channel, made triangular column by column, and the right-hand side.
struct Projection {
    std::vector<std::vector<double>> columns;
    std::vector<double> cosines;
    std::vector<double> sines;
    std::vector<double> right;

    void append(std::vector<double> column) {
        const std::size_t n = columns.size();
        for (std::size_t i = 0; i < n; ++i) {
            const double turned = cosines[i] * column[i] + sines[i] * column[i + 1];
            column[i + 1] = cosines[i] * column[i + 1] - sines[i] * column[i];
            column[i] = turned;
        }
        const double length = std::sqrt(column[n] * column[n] + column[n + 1] * column[n + 1]);
        cosines.push_back(length > 0 ? column[n] / length : 1);
        sines.push_back(length > 0 ? column[n + 1] / length : 0);
        column[n] = length;
        right.push_back(-sines[n] * right[n]);
        right[n] *= cosines[n];
        columns.push_back(std::move(column));
    }

    // Factors of the directions; those that a channel has no need of are 0.
    std::vector<double> solve() const {
        std::vector<double> x(columns.size());
        for (std::size_t i = columns.size(); i-- > 0;) {
            double sum = right[i];
            for (std::size_t j = i + 1; j < columns.size(); ++j) sum -= columns[j][i] * x[j];
            x[i] = columns[i][i] > 0 ? sum / columns[i][i] : 0;
        }
        return x;
    }
};

// The light itself, but not below a share of the brightest level for each sun: deep in dense air
// light is still nothing when the search begins.
std::vector<double> deep_scale(const LightField& field) {
    std::vector<double> scale = scale_of(field);
    const std::size_t suns = static_cast<std::size_t>(field.suns) * kChannelSlots;
    for (std::size_t i = 0; i < suns; ++i) {
        double least = 0;
        for (std::size_t k = i; k < scale.size(); k += suns) least = std::max(least, scale[k]);
        least *= kDeepest;
        for (std::size_t k = i; k < scale.size(); k += suns) scale[k] = std::max(scale[k], least);
    }
    return scale;
}

// What all orders after one that adds `added` to `sum` add at most, as a share of the sum, if each
// is at most the largest ratio of the last two smaller than the one before; infinite if they grow.
double tail_bound(const LightField& sum, const LightField& added, const LightField& before) {
    const std::vector<double> scale = scale_of(sum);
    const std::vector<double> last = brightness(added);
    const std::vector<double> first = brightness(before);
    double ratio = 0;
    double share = 0;
    for (std::size_t i = 0; i < last.size(); ++i) {
        share = std::max(share, last[i] / scale[i]);
        // Where orders no longer matter their ratio is that of rounding.
        if (last[i] > 1e-9 * scale[i]) ratio = std::max(ratio, last[i] / first[i]);
    }
    return ratio < 1 ? share * ratio / (1 - ratio) : std::numeric_limits<double>::infinity();
}

// The ratio of two successive orders, as the mean of their shares of the sum.
double mean_ratio(const LightField& sum, const LightField& added, const LightField& before) {
    const std::vector<double> scale = scale_of(sum);
    const std::vector<double> last = brightness(added);
    const std::vector<double> first = brightness(before);
    PerChannel of_last{};
    PerChannel of_first{};
    for (std::size_t i = 0; i < last.size(); ++i) {
        of_last[i % kChannelSlots] += last[i] / scale[i];
        of_first[i % kChannelSlots] += first[i] / scale[i];
    }
    double ratio = 0;
    for (std::size_t c = 0; c < kChannelSlots; ++c) {
        if (of_first[c] > 0) ratio = std::max(ratio, of_last[c] / of_first[c]);
    }
    return ratio;
}

// The search resolves light down to kDarkest of the brightest; less than nothing there is rounding
// of brighter light elsewhere, and in truth nothing that could be told.
void drop_less_than_nothing(LightField& light) {
    const std::size_t size = light.sun_size();
    PerChannel brightest{};
    for (std::size_t i = 0; i < light.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            brightest[c] = std::max(brightest[c], light.moments[i + c]);
        }
    }
    for (std::size_t i = 0; i < light.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            const double mean = light.moments[i + c];
            if (mean >= 0 || -mean > kStarlight * brightest[c]) continue;
            for (std::size_t k = i + c; k < i + size; k += kChannelSlots) light.moments[k] = 0;
        }
    }
    for (double& value : light.sky_irradiance) value = std::max(value, 0.0);
}

// Adds to sum.light what is missing by the best combination of directions that start with the
// residual, until that is below `mean_residual` of the light on average.
void search_directions(const NextOrder& next, LightField residual, const std::vector<double>& scale,
                       double mean_residual, int most_applications, Progress* progress,
                       OrderSum& sum) {
    const double enough = mean_residual * std::sqrt(static_cast<double>(scale.size()));
    LightField image(residual.levels, residual.suns, residual.degree);
    const PerChannel length = norm(residual, scale);
    multiply(residual, inverse_or_zero(length));
    std::vector<LightField> directions = {std::move(residual)};
    std::array<Projection, kChannelSlots> projections;
    for (std::size_t c = 0; c < kChannelSlots; ++c) projections[c].right = {length[c]};
    bool small = false;
    while (!small && directions.size() <= kMostDirections && sum.applications < most_applications &&
           !(progress && progress->cancelled())) {
        const std::size_t n = directions.size();
        next(directions.back(), image);
        ++sum.applications;
        LightField candidate = directions.back();
        add(image, kMinusOne, candidate);  // (1 - K) direction
        std::array<std::vector<double>, kChannelSlots> columns;
        for (std::size_t i = 0; i < n; ++i) {
            const PerChannel share = scaled_dot(directions[i], candidate, scale);
            add(directions[i], negative(share), candidate);
            for (std::size_t c = 0; c < kChannelSlots; ++c) columns[c].push_back(share[c]);
        }
        const PerChannel left = norm(candidate, scale);
        multiply(candidate, inverse_or_zero(left));
        directions.push_back(std::move(candidate));
        small = true;
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            columns[c].push_back(left[c]);
            projections[c].append(std::move(columns[c]));
            small = small && std::fabs(projections[c].right.back()) <= enough;
        }
    }
    std::array<std::vector<double>, kChannelSlots> factors;
    for (std::size_t c = 0; c < kChannelSlots; ++c) factors[c] = projections[c].solve();
    for (std::size_t i = 0; i < factors[0].size(); ++i) {
        add(directions[i], {factors[0][i], factors[1][i], factors[2][i], factors[3][i]}, sum.light);
    }
}

}  // namespace

OrderSum sum_of_orders(const LightField& first, const NextOrder& next, const SumSettings& settings,
                       Progress* progress) {
    assert(settings.slowest_ratio <= 1);
    OrderSum sum;
    sum.light = first;
    LightField before = first;
    LightField added(first.levels, first.suns, first.degree);
    const auto cancelled = [&] { return progress && progress->cancelled(); };
    for (int order = 2; order <= settings.plain_orders && !cancelled(); ++order) {
        next(before, added);
        ++sum.applications;
        add(added, kOne, sum.light);
        sum.left_out = tail_bound(sum.light, added, before);
        if (sum.left_out <= settings.tolerance) {
            drop_less_than_nothing(sum.light);
            return sum;
        }
        std::swap(before, added);
    }
    // `before` is the last order, `added` the one before it. Orders that grow, deep in dense air,
    // do so towards the slowest mode of all, which is slower than the mean.
    const double ratio = std::min(mean_ratio(sum.light, before, added), settings.slowest_ratio);
    double mean_residual = 0.1 * settings.tolerance * (1 - ratio);
    std::vector<double> scale = deep_scale(sum.light);
    while (!cancelled()) {
        // The residual b + K x - x.
        next(sum.light, added);
        ++sum.applications;
        LightField residual = first;
        add(added, kOne, residual);
        add(sum.light, kMinusOne, residual);
        sum.left_out = largest_share(residual, scale) / (1 - ratio);
        if (sum.left_out <= settings.tolerance || sum.applications >= settings.most_applications) {
            add(residual, kOne, sum.light);
            drop_less_than_nothing(sum.light);
            return sum;
        }
        search_directions(next, std::move(residual), scale, mean_residual,
                          settings.most_applications, progress, sum);
        mean_residual *= 0.1;
        scale = deep_scale(sum.light);
    }
    return sum;
}

OrderSum sum_of_first_orders(const LightField& first, const NextOrder& next, int orders,
                             Progress* progress) {
    assert(orders >= 1);
    OrderSum sum;
    sum.light = first;
    LightField before = first;
    LightField added(first.levels, first.suns, first.degree);
    for (int order = 2; order <= orders && !(progress && progress->cancelled()); ++order) {
        next(before, added);
        ++sum.applications;
        add(added, kOne, sum.light);
        std::swap(before, added);
    }
    drop_less_than_nothing(sum.light);
    return sum;
}

}  // namespace skybake
