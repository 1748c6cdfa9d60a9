// The light that an asset of the sky is to show: which orders, scattered by which layers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"
#include "config/sections/scene.h"

namespace skybake {

// Of the moments by which light is scattered once more: what haze scatters forward and again is
// within 0.15 % of path tracing in the median of Earth's sky.
inline constexpr int kSkyDegree = 8;

class SkyLight {
  public:
    // Solves for all orders unless `orders` is single. `layers` are those that scatter, all if it
    // is empty; the others dim the light all the same. After an interruption the light is not to be
    // used.
    SkyLight(const config::Atmosphere& atmosphere, config::SkyOrders orders,
             const std::vector<std::string>& layers, const BakeOptions& options);

    // With other higher orders than the solution: null for none.
    SkyLight(SkyMedium medium, config::SkyOrders orders,
             std::unique_ptr<const HigherOrders> higher_orders);

    SkyLight(const SkyLight&) = delete;
    SkyLight& operator=(const SkyLight&) = delete;

    // Why there is no light, if it was solved for and is none (energy_balance.h).
    [[nodiscard]] std::optional<config::Diagnostic> problem(const std::string& name) const;

    // Forward peaks of spheres count as light that goes on (forward_peak.h), but for light
    // scattered once.
    const SkyMedium& medium() const { return medium_; }
    bool has_peaks() const;
    // Transmittance to the sun through the whole air, peaks and all, as SkyIntegrator::sunlight.
    Spectrum sun_transmittance(double altitude_km, double s_km) const;
    const Shell& shell() const { return shell_; }
    const SkyIntegrator& integrator() const { return integrator_; }
    const HigherOrders* higher_orders() const { return higher_orders_.get(); }
    config::SkyOrders orders() const { return orders_; }

    // What is wanted of a radiance: with `single` the light scattered once in the air, with
    // `multiple` the rest, the ground's among it.
    Spectrum wanted(const SkyRadiance& radiance) const;

  private:
    SkyMedium medium_;
    Medium whole_air_;
    Shell shell_;
    config::SkyOrders orders_;
    std::shared_ptr<const SolvedLight> solved_;  // null: not solved for
    std::unique_ptr<const HigherOrders> higher_orders_;
    SkyIntegrator integrator_;
};

// Light of higher orders without what is below 0: moments that end at a degree, and interpolation
// between azimuths, leave a little less than nothing at night and in deep twilight, where there is
// next to nothing.
Spectrum not_negative(const Spectrum& higher_orders);

// The atmosphere with all layers' extinction, and the scattering of those of these names alone; the
// atmosphere itself if there are no names.
config::Atmosphere scattering_only(config::Atmosphere atmosphere,
                                   const std::vector<std::string>& layers);

// "all orders", "single scattering by mie": for what files say of themselves.
std::string light_text(config::SkyOrders orders, const std::vector<std::string>& layers);

}  // namespace skybake
