// Light that has been scattered or reflected before, as a sky integrator asks for it: from the
// texture that runtimes use, from the solution that the texture approximates, or from a stored table.
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/light/sun_bundle.h"

namespace skybake {

// A point on a view ray, and the view as seen from there.
struct ScatteringPoint {
    double altitude_km = 0;
    double sun_cos_zenith = 0;
    double view_cos_zenith = 0;
    double azimuth_cosine =
        0;  // between view and sun; anything in [-1, 1] where either is vertical
};

// Returns the point as seen under a sun whose zenith angle has this cosine there and whose angle to
// the view has the cosine nu. Rounding may take the cosine beyond 1.
ScatteringPoint scattering_point(double altitude_km, double view_cos_zenith, double sun_cos_zenith,
                                 double nu);

class HigherOrders {
  public:
    virtual ~HigherOrders() = default;

    // Returns the sum over layers of sigma_s times the integral over directions of p L, where L is
    // all light except sunlight that comes straight from the sun. This is what one km of air sends
    // towards the eye, in 1/sr/km for a solar irradiance of 1. `scattering_per_km` has one entry
    // per layer of the medium.
    virtual Spectrum scattered(const ScatteringPoint& point,
                               const std::vector<Spectrum>& scattering_per_km) const = 0;

    // Adds `scattered` for each wanted sun to sums[sun * kChannelSlots + channel].
    using OfSuns = std::function<void(const SunBundle& suns, double* sums)>;
    // Returns that of one point of a view ray. It must not outlive this object, and only one thread may
    // call it.
    virtual OfSuns at(const PointOfRay& point,
                      const std::vector<Spectrum>& scattering_per_km) const;

    // Returns the irradiance of level ground by the sky, without sunlight that comes straight from
    // the sun.
    virtual Spectrum sky_irradiance(double sun_cos_zenith) const = 0;

    // Returns the degree of `scattered` as a polynomial in the azimuth's cosine; 0 if it is none, but
    // as smooth as one of degree 8.
    virtual int azimuth_degree() const { return 0; }
};

// --- The mean radiance ---------------------------------------------------------------------------

// Higher orders as runtimes with Hillaire's texture compute them: the mean radiance Psi, which
// every layer scatters equally in all directions (Hillaire 2020, section 5.5).
//
// At the ground one half of Psi comes from the sky, of radiance J_sky, and the other half from the
// ground, of radiance albedo (E_sun / pi + J_sky), where the sky is taken as equally bright all
// over and E_sun = mu_s T_sun. Hence J_sky = (2 Psi - albedo E_sun / pi) / (1 + albedo), and the
// sky's irradiance is pi J_sky.
class IsotropicOrders : public HigherOrders {
  public:
    // Returns Psi in 1/sr at an altitude for a cosine of the sun's zenith angle.
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

// Higher orders from the solution: moments of the light, scattered by each layer's own phase
// function.
class SolvedOrders : public HigherOrders {
  public:
    // Uses moments up to `degree`, which is at most the solution's. `medium` and `light` must
    // outlive this object.
    SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree);

    Spectrum scattered(const ScatteringPoint& point,
                       const std::vector<Spectrum>& scattering_per_km) const override;
    OfSuns at(const PointOfRay& point,
              const std::vector<Spectrum>& scattering_per_km) const override;
    Spectrum sky_irradiance(double sun_cos_zenith) const override;
    int azimuth_degree() const override { return degree_; }

  private:
    const SolvedLight& light_;
    int degree_;
    std::vector<std::vector<Spectrum>> phase_moments_;  // of each layer
};

// --- A stored table ------------------------------------------------------------------------------

// Higher orders as a runtime reads them from a stored table of multiple scattering: the mean
// radiance alone, or a stack of moments (solved_scattering_table.h).

// The place of a point's moments in the table: coordinates in [0, 1] whose end points are texel
// centres.
struct TablePlace {
    double x = 0;
    double y = 0;
};
using PlaceInTable = std::function<TablePlace(double altitude_km, double sun_cos_zenith)>;

class TableOrders : public HigherOrders {
  public:
    // With `degree` 0 the table holds the mean radiance. `medium` and `table` must outlive this
    // object.
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
