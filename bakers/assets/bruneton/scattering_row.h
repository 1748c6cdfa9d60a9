// Texels that share a view ray: the light scattered towards its beginning under many suns.
#pragma once

#include <memory>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/bundle_light.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

// Light for a solar irradiance of 1, for each sun.
struct ScatteringRow {
    // [layer][sun]: light scattered once, without the phase function.
    std::vector<std::vector<Spectrum>> single;
    // Light scattered more than once, or reflected by the ground before, in 1/sr. Empty without
    // light.
    std::vector<Spectrum> higher;
};

class ScatteringRows {
  public:
    // `medium` and `light` must outlive this object. If `light` is null there are no higher orders.
    // `sunlight` is a table of the transmittance through medium.air (shared_light.h); if it is null,
    // there is no single scattering.
    ScatteringRows(const SkyMedium& medium, const SolvedLight* light,
                   std::shared_ptr<const TransmittanceField> sunlight);

    // `suns` may hold combinations of angles that do not exist (sun_bundle.h).
    ScatteringRow row(const ScatteringView& view, const SunBundle& suns) const;

  private:
    void add_cut_piece(const ScatteringView& view, const BundlePiece& piece, double from_km,
                       double to_km, double sun_cos_zenith, double nu,
                       std::vector<Spectrum>& sums) const;
    Spectrum sunlight(double altitude_km, double s_km) const;

    const SkyMedium& medium_;
    const SolvedLight* light_;
    Shell shell_;
    std::vector<double> break_altitudes_km_;
    std::vector<std::vector<Spectrum>> phase_moments_;
    std::shared_ptr<const TransmittanceField> sunlight_;
};

}  // namespace skybake
