// Higher orders as a runtime takes them from a stored table of multiple scattering: the mean
// radiance alone, or a stack of moments (solved_scattering_table.h).
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/sky_medium.h"
#include "bakers/field/image.h"
#include "bakers/light/isotropic_orders.h"

namespace skybake {

// Where a point's moments stand in the table: its coordinates, each in [0, 1], end points on texel
// centres.
struct TablePlace {
    double x = 0;
    double y = 0;
};
using PlaceInTable = std::function<TablePlace(double altitude_km, double sun_cos_zenith)>;

class TableOrders : public HigherOrders {
  public:
    // `degree` 0: the mean radiance. All but `place` must outlive it.
    TableOrders(const SkyMedium& medium, const Image2<float>& table, int degree,
                PlaceInTable place);
    TableOrders(const TableOrders&) = delete;  // its parts refer to one another
    TableOrders& operator=(const TableOrders&) = delete;

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

  private:
    Spectrum moment_at(const ScatteringPoint& point, int part) const;

    const Image2<float>& table_;
    int degree_;
    PlaceInTable place_;
    std::vector<std::vector<Spectrum>> phase_moments_;  // of each layer
    IsotropicOrders mean_;
};

}  // namespace skybake
