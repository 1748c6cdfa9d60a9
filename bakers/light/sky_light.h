// The light that an asset of the sky shows: its orders of scattering and the layers that scatter
// it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"
#include "config/sections/scene.h"

namespace skybake {

class SkyLight {
  public:
    // Solves for all orders unless `orders` is single: then the air is as it is, and light that goes
    // into forward peaks counts as scattered. `layers` names the layers that scatter, of
    // single scattering only; if it is empty, all do. The other layers still dim the light. After
    // an interruption the light must not be used.
    SkyLight(const config::Atmosphere& atmosphere, config::SkyOrders orders,
             const std::vector<std::string>& layers, const BakeOptions& options);

    // Uses the given higher orders instead of the solution; null stands for none.
    SkyLight(SkyMedium medium, config::SkyOrders orders,
             std::unique_ptr<const HigherOrders> higher_orders, int threads = 1);

    SkyLight(const SkyLight&) = delete;
    SkyLight& operator=(const SkyLight&) = delete;

    // Returns an error if the light was solved for and the solution is invalid (energy_balance.h).
    [[nodiscard]] std::optional<Diagnostic> problem(const std::string& name) const;

    // The medium, in which light scattered into forward peaks counts as not scattered
    // (forward_peak.h) unless orders() is single.
    const SkyMedium& medium() const { return medium_; }
    bool has_peaks() const;
    // Returns the transmittance to the sun through the whole air, forward peaks included, as
    // SkyIntegrator::sunlight does.
    Spectrum sun_transmittance(double altitude_km, double s_km) const;
    const Shell& shell() const { return shell_; }
    const SkyIntegrator& integrator() const { return integrator_; }
    const HigherOrders* higher_orders() const { return higher_orders_.get(); }
    // Returns a table of the transmittance through medium().air towards the sun, for integrals over
    // many rays (shared_light.h). It is made when it is first asked for, by any thread.
    const TransmittanceField& sunlight() const;
    config::SkyOrders orders() const { return orders_; }
    // The light that is scattered once, where orders() is multiple and the medium counts some of it
    // as scattered more often or not at all; else null.
    const SkyLight* once() const { return once_.get(); }

    // Returns the part of a radiance that `orders` asks for: with `single` the light scattered once
    // in the air, with `multiple` the rest, including light from the ground.
    Spectrum wanted(const SkyRadiance& radiance) const;

  private:
    SkyMedium medium_;
    Medium whole_air_;
    Shell shell_;
    config::SkyOrders orders_;
    std::shared_ptr<const SolvedLight> solved_;  // null if it was not solved for
    std::unique_ptr<const HigherOrders> higher_orders_;
    SkyIntegrator integrator_;
    std::unique_ptr<const SkyLight> once_;
    std::function<std::shared_ptr<const TransmittanceField>()> make_sunlight_;
    mutable std::once_flag sunlight_made_;
    mutable std::shared_ptr<const TransmittanceField> sunlight_;
};

// Returns radiances(light), for light without the part that is scattered once (SkyLight::once): what
// peaks add to it is light that is scattered more than once.
template <class Radiances>
std::vector<SkyRadiance> with_once(const SkyLight& light, const Radiances& radiances) {
    std::vector<SkyRadiance> values = radiances(light);
    if (light.once() == nullptr) return values;
    const std::vector<SkyRadiance> once = radiances(*light.once());
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i].multiple += values[i].single - once[i].single;
        values[i].single = once[i].single;
    }
    return values;
}

// Replaces negative values by 0. Moments that end at a degree, and interpolation between azimuths,
// leave slightly negative values at night and in deep twilight, where there is hardly any light.
Spectrum not_negative(const Spectrum& higher_orders);

// Returns a description for output files, for instance "all orders" or "single scattering by mie".
std::string light_text(config::SkyOrders orders, const std::vector<std::string>& layers);

}  // namespace skybake
