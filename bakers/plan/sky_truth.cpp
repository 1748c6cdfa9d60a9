#include "bakers/plan/sky_truth.h"

#include <utility>

namespace skybake {

namespace {

TracedLight light_of(const std::shared_ptr<const TracedAir>& air,
                     const std::vector<SkySample>& views, bool makes_colors) {
    TracedLight light;
    light.channels = makes_colors ? 3 : air->medium().air.channels;
    light.places = places_of(views);
    light.traced = {trace_of_sky(air, views, config::SkyOrders::all, false)};
    return light;
}

}  // namespace

SceneTruth::SceneTruth(const config::Atmosphere& air, std::vector<SkySample> views,
                       std::vector<glm::dvec3> weights, BakeOptions options)
    : views_(std::move(views)),
      options_(options),
      air_(std::make_shared<const TracedAir>(air)),
      weights_(std::move(weights)),
      light_(light_of(air_, views_, !weights_.empty())),
      comparison_(light_, weights_, options_) {}

std::vector<Spectrum> SceneTruth::as_compared(std::vector<Spectrum> light) const {
    if (weights_.empty()) return light;
    for (Spectrum& one : light) {
        glm::dvec3 color{};
        for (std::size_t c = 0; c < weights_.size(); ++c) color += one[c] * weights_[c];
        one = Spectrum(color, 0);
    }
    return light;
}

}  // namespace skybake
