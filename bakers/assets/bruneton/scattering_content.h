// What a texel of a table of scattering means: which layers and orders, and which phase functions
// its light is over.
//
// A runtime multiplies R G B of `scattering` and `higher_orders` by Rayleigh's phase function at
// its own nu, A and `single_mie` by that of the (first) Mie layer. Layers that are named as Mie
// make the latter, all others the former; where they scatter otherwise than that, each one's light
// is times its own phase function over the runtime's, at the texel's nu. Higher orders are over
// Rayleigh's.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_row.h"
#include "config/assets/bruneton.h"

namespace skybake {

inline constexpr std::size_t kMostTexelChannels = 4;
using Texel = std::array<double, kMostTexelChannels>;

// The parts that a texel is a sum of, for a solar irradiance of 1.
struct ScatteringParts {
    Spectrum air{};     // of the first order, not by Mie layers, over Rayleigh's phase function
    Spectrum mie{};     // of the first order, over the phase function of the first Mie layer
    Spectrum higher{};  // over Rayleigh's phase function
};

class ScatteringContent {
  public:
    // The medium must outlive it.
    ScatteringContent(const SkyMedium& medium, const config::BrunetonBake& bake);

    std::size_t channels() const { return channels_; }
    // Those that hold light, the first ones.
    std::size_t measured_channels() const;
    bool has_alpha() const { return channels_ > colours_; }
    bool wants_single() const;
    bool wants_higher() const;

    // Of a sun of a row.
    ScatteringParts parts(const ScatteringRow& row, std::size_t sun, double nu) const;
    // The channels of a texel. Light below 0, which moments that end at a degree and polynomials
    // along rays in the shadow may leave where there is next to none, is 0.
    Texel texel(const ScatteringParts& parts) const;

    // What a runtime makes of it: radiance in 1/sr.
    Spectrum radiance(const ScatteringParts& parts, double nu) const;

    const std::vector<bool>& is_mie() const { return is_mie_; }  // by layer of the medium
    Spectrum mie_phase(double nu) const;                         // of the first Mie layer

  private:
    const SkyMedium& medium_;
    config::BrunetonTable table_;
    bool combined_;
    int orders_;
    std::size_t colours_;
    std::size_t channels_;
    double constant_alpha_ = 0;
    std::vector<bool> is_mie_;
    std::vector<double> solar_irradiance_;
};

}  // namespace skybake
