// The variants of Bruneton's tables of transmittance and irradiance: sizes and pixel types.
#pragma once

#include <optional>

#include "bakers/report/report.h"
#include "bakers/report/sweeps/bruneton_sweep.h"
#include "config/assets/bruneton.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// Errors as of the certificate. None: the user has interrupted.
std::optional<BrunetonSweep> bruneton_flat_sweep(const config::Atmosphere& atmosphere,
                                                 const config::BrunetonBake& asked,
                                                 const ReportOptions& options);

}  // namespace skybake
