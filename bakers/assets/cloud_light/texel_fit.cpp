#include "bakers/assets/cloud_light/texel_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/math/parallel.h"

namespace skybake::cloud_light {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Fits along one axis: `size` shrinks from places to texels.
std::vector<float> fit_axis(const std::vector<float>& values, std::array<int, 3>& size,
                            std::size_t axis, int texels, bool repeats, int threads) {
    const AxisFit fit(size[axis], texels, repeats);
    std::size_t apart = 1;
    for (std::size_t a = 0; a < axis; ++a) apart *= index(size[a]);
    const auto places = index(size[axis]);
    const std::size_t groups = values.size() / (apart * places);
    std::vector<float> result(groups * apart * index(texels));
    parallel_for(static_cast<int>(groups), threads, [&](int group) {
        std::vector<double> line(places);
        std::vector<double> fitted;
        for (std::size_t i = 0; i < apart; ++i) {
            const float* from = values.data() + index(group) * apart * places + i;
            for (std::size_t k = 0; k < places; ++k) line[k] = from[k * apart];
            fit.solve(line, fitted);
            float* to = result.data() + index(group) * apart * index(texels) + i;
            for (std::size_t k = 0; k < fitted.size(); ++k) {
                to[k * apart] = static_cast<float>(fitted[k]);
            }
        }
    });
    size[axis] = texels;
    return result;
}

}  // namespace

AxisFit::AxisFit(int places, int texels, bool repeats)
    : texels_(texels), same_(places == texels), diagonal_(index(texels)), beside_(index(texels)) {
    assert(places >= texels && texels >= 1);
    for (int i = 0; i < places; ++i) {
        const double at = (i + 0.5) * texels / places - 0.5;
        const int below = static_cast<int>(std::floor(at));
        const auto texel = [&](int j) {
            return repeats ? (j + texels) % texels : std::clamp(j, 0, texels - 1);
        };
        const Lookup lookup{texel(below), texel(below + 1), at - below};
        lookups_.push_back(lookup);
        diagonal_[index(lookup.low)] += (1 - lookup.share) * (1 - lookup.share);
        diagonal_[index(lookup.high)] += lookup.share * lookup.share;
        const double both = (1 - lookup.share) * lookup.share;
        if (lookup.low == lookup.high) {
            diagonal_[index(lookup.low)] += 2 * both;
        } else if (std::max(lookup.low, lookup.high) - std::min(lookup.low, lookup.high) == 1) {
            beside_[index(std::min(lookup.low, lookup.high))] += both;
        } else {
            corner_ += both;
        }
    }
    factor();
}

// With corners c the matrix is a tridiagonal one plus u v^T, u = (-d, 0 ... 0, c) and v = (1, 0 ... 0,
// -c / d), where d is its first diagonal element (Sherman and Morrison 1950; Press et al., "Numerical
// Recipes", section 2.7). The tridiagonal matrix has 2 d and the last element plus c^2 / d.
void AxisFit::factor() {
    const double first = diagonal_.front();
    if (corner_ != 0) {
        diagonal_.front() += first;
        diagonal_.back() += corner_ * corner_ / first;
    }
    factors_.assign(index(texels_), 0);
    for (int i = 1; i < texels_; ++i) {
        factors_[index(i)] = beside_[index(i - 1)] / diagonal_[index(i - 1)];
        diagonal_[index(i)] -= factors_[index(i)] * beside_[index(i - 1)];
    }
    if (corner_ == 0) return;
    wrap_.assign(index(texels_), 0);
    wrap_.front() = -first;
    wrap_.back() = corner_;
    substitute(wrap_);
    wrap_scale_ = corner_ / first;
}

void AxisFit::substitute(std::vector<double>& values) const {
    for (int i = 1; i < texels_; ++i) {
        values[index(i)] -= factors_[index(i)] * values[index(i - 1)];
    }
    values[index(texels_ - 1)] /= diagonal_[index(texels_ - 1)];
    for (int i = texels_ - 2; i >= 0; --i) {
        values[index(i)] =
            (values[index(i)] - beside_[index(i)] * values[index(i + 1)]) / diagonal_[index(i)];
    }
}

void AxisFit::solve(const std::vector<double>& values, std::vector<double>& texels) const {
    if (same_) {
        texels = values;
        return;
    }
    texels.assign(index(texels_), 0);
    for (std::size_t i = 0; i < lookups_.size(); ++i) {
        texels[index(lookups_[i].low)] += (1 - lookups_[i].share) * values[i];
        texels[index(lookups_[i].high)] += lookups_[i].share * values[i];
    }
    substitute(texels);
    if (corner_ == 0) return;
    const auto along = [&](const std::vector<double>& v) {
        return v.front() - wrap_scale_ * v.back();
    };
    const double share = along(texels) / (1 + along(wrap_));
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] -= share * wrap_[i];
}

std::vector<float> fit_texels(const std::vector<float>& values, const std::array<int, 3>& places,
                              const std::array<int, 3>& texels, const std::array<float, 2>& bounds,
                              int threads) {
    std::array<int, 3> size = places;
    std::vector<float> result = values;
    for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
        result = fit_axis(result, size, axis, texels[axis], axis < 2, threads);
    }
    for (float& texel : result) texel = std::clamp(texel, bounds[0], bounds[1]);
    return result;
}

}  // namespace skybake::cloud_light
