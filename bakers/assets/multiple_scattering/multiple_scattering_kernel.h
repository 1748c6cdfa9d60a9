// Hillaire's multiple-scattering integral for a row of suns.
//
// "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, equations
// 5-10, for sunlight of irradiance 1 and isotropic scattering after the first bounce:
//
//   L_2nd = 1/4pi integral over directions of [ T(x, p) albedo/pi max(0, mu_s(p)) T_sun(p)
//                                              + integral of sigma_s T T_sun / 4pi dt ]
//   f     = 1/4pi integral over directions of integral of sigma_s T dt
//   Psi   = L_2nd / (1 - f)                                        [1/sr]
//
// p is the point where the direction meets the ground. 1 - f is computed as the mean over
// directions of the light that escapes or is absorbed, from the nodes that L_2nd uses. This is a
// sum of terms that are not negative, so that a medium that hardly absorbs loses no digits in 1 /
// (1 - f).
//
// The sun is up at a point while mu_s' >= -sqrt(r'^2 - R^2) / r'. Where this depends on the
// azimuth, the mean over azimuths is integrated over the lit part alone.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/multiple_scattering_quadrature.h"

namespace skybake {

// Sunlight for the rows of one table.
class Sunlight {
  public:
    // `altitudes_km` must be those given to make_row_quadrature.
    Sunlight(const Medium& medium, const std::vector<double>& altitudes_km,
             TransmittanceField::Size size, int threads);

    const TransmittanceField& field() const { return field_; }
    // Returns the field's row at altitudes_km[level], which is computed beforehand.
    const double* row(int level) const {
        return rows_.data() + static_cast<std::size_t>(level) * row_size_;
    }

  private:
    TransmittanceField field_;
    std::size_t row_size_;
    std::vector<double> rows_;
};

// Computes Psi in 1/sr for `count` suns at the altitude of `row`: channel c of sun i is written to
// psi[c * count + i]. The bits are the same for any vector width.
void integrate_row(const Medium& medium, const Sunlight& sunlight, const RowQuadrature& row,
                   const double* sun_cos_zenith, int count, double* psi);

}  // namespace skybake
