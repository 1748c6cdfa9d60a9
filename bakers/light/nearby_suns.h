// The solved light that one point of a view ray scatters along it, for many suns at once. Sums that do
// not depend on the sun are evaluated once for each column of the sun axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "bakers/light/solver/solved_light.h"
#include "bakers/light/sun_bundle.h"

namespace skybake {

// Suns between the columns of a sun axis.
struct PlacedSuns {
    std::vector<std::int64_t> columns;  // for each sun, the first of its four
    std::vector<double> weights;        // [sun * 4 + k]
    // [m * room + sun]: (sine of the view sine of the sun)^sine_power(m) cos(m phi)
    std::vector<double> powers;
    std::size_t orders = 0;
    std::size_t room = 0;
};

class NearbySuns {
  public:
    // `scattering` has an entry for each layer, and `phase_moments`, [layer][l], end at a degree that is
    // at most the solution's. `light` must outlive this object.
    NearbySuns(const SolvedLight& light, const PointOfRay& point,
               const std::vector<Spectrum>& scattering,
               const std::vector<std::vector<Spectrum>>& phase_moments, int degree);

    // Adds the light under each wanted sun to sums[sun * kChannelSlots + channel]. One thread at a
    // time.
    void add(const SunBundle& suns, double* sums);

  private:
    std::size_t orders() const { return static_cast<std::size_t>(degree_) + 1; }

    const SolvedLight& light_;
    PointOfRay point_;
    int degree_;
    LevelPlace at_;
    std::vector<Spectrum> factors_;  // of the moments, by moment_index
    std::vector<double> falls_;      // between the columns' means, if a stencil is steep
    std::vector<bool> known_;
    std::unique_ptr<double[]> rows_;  // [(column * orders + m) * kChannelSlots], of known columns
    PlacedSuns placed_;               // the suns at hand
};

}  // namespace skybake
