// Arithmetic of fields, and the guesses of a fixed point that follow from the last few (Anderson 1965; Walker & Ni
// 2011).
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "bakers/assets/cloud_light/radiance_sweep.h"
#include "bakers/math/bake_options.h"

namespace skybake::cloud_light {

// Sums of products in an order that does not depend on the number of threads.
double inner_product(const CellFields& a, const CellFields& b, const BakeOptions& options);

// to = use(a, b), number by number.
template <class Use>
void combine(const CellFields& a, const CellFields& b, CellFields& to, const BakeOptions& options,
             const Use& use) {
    for_each_plane(to, options, [&](int z) {
        for_each_row(to, [&](std::size_t c, int y) {
            const float* of_a = a.row(c, z, y);
            const float* of_b = b.row(c, z, y);
            float* row = to.row(c, z, y);
            for (int x = 0; x < to.size()[0]; ++x) row[x] = use(of_a[x], of_b[x]);
        });
    });
}

// A guess and how the next one differs from it.
struct Guess {
    CellFields light;
    CellFields change;
};

class AndersonGuesses {
  public:
    // `options` must outlive it.
    explicit AndersonGuesses(const BakeOptions& options) : options_(options) {}

    // Returns light + change of the combination of guesses, whose weights add up to 1, that has the least change.
    // Its own change is yet to be written.
    Guess next(Guess guess);

  private:
    std::vector<double> least_change() const;
    void combine_into(const std::vector<double>& weights, CellFields& light) const;

    const BakeOptions& options_;
    std::deque<Guess> guesses_;
    std::deque<std::deque<double>> products_;
};

}  // namespace skybake::cloud_light
