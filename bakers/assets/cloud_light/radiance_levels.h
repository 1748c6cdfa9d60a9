// The light that cells scatter, all orders of it, where the light that they scatter first is known:
//
//   J = K (J + J_1) + J_e
//
// K is a sweep (radiance_sweep.h) and what cells scatter of it, J_e that of light which enters the layer. Orders of
// scattering are a series that converges slowly where cells are thick. A sweep leaves the rest
//
//   r = K (J + J_1) + J_e - J
//
// and J lacks r + e, where e = K (e + r). Coarser cells know that but for what is finer in r, which the cell that
// sends it out takes back in part: within each cell r + K r + ... is r / (1 - k) for the share k that K takes back
// (multigrid methods: Brandt 1977; of the second kind: Hackbusch 1981). Where that is slow, corrections are combined
// with past ones. Rough clouds of some hundred depths a cell can still fail, with values that are not finite.
#pragma once

#include <memory>
#include <vector>

#include "bakers/assets/cloud_light/coarser_cells.h"
#include "bakers/assets/cloud_light/radiance_sweep.h"
#include "bakers/math/bake_options.h"

namespace skybake::cloud_light {

// A solution ends when a sweep changes J by no more than a share of it, or after so many sweeps.
struct SolutionEnd {
    double change = 0;
    int sweeps = 200;
    bool is_shown = false;  // whether progress is reported, as the step "sweeps"
};

struct ScatteredLight {
    CellFields light;   // J
    int sweeps = 0;     // over these cells
    double change = 0;  // of J in the last sweep: root mean square over that of J
};

class RadianceLevels {
  public:
    // `returned` is the share of radiance of each degree that cells scatter.
    RadianceLevels(const LayerCells& cells, const std::vector<double>& returned,
                   const BakeOptions& options);

    // The light is incomplete once options.progress is cancelled.
    ScatteredLight solve(const CellFields& first, const EnteringLight& entering,
                         const SolutionEnd& end, const BakeOptions& options) const;

    const RadianceSweep& sweep() const { return sweep_; }

  private:
    // rest += e, nearly.
    void add_later_orders(CellFields& rest, const BakeOptions& options) const;

    CellFields extinction_;
    std::vector<double> returned_;
    RadianceSweep sweep_;
    CellFactors factors_;
    std::unique_ptr<const RadianceLevels> coarser_;  // null: these cells are few
};

}  // namespace skybake::cloud_light
