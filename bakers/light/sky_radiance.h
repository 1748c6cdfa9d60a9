// The radiance of the sky along one ray by direct integration, in double precision.
//
//   single    integral of T sum over layers of sigma_s p(nu) T_sun dt
//   multiple  integral of T (what HigherOrders scatters) dt
//   ground    T (where the ray ends) albedo / pi (mu_s T_sun + sky irradiance)
//
// T and T_sun are exact optical depths (optical_depth.h).
//
// Rays are cut at the altitudes where the course of a density changes abruptly, at their lowest
// point, at the planet's shadow, and where the sun's own ray grazes one of those altitudes. The
// pieces are halved until no piece that light still reaches has an optical depth above 1, and each
// is integrated by Gauss's rule with five nodes.
//
// Hard cases: the sun on the horizon and below (rays that graze the shadow), at the zenith, and in
// the view direction itself; the camera on the ground (rays below the horizontal have length 0), at
// the top and in space (rays that miss the air are black); a horizon 40 degrees below the
// horizontal; 50 times the Earth's air; no air at all.
//
// The skins of layers that begin or end abruptly, which a low sun lights: its rays reach centimetres
// into a fog that is a hundred metres deep.
//
// At a depth d below the edge of air with the extinction k sunlight fades as exp(-k d / mu_s), and of a
// sun at the horizontal as exp(-k sqrt(2 r d)). Rays are cut at depths that grow by a constant factor
// from one to the next, so that each piece sees either exponent change by little or hardly any light.
// Tables of sunlight, whose rows are metres apart, are not read there.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/solver/solution_levels.h"

namespace skybake {

struct LitSkins {
    std::vector<double> altitudes_km;   // where rays are cut: quadrature_altitudes_km and the skins
    std::vector<AltitudeRange> layers;  // layers that begin or end abruptly

    bool hold(double altitude_km) const;
};

LitSkins lit_skins(const Medium& medium);

// In 1/sr, for a solar irradiance of 1.
struct SkyRadiance {
    Spectrum single{};
    Spectrum multiple{};
    Spectrum ground{};
    Spectrum transmittance{};  // along the whole ray
    Spectrum total() const;    // sum of the three lights
};

class SkyIntegrator {
  public:
    // `medium` and `higher_orders` must outlive this object. If `higher_orders` is null, the result
    // has only single scattering and ground in sunlight.
    SkyIntegrator(const SkyMedium& medium, const HigherOrders* higher_orders);

    // Returns the radiance at an altitude in [0, thickness]. Single scattering is within 2e-4 of
    // adaptive quadrature.
    SkyRadiance radiance(double altitude_km, const SunZenith& sun,
                         const SkyDirection& direction) const;

    // Returns the same along any ray.
    SkyRadiance radiance(const SkyRay& ray) const;

    // Returns the light that arrives at the ray's beginning from the stretch up to each of
    // `distances_km`, without the ground. `distances_km` ascend and lie in [0, length].
    std::vector<SkyRadiance> up_to(const SkyRay& ray,
                                   const std::vector<double>& distances_km) const;

    // Returns the radiance of the ground in 1/sr where r mu_s = `sun_s_km`.
    Spectrum ground_radiance(double sun_s_km) const;

    // Returns the transmittance to the sun at a point where r mu_s = `s_km`. It is 0 in the
    // planet's shadow.
    Spectrum sunlight(double altitude_km, double s_km) const;
    // Computes the same towards many suns above the horizon: values[channel * suns + sun].
    void sunlight(double altitude_km, const std::vector<double>& s_km, double* values) const;

    const LitSkins& skins() const { return skins_; }

  private:
    struct Piece;
    std::vector<double> cuts_km(const SkyRay& ray) const;
    Spectrum depth_between(const SkyRay& ray, double from_km, double to_km) const;
    double altitude_on(const SkyRay& ray, double distance_km) const;
    using NodeValues = std::array<double, ray_pieces::kNodes>;
    std::array<Spectrum, ray_pieces::kNodes> depths_between(const SkyRay& ray, double from_km,
                                                            NodeValues distances_km) const;
    std::array<Spectrum, ray_pieces::kNodes> sunlight(const NodeValues& altitudes_km,
                                                      const NodeValues& s_km) const;
    std::vector<Spectrum> phases(const SkyRay& ray) const;
    void add_piece(const SkyRay& ray, const std::vector<Spectrum>& phases, const Piece& piece,
                   int halvings, SkyRadiance& sum) const;

    const SkyMedium& medium_;
    const HigherOrders* higher_orders_;
    Shell shell_;
    LitSkins skins_;
};

// Returns the point of a ray after `distance_km`, at an altitude where r mu_s = `sun_s_km`.
ScatteringPoint scattering_point(const Shell& shell, const SkyRay& ray, double altitude_km,
                                 double sun_s_km, double distance_km);

}  // namespace skybake
