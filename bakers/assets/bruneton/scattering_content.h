// The meaning of a texel of a table of scattering: which layers and orders it holds, and by which
// phase functions its light is divided.
//
// A runtime multiplies R G B of `scattering` and `higher_orders` by Rayleigh's phase function at
// its own nu, and A and `single_mie` by that of the (first) Mie layer. Layers that are named as Mie
// contribute to the latter, all others to the former. Where a layer has another phase function, its
// light is multiplied by its own phase function and divided by the runtime's, at the texel's nu.
// Higher orders are divided by Rayleigh's.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_row.h"
#include "config/assets/bruneton.h"

namespace skybake {

inline constexpr std::size_t kMostTexelChannels = kMaxChannels + 1;
using Texel = std::array<double, kMostTexelChannels>;

// The parts whose sum is a texel, for a solar irradiance of 1.
struct ScatteringParts {
    Spectrum air{};     // first order, by other than Mie layers, over Rayleigh's phase function
    Spectrum mie{};     // first order, over the phase function of the first Mie layer
    Spectrum higher{};  // higher orders, over Rayleigh's phase function
};

class ScatteringContent {
  public:
    // `medium` must outlive this object.
    ScatteringContent(const SkyMedium& medium, const BrunetonBake& bake);

    const SkyMedium& medium() const { return medium_; }
    BrunetonTable table() const { return table_; }
    bool is_combined() const { return combined_; }
    std::size_t wavelengths() const { return colours_; }
    std::size_t channels() const { return channels_; }
    // Returns the number of channels that hold light, which are the first ones.
    std::size_t measured_channels() const;
    bool has_alpha() const { return channels_ > colours_; }
    // Whether A holds the Mie layers' light.
    bool holds_mie() const { return has_alpha() && table_ == BrunetonTable::scattering; }
    bool wants_single() const;
    bool wants_higher() const;

    // Returns the parts for one sun of a row.
    ScatteringParts parts(const ScatteringRow& row, std::size_t sun, double nu) const;
    // Return the light of a texel's colours, and that of the Mie layers which a combined table holds
    // in A, of each wavelength for a solar irradiance of 1. Negative light becomes 0; moments that
    // end at a degree, and polynomials along rays in the shadow, may leave it where there is hardly
    // any light.
    Spectrum light(const ScatteringParts& parts) const;
    static Spectrum mie_light(const ScatteringParts& parts);

    // Returns the channels of a texel.
    Texel texel(const ScatteringParts& parts) const;

    // Returns the value of A where it holds no light.
    double constant_alpha() const { return constant_alpha_; }

    // Returns the radiance in 1/sr that a runtime computes from a looked-up texel of this table. The
    // colours of the Mie layers' light, of which a combined table holds the red alone, follow from
    // the other layers' as in Bruneton's implementation.
    Spectrum radiance(const Texel& texel, double nu) const;

    const std::vector<bool>& is_mie() const { return is_mie_; }  // by layer of the medium
    Spectrum mie_phase(double nu) const;                         // of the first Mie layer

    // Returns the scattering coefficients at the ground of the Mie layers, or of all other layers.
    Spectrum coefficients_at_ground(bool of_mie) const;

  private:
    const SkyMedium& medium_;
    BrunetonTable table_;
    bool combined_;
    int orders_;
    std::size_t colours_;
    std::size_t channels_;
    double constant_alpha_ = 0;
    std::vector<bool> is_mie_;
    std::vector<double> solar_irradiance_;
    Spectrum mie_colours_{};
};

// Returns (others_red / mie_red) (mie_colour / others_colour), by which runtimes tell the colours of
// the Mie layers' light from its red, or 0 where that is not known.
Spectrum mie_colours(const Spectrum& mie, const Spectrum& others);

// How a runtime computes radiance from a texel: the phase functions by which it multiplies R, G, B
// and A, and what else it knows.
struct RuntimeTexel {
    std::size_t colours = 0;
    bool combined = false;
    Spectrum phase{};
    Spectrum mie_phase{};
    Spectrum mie_colours{};
    const std::vector<double>& solar_irradiance;

    Spectrum radiance(const Texel& texel) const;
};

}  // namespace skybake
