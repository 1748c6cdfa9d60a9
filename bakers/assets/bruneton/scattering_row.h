// Texels that share a view ray: light scattered towards its beginning under many suns.
#pragma once

#include <memory>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/sun_bundle.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

// For a solar irradiance of 1, one per sun.
struct ScatteringRow {
    // [layer][sun]: scattered once, without the phase function.
    std::vector<std::vector<Spectrum>> single;
    // Scattered more than once, or reflected by the ground before; in 1/sr. Empty without light.
    std::vector<Spectrum> higher;
};

class ScatteringRows {
  public:
    // All must outlive it. Without `light` there are no higher orders; single scattering is 0 where
    // it is not wanted.
    ScatteringRows(const SkyMedium& medium, const SolvedLight* light, bool wants_single,
                   int threads);

    // `suns` may hold more than there are (sun_bundle.h).
    ScatteringRow row(const ScatteringView& view, const SunBundle& suns) const;

  private:
    void add_cut_piece(const ScatteringView& view, const BundlePiece& piece, double from_km,
                       double to_km, double sun_cos_zenith, double nu,
                       std::vector<Spectrum>& sums) const;
    Spectrum sunlight(double altitude_km, double s_km) const;

    const SkyMedium& medium_;
    const SolvedLight* light_;
    bool wants_single_;
    Shell shell_;
    std::vector<double> break_altitudes_km_;
    std::vector<std::vector<Spectrum>> phase_moments_;
    TransmittanceField sunlight_;
};

// Where a view ray is in the planet's shadow.

// Distances along the ray; none where begin is not below end. The shadow, half a cylinder, is
// convex.
struct DarkStretch {
    double begin_km = 0;
    double end_km = 0;
};

// In terms of three cosines that need not belong to directions: between sun and zenith where the
// ray begins, and between sun and ray.
DarkStretch dark_stretch(const Shell& shell, const ScatteringView& view, double sun_cos_zenith,
                         double nu);

}  // namespace skybake
