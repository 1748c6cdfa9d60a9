// The tables with two axes: transmittance to the top of the air, and irradiance of level surfaces
// by the sky.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/field/certify.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Computes values at coordinates x of one y, with interleaved colours.
using FlatRow = std::function<void(double y, const std::vector<double>& x, double* values)>;

struct FlatTable {
    FlatRow row;
    FlatRow reference;
    std::size_t colours = 0;
};

// The table of transmittance. `medium` must outlive it.
FlatTable flat_transmittance(const Medium& medium);
// The table of irradiance by the orders of `light`. `light` and `solar_irradiance` must outlive it.
FlatTable flat_irradiance(const SkyLight& light, const std::vector<double>& solar_irradiance);

// Returns the table of the colours that the weights of all packets' wavelengths make of their tables,
// times `factors`.
FlatTable flat_colors(std::vector<FlatTable> packets, std::vector<glm::dvec3> weights,
                      const glm::dvec3& factors);

// Makes the texels. Channels after the colours hold 1.
VoxelArray flat_texels(const FlatTable& table, const std::array<int, 3>& size, std::size_t channels,
                       const BakeOptions& options);
// Returns the reference as a function of texture coordinates of a table of that size. `table` must
// outlive it.
VolumeReference flat_reference(const FlatTable& table, const std::array<int, 3>& size,
                               std::size_t channels);

// Bakes the transmittance. `volume` comes with name, parameters, details and channels; takram's has
// a channel A of 1.
Outcome<Baked> bake_bruneton_transmittance(const FlatTable& table, const Shell& shell,
                                           const BrunetonBake& bake, const BakeOptions& options,
                                           Baked volume);

// Bakes the irradiance.
Outcome<Baked> bake_bruneton_irradiance(const FlatTable& table, const Shell& shell,
                                        const BrunetonBake& bake, const BakeOptions& options,
                                        Baked volume);

}  // namespace skybake
