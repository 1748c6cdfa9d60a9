// The variants of Bruneton's tables. They are already made, with their voxels in memory.
#pragma once

#include <array>
#include <optional>

#include "bakers/report/report.h"
#include "bakers/report/sweeps/measure_volume_sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"
#include "config/assets/bruneton.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct BrunetonSweep {
    VolumeSweep sweep;
    ReferenceOfSize reference;  // for tables of two axes; other variants measure themselves
    std::array<int, 3> size{};  // the largest that was made; the report is about it
    int points = 0;             // how many are compared
    int repetitions = 0;        // each time is the median of this many
};

// The number of repetitions. It is small because making a table takes up to some seconds.
constexpr int bruneton_repetitions(bool quick) { return quick ? 1 : 3; }

// Makes variants of transmittance or irradiance in several sizes and pixel types. Errors are those
// of the certificate. Returns nothing if the user has interrupted.
std::optional<BrunetonSweep> bruneton_flat_sweep(const config::Atmosphere& atmosphere,
                                                 const config::BrunetonBake& asked,
                                                 const ReportOptions& options);

// Makes variants of the tables of scattering, single Mie scattering and higher orders. Sizes are
// the size asked for, a half and a quarter of it along each axis except nu; pixel types are float
// and half; methods are:
//
//   solved, fitted   as `bake` makes it
//   solved, exact    texels before they are moved for lookups (bruneton/lookup_fit.h)
//   iterated         2, 3 and 4 orders as Bruneton iterates them, at the smallest size alone: it
//                    takes seconds there, minutes at the size of the published tables
//
// All are measured against the orders that the recipe asks for, as the certificate is. Returns
// nothing if the user has interrupted.
std::optional<BrunetonSweep> bruneton_scattering_sweep(const config::Atmosphere& atmosphere,
                                                       const config::BrunetonBake& asked,
                                                       const ReportOptions& options);

}  // namespace skybake
