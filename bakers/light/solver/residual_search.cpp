#include "bakers/light/solver/residual_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace skybake {
namespace {

using PerChannel = std::array<double, kChannelSlots>;

constexpr PerChannel kOne = {1, 1, 1, 1};
constexpr PerChannel kMinusOne = {-1, -1, -1, -1};

// Below this share of a channel's brightest light errors are shares of that.
constexpr double kDarkest = 1e-12;
// Deep in dense air light is still nothing when the search begins: below this share of the brightest
// level under the same sun, errors are shares of that.
constexpr double kDeepest = 1e-3;
// Directions that are kept.
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

PerChannel scaled_dot(const LightField& a, const LightField& b, const LightScale& scale) {
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

// to += factor * from
void add_multiple(const LightField& from, const PerChannel& factor, LightField& to) {
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

PerChannel norm(const LightField& field, const LightScale& scale) {
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

    // Returns the factors of the directions; those that a channel has no need of are 0.
    std::vector<double> solve() const {
        std::vector<double> x(columns.size());
        for (std::size_t i = columns.size(); i-- > 0;) {
            double sum = right[i];
            for (std::size_t j = i + 1; j < columns.size(); ++j) sum -= columns[j][i] * x[j];
            x[i] = columns[i][i] > 0 ? sum / columns[i][i] : 0;
        }
        return x;
    }

    // Returns the residual in terms of the directions: what the right-hand side still holds below
    // the triangle, turned back.
    std::vector<double> residual() const {
        std::vector<double> left(right.size());
        left.back() = right.back();
        for (std::size_t i = columns.size(); i-- > 0;) {
            left[i] = -sines[i] * left[i + 1];
            left[i + 1] *= cosines[i];
        }
        return left;
    }
};

double root_of_points(const LightScale& scale) {
    return std::sqrt(static_cast<double>(scale.size()));
}

}  // namespace

LightScale resolved_light(const LightField& light) {
    const std::size_t size = light.sun_size();
    LightScale scale;
    for (std::size_t i = 0; i < light.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) scale.push_back(light.moments[i + c]);
    }
    scale.insert(scale.end(), light.sky_irradiance.begin(), light.sky_irradiance.end());
    PerChannel brightest{};
    for (std::size_t i = 0; i < scale.size(); ++i) {
        brightest[i % kChannelSlots] = std::max(brightest[i % kChannelSlots], scale[i]);
    }
    const std::size_t suns = static_cast<std::size_t>(light.suns) * kChannelSlots;
    for (std::size_t i = 0; i < suns; ++i) {
        double least = kDarkest * brightest[i % kChannelSlots];
        for (std::size_t k = i; k < scale.size(); k += suns) {
            least = std::max(least, kDeepest * scale[k]);
        }
        for (std::size_t k = i; k < scale.size(); k += suns) {
            scale[k] = std::max(scale[k], least);
        }
    }
    return scale;
}

LightScale light_scale(const LightField& light) {
    LightScale scale = resolved_light(light);
    std::ranges::replace(scale, 0.0, 1.0);
    return scale;
}

LightField residual_of(const LightField& first, const NextOrder& next, const LightField& light) {
    LightField residual(light.levels, light.suns, light.degree);
    next(light, residual);
    add_multiple(first, kOne, residual);
    add_multiple(light, kMinusOne, residual);
    return residual;
}

void add(const LightField& from, LightField& to) { add_multiple(from, kOne, to); }

double mean_share(const LightField& field, const LightScale& scale) {
    const PerChannel lengths = norm(field, scale);
    return *std::ranges::max_element(lengths) / root_of_points(scale);
}

double largest_share(const LightField& field, const LightScale& scale) {
    double largest = 0;
    for_each_group(field, [&](bool moments, std::size_t i, std::size_t s) {
        const double* x = moments ? field.moments.data() + i : field.sky_irradiance.data() + i;
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            largest = std::max(largest, std::fabs(x[c]) / scale[s + c]);
        }
    });
    return largest;
}

int search_residual(const NextOrder& next, const CorrectResidual& correct, const LightScale& scale,
                    const ResidualSearch& search, Progress* progress, LightField& residual,
                    LightField& light) {
    LightField image(residual.levels, residual.suns, residual.degree);
    const PerChannel length = norm(residual, scale);
    multiply(residual, inverse_or_zero(length));
    std::vector<LightField> directions = {residual};
    std::vector<LightField> corrected;
    std::array<Projection, kChannelSlots> projections;
    for (std::size_t c = 0; c < kChannelSlots; ++c) projections[c].right = {length[c]};
    bool small = false;
    while (!small && directions.size() <= kMostDirections &&
           static_cast<int>(corrected.size()) < search.most_applications &&
           !is_cancelled(progress)) {
        corrected.push_back(correct ? correct(directions.back(), scale) : directions.back());
        // The change of light by a residual like the last direction, of length 1.
        const PerChannel growth = norm(corrected.back(), scale);
        next(corrected.back(), image);
        LightField candidate = corrected.back();
        add_multiple(image, kMinusOne, candidate);  // (1 - K) direction
        std::array<std::vector<double>, kChannelSlots> columns;
        for (const LightField& direction : directions) {
            const PerChannel share = scaled_dot(direction, candidate, scale);
            add_multiple(direction, negative(share), candidate);
            for (std::size_t c = 0; c < kChannelSlots; ++c) columns[c].push_back(share[c]);
        }
        const PerChannel left = norm(candidate, scale);
        multiply(candidate, inverse_or_zero(left));
        directions.push_back(std::move(candidate));
        small = true;
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            columns[c].push_back(left[c]);
            projections[c].append(std::move(columns[c]));
            const double missing = growth[c] * std::fabs(projections[c].right.back());
            small = small && missing <= search.tolerance * root_of_points(scale);
        }
    }
    std::array<std::vector<double>, kChannelSlots> factors;
    std::array<std::vector<double>, kChannelSlots> shares;
    for (std::size_t c = 0; c < kChannelSlots; ++c) {
        factors[c] = projections[c].solve();
        shares[c] = projections[c].residual();
    }
    const auto of = [](const auto& values, std::size_t i) {
        return PerChannel{values[0][i], values[1][i], values[2][i], values[3][i]};
    };
    for (std::size_t i = 0; i < corrected.size(); ++i) {
        add_multiple(corrected[i], of(factors, i), light);
    }
    std::ranges::fill(residual.moments, 0.0);
    std::ranges::fill(residual.sky_irradiance, 0.0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        add_multiple(directions[i], of(shares, i), residual);
    }
    return static_cast<int>(corrected.size());
}

}  // namespace skybake
