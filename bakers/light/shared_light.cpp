#include "bakers/light/shared_light.h"

#include <algorithm>

#include "bakers/air/forward_peak.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/solver/solution_levels.h"
#include "bakers/math/bake_clock.h"
#include "config/sections/layer.h"

namespace skybake {
namespace {

constexpr double kSecondsOfDegree8 = 1.2;  // to solve for the light of Earth's sky
constexpr double kMibOfLight = 8;
constexpr double kSecondsOfSunlight = 0.1;
constexpr double kMibOfSunlight = 24;

// Requests for the same light in different words are made equal, where that costs nothing: spheres
// cost seconds before their moments are known.
LightRequest in_plain_words(LightRequest request) {
    if (has_spheres(request.atmosphere)) return request;
    const SkyMedium medium = make_sky_medium(request.atmosphere);
    const SkyMedium without = without_forward_peaks(medium);
    if (without == medium) request.peaks_of_spheres = false;
    if (request.degree == 0) request.degree = sky_degree(medium_of(request));
    return request;
}

// How much more a solution costs than that of Earth's air: rays pass all levels on their way to each of
// them, and light is sent on until it has left. For spheres it is not known before they are computed.
double effort_of(const LightRequest& request) {
    constexpr double kLevelsOfEarth = 45;
    constexpr double kMostOften = 10;  // measured at a depth of 100
    if (has_spheres(request.atmosphere)) return 1;
    const SkyMedium medium = medium_of(request);
    Spectrum depth{};
    for (const SkyLayer& layer : medium.layers) {
        if (layer.scatters) depth += scattering_depth(layer, 0, medium.air.ground_radius_km);
    }
    const double levels =
        static_cast<double>(solution_levels_km(medium.air, 1).size()) / kLevelsOfEarth;
    return std::max(levels * levels, 1.0) * std::min(1 + largest(depth) / 4, kMostOften);
}

SolverSettings settings_of(const LightRequest& request, const SkyMedium& medium) {
    SolverSettings settings;
    settings.degree = request.degree > 0 ? request.degree : sky_degree(medium);
    settings.orders = request.orders;
    if (!request.finer) return settings;
    settings = finer(settings);
    settings.degree += request.degree_more;
    return settings;
}

}  // namespace

bool has_spheres(const config::Atmosphere& atmosphere) {
    return std::ranges::any_of(atmosphere.layers, [](const config::Layer& layer) {
        return layer.phase == config::Phase::mie;
    });
}

SkyMedium medium_of(const LightRequest& request) {
    SkyMedium medium = make_sky_medium(request.atmosphere);
    if (!request.peaks_of_spheres) medium = without_forward_peaks(std::move(medium));
    return medium;
}

Need need_of(const LightRequest& request) {
    const LightRequest plain = in_plain_words(request);
    // Cost grows faster than the degree, and a finer solution has 1.5 times as many directions and
    // 1.25 times as many altitudes.
    const double degree = plain.degree > 0 ? plain.degree : 8;
    const double seconds =
        kSecondsOfDegree8 * degree / 8 * (plain.finer ? 2.3 : 1) * effort_of(plain);
    return {NeedKey(plain), plain.finer ? "finer light, a reference" : "solved light", seconds,
            kMibOfLight};
}

std::shared_ptr<const SolvedLight> light_of(const LightRequest& request, const SkyMedium& medium,
                                            const BakeOptions& options) {
    // Without a certificate a finer solution serves the choice of a size.
    const bool certifies = request.finer && options.certification != Certification::off;
    const BakeTime time(certifies ? BakePart::certificate : BakePart::light);
    const auto solve = [&] {
        if (options.progress != nullptr) options.progress->advance("solving light", 0);
        return std::make_shared<const SolvedLight>(
            solve_light(medium, settings_of(request, medium), options.threads, options.progress));
    };
    if (options.intermediates == nullptr) return solve();
    std::shared_ptr<const SolvedLight> unfinished;
    auto light = options.intermediates->get<SolvedLight>(
        need_of(request).key, [&]() -> std::shared_ptr<const SolvedLight> {
            auto solved = solve();
            if (!options.cancelled()) return solved;
            unfinished = std::move(solved);
            return nullptr;
        });
    return light ? light : unfinished;
}

SunlightRequest sunlight_request(const config::Atmosphere& atmosphere, config::SkyOrders orders) {
    if (orders != config::SkyOrders::single) return {atmosphere};
    if (has_spheres(atmosphere)) return {atmosphere, true};
    const SkyMedium medium = make_sky_medium(atmosphere);
    return {atmosphere, !(without_forward_peaks(medium) == medium)};
}

Need need_of(const SunlightRequest& request) {
    return {NeedKey(request), "table of sunlight", kSecondsOfSunlight, kMibOfSunlight};
}

std::shared_ptr<const TransmittanceField> make_sunlight(const Medium& air, int threads) {
    constexpr TransmittanceField::Size kSize = {1024, 256};
    return std::make_shared<const TransmittanceField>(air, quadrature_altitudes_km(air), kSize,
                                                      threads);
}

std::shared_ptr<const TransmittanceField> sunlight_of(const SunlightRequest& request,
                                                      const Medium& air,
                                                      const BakeOptions& options) {
    const BakeTime time(BakePart::light);
    return shared_or_made<TransmittanceField>(options.intermediates, NeedKey(request),
                                              [&] { return make_sunlight(air, options.threads); });
}

}  // namespace skybake
