// The table of a phase function by angle, or of its inverse cumulative distribution (asset =
// "phase").
#pragma once

#include "bakers/air/particles/layer_phase.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/assets/phase.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Bakes the table. `table` comes with name, channels, parameters and details.
Outcome<Baked> bake_phase(const Parameters& parameters, const config::PhaseBake& bake,
                          const BakeOptions& options, Baked table);

// The model of p by angle, for any spacing but `best`. Errors are relative to p itself, which spans
// decades. `source` must outlive both models.
TableModel phase_model(const PhaseSource& source, config::PhaseSpacing spacing);

// The model of 1 - cos theta as a function of the share of light that is scattered by less than
// theta. Errors are in half turns.
TableModel inverse_phase_model(const PhaseSource& source);

}  // namespace skybake
