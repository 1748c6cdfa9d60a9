#include "bakers/sky/sky_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "bakers/scattering/solve_light.h"
#include "bakers/sky/check_light.h"
#include "bakers/sky/solved_orders.h"

namespace skybake {

using config::SkyOrders;

namespace {

// Of the moments by which light is scattered once more: what haze scatters forward and again is
// within 0.15 % of path tracing in the median of Earth's sky.
constexpr int kDegree = 8;

SolvedLight solve_unless_single(const SkyMedium& medium, SkyOrders orders,
                                const BakeOptions& options) {
    if (orders == SkyOrders::single) return {};
    SolverSettings settings;
    settings.degree = kDegree;
    return solve_light(medium, settings, options.threads, options.progress);
}

std::unique_ptr<const HigherOrders> solved_orders(const SkyMedium& medium, SkyOrders orders,
                                                  const SolvedLight& light) {
    if (orders == SkyOrders::single) return nullptr;
    return std::make_unique<SolvedOrders>(medium, light, kDegree);
}

}  // namespace

SkyLight::SkyLight(const config::Atmosphere& atmosphere, SkyOrders orders,
                   const std::vector<std::string>& layers, const BakeOptions& options)
    : medium_(make_sky_medium(scattering_only(atmosphere, layers))),
      shell_(shell_of(medium_.air)),
      orders_(orders),
      solved_(solve_unless_single(medium_, orders, options)),
      higher_orders_(solved_orders(medium_, orders, solved_)),
      integrator_(medium_, higher_orders_.get()) {}

SkyLight::SkyLight(SkyMedium medium, SkyOrders orders,
                   std::unique_ptr<const HigherOrders> higher_orders)
    : medium_(std::move(medium)),
      shell_(shell_of(medium_.air)),
      orders_(orders),
      higher_orders_(std::move(higher_orders)),
      integrator_(medium_, higher_orders_.get()) {}

std::optional<config::Diagnostic> SkyLight::problem(const std::string& name) const {
    if (solved_.altitudes_km.empty()) return std::nullopt;
    return check_light(energy_balance(medium_, solved_), solved_, name);
}

Spectrum SkyLight::wanted(const SkyRadiance& radiance) const {
    if (orders_ == SkyOrders::single) return radiance.single;
    Spectrum sum = not_negative(radiance.multiple);
    for (std::size_t c = 0; c < sum.size(); ++c) {
        sum[c] += radiance.ground[c];
        if (orders_ == SkyOrders::all) sum[c] += radiance.single[c];
    }
    return sum;
}

Spectrum not_negative(const Spectrum& higher_orders) {
    Spectrum result = higher_orders;
    for (double& value : result) value = std::max(value, 0.0);
    return result;
}

config::Atmosphere scattering_only(config::Atmosphere atmosphere,
                                   const std::vector<std::string>& layers) {
    if (layers.empty()) return atmosphere;
    for (config::Layer& layer : atmosphere.layers) {
        if (std::find(layers.begin(), layers.end(), layer.name) != layers.end()) continue;
        for (config::InverseLength& scattering : layer.scattering) scattering = {};
    }
    return atmosphere;
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
