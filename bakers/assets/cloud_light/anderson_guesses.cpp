#include "bakers/assets/cloud_light/anderson_guesses.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace skybake::cloud_light {
namespace {

constexpr std::size_t kRemembered = 2;

std::vector<double> first_alone(std::size_t count) {
    std::vector<double> weights(count, 0.0);
    weights[0] = 1;
    return weights;
}

}  // namespace

double inner_product(const CellFields& a, const CellFields& b, const BakeOptions& options) {
    constexpr int kChains = 8;  // of additions, which do not wait for each other
    std::vector<double> sums(static_cast<std::size_t>(a.size()[2]));
    for_each_plane(a, options, [&](int z) {
        std::array<double, kChains> chains{};
        for_each_row(a, [&](std::size_t c, int y) {
            const float* of_a = a.row(c, z, y);
            const float* of_b = b.row(c, z, y);
            const int even = a.size()[0] / kChains * kChains;
            for (int x = 0; x < even; x += kChains) {
                for (int k = 0; k < kChains; ++k) {
                    chains[static_cast<std::size_t>(k)] +=
                        double{of_a[x + k]} * double{of_b[x + k]};
                }
            }
            for (int x = even; x < a.size()[0]; ++x) chains[0] += double{of_a[x]} * double{of_b[x]};
        });
        sums[static_cast<std::size_t>(z)] = std::accumulate(chains.begin(), chains.end(), 0.0);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

Guess AndersonGuesses::next(Guess guess) {
    guesses_.push_front(std::move(guess));
    products_.push_front({});
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
        products_[i].push_front(0);
        if (i > 0) products_[0].push_back(0);
    }
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
        const double product = inner_product(guesses_[0].change, guesses_[i].change, options_);
        products_[0][i] = product;
        products_[i][0] = product;
    }
    const std::vector<double> weights = least_change();
    const CellFields& like = guesses_[0].light;
    if (guesses_.size() <= kRemembered) {
        Guess made{CellFields(like.size(), like.count()), CellFields(like.size(), like.count())};
        combine_into(weights, made.light);
        return made;
    }
    combine_into(weights, guesses_.back().light);  // in the place of the oldest, which has served
    Guess made = std::move(guesses_.back());
    guesses_.pop_back();
    products_.pop_back();
    for (auto& row : products_) row.pop_back();
    return made;
}

void AndersonGuesses::combine_into(const std::vector<double>& weights, CellFields& light) const {
    for_each_plane(light, options_, [&](int z) {
        std::vector<float> sums(static_cast<std::size_t>(light.size()[0]));
        for_each_row(light, [&](std::size_t c, int y) {
            std::ranges::fill(sums, 0.0F);
            for (std::size_t i = 0; i < guesses_.size(); ++i) {
                const auto weight = static_cast<float>(weights[i]);
                const float* of_light = guesses_[i].light.row(c, z, y);
                const float* of_change = guesses_[i].change.row(c, z, y);
                for (std::size_t x = 0; x < sums.size(); ++x) {
                    sums[x] += weight * (of_light[x] + of_change[x]);
                }
            }
            std::ranges::copy(sums, light.row(c, z, y));
        });
    });
}

// Solves P w = 1 and divides by the sum. A small share of the diagonal keeps P regular.
std::vector<double> AndersonGuesses::least_change() const {
    constexpr double kRegular = 1e-10;
    const std::size_t count = guesses_.size();
    std::vector<std::vector<double>> rows(count);
    for (std::size_t i = 0; i < count; ++i) {
        rows[i].assign(products_[i].begin(), products_[i].end());
        rows[i][i] *= 1 + kRegular;
        rows[i].push_back(1);
    }
    for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t i = 0; i < count; ++i) {
            if (i == p || rows[p][p] == 0) continue;
            const double factor = rows[i][p] / rows[p][p];
            for (std::size_t k = p; k <= count; ++k) rows[i][k] -= factor * rows[p][k];
        }
    }
    std::vector<double> weights(count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        weights[i] = rows[i][i] == 0 ? 0 : rows[i][count] / rows[i][i];
        sum += weights[i];
    }
    if (!(sum > 0)) return first_alone(count);
    for (double& weight : weights) weight /= sum;
    return weights;
}

}  // namespace skybake::cloud_light
