#include "bakers/assets/cloud_light/texel_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "bakers/field/interpolation.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"

namespace skybake::cloud_light {
namespace {

constexpr std::array<bool, 3> kRepeats = {true, true, false};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

void clamp_all(std::vector<double>& values, const std::array<float, 2>& bounds) {
    for (double& value : values) value = std::clamp<double>(value, bounds[0], bounds[1]);
}

}  // namespace

TexelFit::TexelFit(const std::array<int, 3>& places, const std::array<int, 3>& texels,
                   std::vector<float> weights, int threads)
    : places_(places), size_(texels), weights_(std::move(weights)), threads_(threads) {
    assert(weights_.size() == occupancy::count_of(places));
    for (std::size_t a = 0; a < 3; ++a) {
        for (int i = 0; i < places[a]; ++i) {
            const double at = (i + 0.5) * texels[a] / places[a] - 0.5;
            const double low = std::floor(at);
            lookups_[a].push_back({static_cast<int>(low), static_cast<float>(at - low)});
        }
    }
    find_runs();
}

// Weights become shares of their mean, so that steps are damped alike for all clouds.
void TexelFit::find_runs() {
    double sum = 0;
    double count = 0;
    runs_.resize(static_cast<std::size_t>(places_[2]));
    for (int row = 0; row < places_[1] * places_[2]; ++row) {
        const float* weight = weights_.data() + occupancy::index_of(places_, 0, row, 0);
        std::vector<Run>& runs = runs_[static_cast<std::size_t>(row / places_[1])];
        for (int x = 0; x < places_[0]; ++x) {
            if (!(weight[x] > 0)) continue;
            if (x == 0 || !(weight[x - 1] > 0)) runs.push_back({row % places_[1], x, x});
            runs.back().last = x + 1;
            sum += double{weight[x]};
            ++count;
        }
    }
    if (count == 0) return;
    for (float& weight : weights_) weight = static_cast<float>(double{weight} * count / sum);
}

// The rows or planes of texels between which a place lies.
std::array<std::size_t, 2> TexelFit::rows_of(std::size_t axis, int place) const {
    const int low = lookups_[axis][static_cast<std::size_t>(place)].low;
    const auto at = [&](int i) {
        return static_cast<std::size_t>(kRepeats[axis] ? occupancy::wrapped(i, size_[axis])
                                                       : occupancy::clamped(i, size_[axis]));
    };
    return {at(low), at(low + 1)};
}

template <class Term>
void TexelFit::gather_run(const Texels& texels, int z, const Run& run, const Term& term,
                          std::vector<float>& plane) const {
    const auto width = static_cast<std::size_t>(size_[0]);
    const std::array<std::size_t, 2> planes = rows_of(2, z);
    const std::array<std::size_t, 2> across = rows_of(1, run.y);
    const double up = double{lookups_[2][static_cast<std::size_t>(z)].share};
    const double along = double{lookups_[1][static_cast<std::size_t>(run.y)].share};
    const auto height = static_cast<std::size_t>(size_[1]);
    const auto row = [&](std::size_t k, std::size_t j) {
        return texels.data() + (k * height + j) * width;
    };
    const std::array rows = {row(planes[0], across[0]), row(planes[0], across[1]),
                             row(planes[1], across[0]), row(planes[1], across[1])};
    const auto texel = [&](int x) {
        const auto i = static_cast<std::size_t>(occupancy::wrapped(x, size_[0]));
        const double below = rows[0][i] + along * (rows[1][i] - rows[0][i]);
        const double above = rows[2][i] + along * (rows[3][i] - rows[2][i]);
        return static_cast<float>(below + up * (above - below));
    };
    const auto add = [&](int x, float sum) {
        const auto i = static_cast<std::size_t>(occupancy::wrapped(x, size_[0]));
        const float after = static_cast<float>(along) * sum;
        plane[across[0] * width + i] += sum - after;
        plane[across[1] * width + i] += after;
    };
    const std::vector<Lookup>& lookups = lookups_[0];
    const std::size_t first_place = occupancy::index_of(places_, 0, run.y, z);
    auto x = static_cast<std::size_t>(run.first);
    int low = lookups[x].low;
    float left = texel(low);
    float left_sum = 0;
    while (x < static_cast<std::size_t>(run.last)) {
        const float right = texel(low + 1);
        float right_sum = 0;
        for (; x < static_cast<std::size_t>(run.last) && lookups[x].low == low; ++x) {
            const float share = lookups[x].share;
            const float value = term(first_place + x, left + share * (right - left));
            left_sum += value - share * value;
            right_sum += share * value;
        }
        add(low, left_sum);
        left = right;
        left_sum = right_sum;
        ++low;
    }
    add(low, left_sum);
}

template <class Term>
TexelFit::Texels TexelFit::gathered(const Texels& texels, const Term& term) const {
    const std::size_t plane =
        static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]);
    std::vector<std::vector<float>> planes(runs_.size());
    parallel_for(places_[2], threads_, [&](int z) {
        const auto at = static_cast<std::size_t>(z);
        if (!runs_[at].empty()) planes[at].assign(plane, 0.0F);
        for (const Run& run : runs_[at]) gather_run(texels, z, run, term, planes[at]);
    });
    Texels sums(texels.size());
    for (std::size_t z = 0; z < planes.size(); ++z) {
        if (planes[z].empty()) continue;
        const double share = double{lookups_[2][z].share};
        const auto [lower, upper] = rows_of(2, static_cast<int>(z));
        for (std::size_t i = 0; i < plane; ++i) {
            const double sum = double{planes[z][i]};
            sums[lower * plane + i] += sum - share * sum;
            sums[upper * plane + i] += share * sum;
        }
    }
    return sums;
}

TexelFit::Texels TexelFit::centers(const std::vector<float>& values) const {
    Texels texels(occupancy::count_of(size_));
    parallel_for(size_[2], threads_, [&](int z) {
        for (int y = 0; y < size_[1]; ++y) {
            for (int x = 0; x < size_[0]; ++x) {
                double& texel = texels[occupancy::index_of(size_, x, y, z)];
                const std::array<double, 3> center = {(x + 0.5) / size_[0], (y + 0.5) / size_[1],
                                                      (z + 0.5) / size_[2]};
                for (const VoxelTap& tap : trilinear_taps(places_, center, kRepeats)) {
                    texel += tap.weight * double{values[occupancy::index_of(
                                              places_, tap.voxel[0], tap.voxel[1], tap.voxel[2])]};
                }
            }
        }
    });
    return texels;
}

// Between the whole depth, by which sunlight passes, and the share of it (cloud_scattering.h) that a
// march with radiance takes: texels for the one alone are a tenth worse for the other.
constexpr double kShare = 0.6;

TexelFit::Misses TexelFit::misses(const Texels& texels, const std::vector<float>& values,
                                  ShownAs shown) const {
    Misses found;
    std::vector<float> missed(weights_.size());
    if (shown == ShownAs::sunlight) found.weights.resize(weights_.size());
    found.sums = gathered(texels, [&](std::size_t place, float lookup) {
        const double weight = double{weights_[place]};
        double miss = double{values[place]} - double{lookup};
        double slope = 1;
        if (shown == ShownAs::sunlight) {
            const double passes = exponential(-kShare * double{lookup});
            miss = exponential(-kShare * double{values[place]}) - passes;
            slope = -kShare * passes;
            found.weights[place] = static_cast<float>(weight * slope * slope);
        }
        missed[place] = static_cast<float>(std::sqrt(weight) * miss);
        return static_cast<float>(weight * slope * miss);
    });
    for (const float miss : missed) found.squares += double{miss} * double{miss};
    return found;
}

// Where weights say little texels stay near those before the step. Each is held by a share of the weight
// that as many places have on average; ten times as much or as little misses by up to a tenth more.
TexelFit::Texels TexelFit::step(const Misses& misses, const Watch& goes_on) const {
    constexpr double kHeld = 0.003;
    constexpr int kMostTurns = 40;
    constexpr double kRest = 1e-4;  // of squares
    const std::vector<float>& weights = misses.weights.empty() ? weights_ : misses.weights;
    const double held =
        kHeld * static_cast<double>(weights.size()) / static_cast<double>(misses.sums.size());
    const auto pressed = [&](const Texels& texels) {
        Texels sums = gathered(
            texels, [&](std::size_t place, float lookup) { return weights[place] * lookup; });
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += held * texels[i];
        return sums;
    };
    const Texels scale = pressed(Texels(misses.sums.size(), 1.0));
    Texels rest = misses.sums;
    Texels result(rest.size());
    Texels scaled(rest.size());
    const auto rescale = [&] {
        for (std::size_t i = 0; i < rest.size(); ++i) scaled[i] = rest[i] / scale[i];
        return dot(rest, scaled);
    };
    double squares = rescale();
    const double enough = kRest * squares;
    Texels direction = scaled;
    const double first = squares;
    for (int turn = 0; turn < kMostTurns && squares > enough; ++turn) {
        // Squares fall by about the same factor with each turn.
        const double by_turns = double{1} * turn / kMostTurns;
        if (!goes_on(std::max(by_turns, logarithm(squares / first) / logarithm(kRest)))) break;
        const Texels along = pressed(direction);
        const double length = squares / dot(direction, along);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            result[i] += length * direction[i];
            rest[i] -= length * along[i];
        }
        const double before = std::exchange(squares, rescale());
        for (std::size_t i = 0; i < rest.size(); ++i) {
            direction[i] = scaled[i] + squares / before * direction[i];
        }
    }
    return result;
}

std::vector<float> TexelFit::fit(const std::vector<float>& values, ShownAs shown,
                                 const std::array<float, 2>& bounds, const Watch& goes_on) const {
    constexpr int kSteps = 4;
    constexpr double kGain = 0.99;  // of squares; a step that gains less is the last
    Texels texels = centers(values);
    clamp_all(texels, bounds);
    if (size_ != places_) {
        Misses before = misses(texels, values, shown);
        for (int i = 0; i < kSteps && before.squares > 0; ++i) {
            Texels next = step(before, [&](double share) { return goes_on((i + share) / kSteps); });
            for (std::size_t t = 0; t < next.size(); ++t) next[t] += texels[t];
            clamp_all(next, bounds);
            Misses after = misses(next, values, shown);
            if (!(after.squares < before.squares)) break;
            texels = std::move(next);
            const bool is_last = after.squares > kGain * before.squares;
            before = std::move(after);
            if (is_last) break;
        }
    }
    return {texels.begin(), texels.end()};
}

}  // namespace skybake::cloud_light
