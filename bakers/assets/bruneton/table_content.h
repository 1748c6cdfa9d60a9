// A table of scattering holds, of all wavelengths of a recipe, the wavelengths of one packet as
// they are, or the colours made of the light of all packets.
//
// A colour is a sum over wavelengths i of weight_i times light (light/sky_colors.h). It is taken
// before the light is stored, and commutes with what a runtime does then: blend texels, and multiply
// by Rayleigh's phase function, which all wavelengths share. The Mie layers' light is multiplied by
// one phase function in each channel c. It is that of the first Mie layer for sunlight,
//
//   p_c(nu) = sum over i of w_ic p_i(nu) / sum over i of w_ic
//
// and the light of wavelength i is divided by p_c in place of p_i. Phase functions with a g are the
// same for all wavelengths. A holds the first colour, as it holds the first wavelength else.
//
// Adjusts texels slightly so that lookups between them are right.
//
// Where light falls steeply (at dusk by half and more from one texel to the next) a linear lookup
// between exact texels is always too bright. Along each axis texels f_i are multiplied by scales
// x_i, which balance the errors at texels with those halfway between them by minimising
//
//   sum over i (x_i - 1)^2 + sum over i ((x_i f_i + x_(i+1) f_(i+1)) / (f_i + f_(i+1)) - t_i)^2
//
// t_i is the light halfway divided by the mean of the two texels, from cubic interpolation of the
// light's logarithm. The scales of all axes are multiplied.
#pragma once

#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <span>
#include <vector>

#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Returns the scales x of a line of texels, which must not be negative. They are 1 next to texels
// without light, or with less than rays are followed for, where the light halfway is not known.
std::vector<double> lookup_scales(const std::vector<double>& line);

// Scales the first `channels` channels of a table of scattering.
void fit_lookups(const ScatteringMapping& mapping, std::size_t channels, const BakeOptions& options,
                 VoxelArray& table);

inline constexpr std::size_t kColors = 3;

// The light of one packet's wavelengths in a texel (ScatteringContent::light and mie_light).
struct PacketOfTexel {
    Spectrum light{};
    Spectrum mie{};
};

class TableContent {
  public:
    // Holds the wavelengths of one packet, or with weights colours, `solar_irradiance` of which
    // multiplies each. There is a weight for each wavelength of all packets. The packets must
    // outlive this object.
    TableContent(std::vector<const ScatteringContent*> packets, std::vector<glm::dvec3> weights,
                 std::vector<double> solar_irradiance);

    bool is_colored() const { return !weights_.empty(); }
    const std::vector<const ScatteringContent*>& packets() const { return packets_; }
    const ScatteringContent& first() const { return *packets_.front(); }
    std::size_t channels() const;

    // Returns the channels of a texel, from the parts of each packet, for a nu.
    Texel texel(std::span<const ScatteringParts> parts, double nu) const;
    Texel color(std::span<const PacketOfTexel> packets, double nu) const;

    // Returns the radiance in 1/sr that a runtime computes from a looked-up texel
    // (ScatteringContent::radiance).
    Spectrum radiance(const Texel& texel, double nu) const;

    // Returns the phase function by which a runtime multiplies the Mie layers' light.
    Spectrum mie_phase(double nu) const;

  private:
    Spectrum color_of(const std::vector<Spectrum>& packets) const;

    std::vector<const ScatteringContent*> packets_;
    std::vector<glm::dvec3> weights_;
    std::vector<double> solar_irradiance_;
    bool has_spectral_phase_ = false;  // of Mie layers
    Spectrum white_{};                 // the sum of all weights
    Spectrum mie_colours_{};
};

// Returns the texels, u fastest, moved so that lookups between them are right (fit_lookups), wavelength by
// wavelength, since colours need not be above 0.
VoxelArray table_texels(const TableContent& content, const ScatteringMapping& mapping,
                        std::span<const TableParts> parts, const BakeOptions& options);

}  // namespace skybake
