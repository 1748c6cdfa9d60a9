// The baker of `asset = "multiple_scattering"`.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/assets/multiple_scattering.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// The table as a function: Psi (1/sr) at the sun's cosine and altitude of (x, y). The reference is
// the same integral with many more nodes and a finer table of sunlight; tests compare it with
// nested adaptive quadrature, within 1e-4. `medium` must outlive the model.
TableModel multiple_scattering_model(const Medium& medium,
                                     const config::MultipleScatteringBake& bake, int threads);

// Bakes Hillaire's multiple scattering (multiple_scattering_kernel.h,
// multiple_scattering_mapping.h). `table` comes with name, parameters and channel names.
Outcome<Baked> bake_multiple_scattering(const Medium& medium,
                                        const config::MultipleScatteringBake& bake,
                                        const BakeOptions& options, Baked table);

}  // namespace skybake
