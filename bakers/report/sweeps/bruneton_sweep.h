// The variants of tables of Bruneton's, made: their voxels stand in memory.
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
    ReferenceOfSize reference;  // of tables of two axes; others' variants measure themselves
    std::array<int, 3> size{};  // the largest that was made: what the report is about
    int points = 0;             // that are compared
    int repetitions = 0;        // times are medians of so many
};

// Making a table takes up to seconds.
constexpr int bruneton_repetitions(bool quick) { return quick ? 1 : 3; }

// Of transmittance and irradiance: sizes and pixel types. Errors as of the certificate. None: the
// user has interrupted.
std::optional<BrunetonSweep> bruneton_flat_sweep(const config::Atmosphere& atmosphere,
                                                 const config::BrunetonBake& asked,
                                                 const ReportOptions& options);

// Of scattering, of single Mie scattering and of higher orders: as asked, half and a quarter of
// that along each axis but nu, as float and half:
//
//   solved, fitted   as `bake` has it
//   solved, exact    texels before they are moved for lookups (bruneton/lookup_fit.h)
//   iterated         2, 3 and 4 orders as Bruneton iterates them, at the smallest size alone: it
//                    takes seconds there, minutes at the size of the published tables
//
// All are measured against the orders that the recipe asks for, as its certificate is. None: the
// user has interrupted.
std::optional<BrunetonSweep> bruneton_scattering_sweep(const config::Atmosphere& atmosphere,
                                                       const config::BrunetonBake& asked,
                                                       const ReportOptions& options);

}  // namespace skybake
