// All orders of scattering on a coarse grid: every second altitude, moments of degree 2, half as many
// directions.
//
// Light that was scattered often is smooth, so the coarse grid tells most of what a residual of the
// fine grid still adds. Its own errors do not matter: the fine grid's iteration takes them away
// (solve_light.h). All suns are kept: at night, light falls too fast for fewer.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/residual_search.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/solver/sun_axis.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/bake_options.h"

namespace skybake {

class CoarseOrders {
  public:
    // `fine` is the grid to be corrected, with its `steep` columns; its rays have `zenith_nodes`
    // and `ray_tolerance`.
    CoarseOrders(const SkyMedium& medium, const SolvedLight& fine, int zenith_nodes,
                 double ray_tolerance, int threads);

    // Interpolates dark suns as light falls in an estimate on the fine grid (SteepSuns).
    void follow(const LightField& fine) { steep_.follow(restricted(fine)); }

    // Returns residual + P (1 - K)^-1 K R residual, where K is the coarse grid's: about the sum of
    // all orders that begin with the residual. R takes the values at the coarse grid's points, and P
    // interpolates them as shares of the scale.
    LightField sum_from(const LightField& residual, const LightScale& scale,
                        Progress* progress) const;

  private:
    void next_order(const LightField& light, LightField& image) const;
    LightField restricted(const LightField& fine) const;
    LightScale restricted(const LightScale& scale) const;
    void add_prolonged(const LightField& coarse, const LightScale& coarse_scale,
                       const LightScale& fine_scale, LightField& fine) const;

    std::vector<std::size_t> levels_;      // of the fine grid, ascending
    std::vector<LevelPlace> fine_places_;  // of the fine levels among the coarse ones
    SunAxis suns_;
    SteepSuns steep_;
    std::vector<LevelTransport<float>> transports_;
    int threads_;
};

}  // namespace skybake
