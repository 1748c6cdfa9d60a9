// Light that has been scattered or reflected before, as a sky integrator asks for it: the table of
// a runtime, or the solution that the table stands for.
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

// A point on a view ray, and the view as seen from there.
struct ScatteringPoint {
    double altitude_km = 0;
    double sun_cos_zenith = 0;
    double view_cos_zenith = 0;
    double azimuth_cosine =
        0;  // between view and sun; anything in [-1, 1] where either is vertical
};

class HigherOrders {
  public:
    virtual ~HigherOrders() = default;

    // Sum over layers of sigma_s integral of p L over directions, L the light that is no sunlight
    // straight from the sun: what a km of air sends towards the eye, in 1/sr/km for a solar
    // irradiance of 1. `scattering_per_km` has one entry per layer of the medium.
    virtual Spectrum scattered(const ScatteringPoint& point,
                               const std::vector<Spectrum>& scattering_per_km) const = 0;

    // Irradiance of level ground by the sky, without sunlight straight from the sun.
    virtual Spectrum sky_irradiance(double sun_cos_zenith) const = 0;
};

// --- The mean radiance ---------------------------------------------------------------------------

// Higher orders as runtimes with Hillaire's texture have them: the mean radiance Psi, scattered
// alike in all directions by every layer (Hillaire 2020, section 5.5).
//
// Psi at the ground is half sky (J_sky) and half ground (albedo (E_sun / pi + J_sky), the sky taken
// as equally bright all over), E_sun = mu_s T_sun; so J_sky = (2 Psi - albedo E_sun / pi) / (1 +
// albedo), and the sky's irradiance is pi J_sky.

class IsotropicOrders : public HigherOrders {
  public:
    // Psi (1/sr) at an altitude for a cosine of the sun's zenith angle. `medium` must outlive it.
    using MeanRadiance = std::function<Spectrum(double altitude_km, double sun_cos_zenith)>;
    IsotropicOrders(const Medium& medium, MeanRadiance mean_radiance);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

  private:
    const Medium& medium_;
    MeanRadiance mean_radiance_;
};

// --- The solution --------------------------------------------------------------------------------

// Higher orders as solved: moments of the light, scattered by each layer's own phase function.

class SolvedOrders : public HigherOrders {
  public:
    // Uses moments up to `degree`, at most the solution's. Both must outlive it.
    SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;

  private:
    const SolvedLight& light_;
    int degree_;
    std::vector<std::vector<Spectrum>> phase_moments_;  // of each layer
};

// --- A stored table ------------------------------------------------------------------------------

// Higher orders as a runtime takes them from a stored table of multiple scattering: the mean
// radiance alone, or a stack of moments (solved_scattering_table.h).

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

// --- One point under many suns -------------------------------------------------------------------

// What the solved light sends along a view ray from one point of it, for any sun: SolvedOrders with
// all contracted that the sun does not change, for those who ask under many suns.

class SolvedSource {
  public:
    // `scattering` has one entry per layer, `phase_moments` too: legendre_moments up to the light's
    // degree. The light must outlive it.
    SolvedSource(const SolvedLight& light, double altitude_km, double view_cos_zenith,
                 const std::vector<Spectrum>& scattering,
                 const std::vector<std::vector<Spectrum>>& phase_moments);

    // As SolvedOrders::scattered, to rounding.
    Spectrum scattered(double sun_cos_zenith, double azimuth_cosine) const;

  private:
    const SolvedLight& light_;
    std::vector<Spectrum> values_;  // [sun * (degree + 1) + m]
};

}  // namespace skybake
