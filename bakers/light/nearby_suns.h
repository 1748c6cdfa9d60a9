// The solved light that one point of a view ray sends along it, for any sun. Sums that do not depend
// on the sun are evaluated once for each column of the sun axis.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bakers/light/solver/solved_light.h"

namespace skybake {

class NearbySuns {
  public:
    // `factors` multiply the moments up to `degree`, by moment_index: what the layers scatter per km
    // times their phase functions' moments and the view's harmonic. `light` must outlive this object.
    NearbySuns(const SolvedLight& light, int degree, LevelPlace at, std::vector<Spectrum> factors);

    // Returns the same as SolvedOrders::scattered, except for rounding. One thread at a time.
    Spectrum scattered(double sun_cos_zenith, double azimuth_cosine);

  private:
    std::size_t orders() const { return static_cast<std::size_t>(degree_) + 1; }

    const SolvedLight& light_;
    int degree_;
    LevelPlace at_;
    std::vector<Spectrum> factors_;
    std::vector<bool> known_;
    std::unique_ptr<Spectrum[]> values_;  // [column * orders + m], of known columns
};

}  // namespace skybake
