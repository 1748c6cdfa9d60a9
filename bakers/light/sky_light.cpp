#include "bakers/light/sky_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bakers/air/forward_peak.h"
#include "bakers/air/optical_depth.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/solver/energy_balance.h"
#include "bakers/math/transcendental.h"

namespace skybake {

using config::SkyOrders;

namespace {

std::shared_ptr<const SolvedLight> solve_unless_single(const config::Atmosphere& atmosphere,
                                                       const SkyMedium& medium, SkyOrders orders,
                                                       const BakeOptions& options) {
    if (orders == SkyOrders::single) return nullptr;
    return light_of({.atmosphere = atmosphere}, medium, options);
}

std::unique_ptr<const HigherOrders> solved_orders(const SkyMedium& medium, SkyOrders orders,
                                                  const SolvedLight* light) {
    if (orders == SkyOrders::single) return nullptr;
    return std::make_unique<SolvedOrders>(medium, *light, light->degree());
}

SkyMedium medium_for(const config::Atmosphere& atmosphere, SkyOrders orders) {
    return orders == SkyOrders::single ? make_sky_medium(atmosphere)
                                       : medium_of({.atmosphere = atmosphere});
}

}  // namespace

SkyLight::SkyLight(const config::Atmosphere& atmosphere, SkyOrders orders,
                   const std::vector<std::string>& layers, const BakeOptions& options)
    : medium_(scattering_only(medium_for(atmosphere, orders), layers)),
      whole_air_(make_medium(atmosphere)),
      shell_(shell_of(medium_.air)),
      orders_(orders),
      solved_(solve_unless_single(atmosphere, medium_, orders, options)),
      higher_orders_(solved_orders(medium_, orders, solved_.get())),
      integrator_(medium_, higher_orders_.get()),
      once_(orders == SkyOrders::multiple && has_peaks()
                ? std::make_unique<SkyLight>(atmosphere, SkyOrders::single,
                                             std::vector<std::string>{}, options)
                : nullptr),
      make_sunlight_([this, atmosphere, orders, options] {
          return sunlight_of(sunlight_request(atmosphere, orders), medium_.air, options);
      }) {}

SkyLight::SkyLight(SkyMedium medium, SkyOrders orders,
                   std::unique_ptr<const HigherOrders> higher_orders, int threads)
    : medium_(std::move(medium)),
      whole_air_(medium_.air),
      shell_(shell_of(medium_.air)),
      orders_(orders),
      higher_orders_(std::move(higher_orders)),
      integrator_(medium_, higher_orders_.get()),
      make_sunlight_([this, threads] { return make_sunlight(medium_.air, threads); }) {}

std::optional<Diagnostic> SkyLight::problem(const std::string& name) const {
    if (!solved_) return std::nullopt;
    return check_light(energy_balance(medium_, *solved_), *solved_, name);
}

Spectrum SkyLight::sun_transmittance(double altitude_km, double s_km) const {
    if (!has_peaks()) return integrator_.sunlight(altitude_km, s_km);
    if (s_km < -horizon_distance_km(shell_, altitude_km)) return {};
    return exponential(-optical_depth_to_top(whole_air_, altitude_km, s_km));
}

const TransmittanceField& SkyLight::sunlight() const {
    std::call_once(sunlight_made_, [this] { sunlight_ = make_sunlight_(); });
    return *sunlight_;
}

bool SkyLight::has_peaks() const {
    return std::ranges::any_of(
        medium_.layers, [](const SkyLayer& layer) { return !layer.first_phase.functions.empty(); });
}

Spectrum SkyLight::wanted(const SkyRadiance& radiance) const {
    if (orders_ == SkyOrders::single) return radiance.single;
    const Spectrum sum = not_negative(radiance.multiple) + radiance.ground;
    return orders_ == SkyOrders::all ? sum + radiance.single : sum;
}

Spectrum not_negative(const Spectrum& higher_orders) {
    return maximum(higher_orders, Spectrum(0.0));
}

std::string light_text(SkyOrders orders, const std::vector<std::string>& layers) {
    if (orders == SkyOrders::all) return "all orders of scattering";
    if (orders == SkyOrders::multiple) {
        return "light scattered more than once or reflected by the ground";
    }
    if (layers.empty()) return "single scattering";
    return fmt::format("single scattering by {}", fmt::join(layers, ", "));
}

}  // namespace skybake
