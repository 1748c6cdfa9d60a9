// The tables of two axes: transmittance to the top of the air, and irradiance of level surfaces by
// the sky.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Values at coordinates x of one y, colours interleaved.
using FlatRow = std::function<void(double y, const std::vector<double>& x, double* values)>;

struct FlatTable {
    FlatRow row;
    FlatRow reference;
    std::size_t colours = 0;
};

// `medium` must outlive it.
FlatTable flat_transmittance(const Medium& medium);
// By the orders of `light`. Both must outlive it.
FlatTable flat_irradiance(const SkyLight& light, const std::vector<double>& solar_irradiance);

// Channels after the colours hold 1.
DenseVolume flat_texels(const FlatTable& table, const std::array<int, 3>& size,
                        std::size_t channels, const BakeOptions& options);
// The same by texture coordinates of a table of that size. The table must outlive it.
VolumeReference flat_reference(const FlatTable& table, const std::array<int, 3>& size,
                               std::size_t channels);

// `volume` has its name, parameters, details and channels; takram's has an A of 1.
config::Outcome<Baked> bake_bruneton_transmittance(const Medium& medium,
                                                   const config::BrunetonBake& bake,
                                                   const BakeOptions& options, Baked volume);

// By the orders of `light`, times the solar irradiance.
config::Outcome<Baked> bake_bruneton_irradiance(const SkyLight& light,
                                                const config::BrunetonBake& bake,
                                                const BakeOptions& options, Baked volume);

}  // namespace skybake
