#include "bakers/report/bruneton_report.h"

#include <variant>

#include "bakers/report/sweeps/bruneton_flat_sweep.h"
#include "bakers/report/sweeps/bruneton_scattering_sweep.h"
#include "bakers/report/volume_report.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::BrunetonBake;
using config::BrunetonTable;

config::Outcome<AssetReport> report_bruneton(const config::Recipe& recipe, const config::Bake& bake,
                                             const ReportOptions& options) {
    const auto& asked = bake.as<BrunetonBake>();
    const bool is_flat =
        asked.table == BrunetonTable::transmittance || asked.table == BrunetonTable::irradiance;
    const config::Atmosphere& atmosphere = recipe.parameters.atmosphere;
    const auto made = is_flat ? bruneton_flat_sweep(atmosphere, asked, options)
                              : bruneton_scattering_sweep(atmosphere, asked, options);
    if (!made) return {};
    config::Bake subject = bake;
    auto& asset = subject.as<BrunetonBake>();
    asset.size = made->size;
    asset.mips = 1;
    // What the other method is measured against.
    asset.method = config::BrunetonMethod::solved;
    return report_volume(recipe,
                         {subject,
                          asked.size,
                          asked.mips,
                          made->sweep,
                          made->reference,
                          {},
                          made->points,
                          made->repetitions,
                          "processor time of the voxels and of the light that they need, one "
                          "thread"},
                         options);
}

}  // namespace skybake
