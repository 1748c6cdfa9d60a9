#include "bakers/assets/cloud_light/radiance_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/assets/cloud_light/depth_reference.h"
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/description/estimate.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake::cloud_light {
namespace {

// All that a solution depends on, but for what light of the sky does.
struct SolutionKey {
    NeedKey voxels;
    PixelType pixel_type{};  // to which the layer's voxels are rounded
    std::string channel;
    CloudLightContents contents{};
    std::array<double, 2> sun{};  // elevation and azimuth in radians
    int degree = 0;
    int cell = 0;
    double droplet_diameter_m = 0;
    double albedo = 0;
    bool operator==(const SolutionKey&) const = default;
};

// Each source has the strength 1. `sky` is that above the layer, if it has one.
LayerSources sources_of(const CloudLightBake& bake, const SkyByDirection& sky) {
    LayerSources sources;
    switch (bake.contents) {
        case CloudLightContents::sky_radiance:
            sources.sky = 1;
            break;
        case CloudLightContents::clear_sky_radiance:
            sources.sky = 1;
            sources.sky_shape = sky;
            break;
        case CloudLightContents::ground_radiance:
            sources.ground = 1;
            break;
        default:
            sources.sun = 1;
            sources.sun_direction = sun_directions(bake).front();
    }
    return sources;
}

// Means over paths of the coefficients of all light at a place but the sun's own.
struct TracedCoefficients {
    Harmonics means{};
    Harmonics standard_errors{};
    double collisions = 0;  // of a path
};

TracedCoefficients trace_coefficients(const CloudPaths& paths, const glm::dvec3& place,
                                      std::uint32_t ray, std::uint64_t seed, int count) {
    constexpr std::size_t kGroups = 16;  // each has directions that are spread evenly
    std::array<Harmonics, kGroups> groups{};
    TracedRadiance light;
    for (int i = 0; i < count; ++i) {
        RandomStream random(seed, ray, static_cast<std::uint64_t>(i));
        glm::dvec3 look;
        const double share = (i + random.next()) / count;
        const double density = paths.draw_direction(share, random, look);
        light = {.collisions = light.collisions};
        paths.walk(place, look, random, light);
        const Harmonics values = harmonics(-look);
        Harmonics& group = groups[static_cast<std::size_t>(i) % kGroups];
        for (std::size_t c = 0; c < group.size(); ++c) {
            group[c] += light.sum() / (density * count) * values[c];
        }
    }
    TracedCoefficients traced;
    for (std::size_t c = 0; c < traced.means.size(); ++c) {
        double squares = 0;
        for (const Harmonics& group : groups) {
            traced.means[c] += group[c];
            squares += group[c] * group[c];
        }
        const double spread = squares - traced.means[c] * traced.means[c] / kGroups;
        traced.standard_errors[c] = std::sqrt(std::max(spread, 0.0) * kGroups / (kGroups - 1));
    }
    traced.collisions = static_cast<double>(light.collisions) / count;
    return traced;
}

// Returns the place at texture coordinates, in voxels.
glm::dvec3 place_in(const CloudLayer& layer, const std::array<double, 3>& uvw) {
    return {uvw[0] * layer.size[0], uvw[1] * layer.size[1], uvw[2] * layer.size[2]};
}

// Other paths tell how many collisions there are, so that the paths whose light counts are not chosen by what
// happens to them.
TracedCoefficients traced_coefficients(const CloudPaths& paths, const glm::dvec3& place,
                                       std::uint32_t ray) {
    constexpr std::uint64_t kSeed = 176;
    constexpr int kCounted = 32;
    const double collisions = trace_coefficients(paths, place, ray, kSeed + 1, kCounted).collisions;
    const double most = kReferenceCollisions / std::max(collisions, 1.0);
    const auto count =
        static_cast<int>(std::clamp<double>(most, kFewestReferencePaths, kReferencePaths));
    return trace_coefficients(paths, place, ray, kSeed, count);
}

}  // namespace

CloudScattering scattering_of(const CloudLayer& layer, const CloudLightBake& bake) {
    return scattering_of(cloud_phase(layer.optics.particles, bake.droplet_diameter.meters * 1e6),
                         bake.single_scattering_albedo);
}

ScaledScattering scaled_scattering_of(const CloudLayer& layer, const CloudLightBake& bake) {
    return scaled(scattering_of(layer, bake), bake.degree);
}

double unshaded_coefficient(const CloudLightBake& bake) {
    const double pi = std::numbers::pi;
    const double fluence = bake.contents == CloudLightContents::sun_radiance ? 1 : 2 * pi;
    return fluence / (2 * std::sqrt(pi));
}

std::optional<Need> solution_need(const SourceOfLayer& of, const CloudLightBake& bake) {
    if (!config::is_radiance(bake.contents)) return std::nullopt;
    if (bake.contents == CloudLightContents::clear_sky_radiance) return std::nullopt;
    constexpr double kSecondsPerCoefficient = 2.5e-7;  // of a place, over all sweeps
    const PlaceGrid places = place_grid(of.size, cloud_light_spacing(bake), false);
    const double coefficients = (bake.degree + 1) * (bake.degree + 1) * voxels_of(places.count, 1);
    SolutionKey key = {of.voxels,
                       of.pixel_type,
                       bake.channel,
                       bake.contents,
                       {0, 0},
                       bake.degree,
                       bake.cell,
                       bake.droplet_diameter.meters,
                       bake.single_scattering_albedo};
    if (bake.contents == CloudLightContents::sun_radiance) {
        const double azimuth = bake.sun_azimuths.empty() ? 0 : bake.sun_azimuths.front().radians;
        key.sun = {bake.sun_elevations.front().radians, azimuth};
    }
    return Need{NeedKey(std::move(key)), "radiance in " + bake.of,
                kSecondsPerCoefficient * coefficients, coefficients * sizeof(float) / kMebibyte};
}

std::vector<std::vector<float>> radiance_values(const CloudLayer& layer, const PlaceGrid& places,
                                                const CloudLightBake& bake,
                                                const BakeOptions& options, Facts& details) {
    const auto solve = [&]() -> std::shared_ptr<const SolvedRadiance> {
        const BakeTime time(BakePart::light);
        auto solved = std::make_shared<const SolvedRadiance>(
            solve_radiance(layer, places, scattering_of(layer, bake), bake.degree,
                           sources_of(bake, layer.sky.shape), options));
        return options.cancelled() ? nullptr : solved;
    };
    const auto solved = layer.solution ? shared_or_made<SolvedRadiance>(options.intermediates,
                                                                        *layer.solution, solve)
                                       : solve();
    if (!solved) return {};
    details.emplace_back("sweeps", static_cast<double>(solved->sweeps));
    details.emplace_back("last_change", to_digits(solved->change, 3));
    std::vector<std::vector<float>> values;
    for (std::size_t c = 0; c < config::channels_of(bake); ++c) {
        values.push_back(
            values_of(solved->scattered, static_cast<std::size_t>(4 * (bake.part - 1)) + c));
    }
    return values;
}

bool has_long_paths(const CloudLayer& layer, const CloudLightBake& bake,
                    const VolumeComparison& comparison, int threads) {
    constexpr int kPlaces = 16;
    constexpr int kPaths = 64;  // from each place: few of them have most of the collisions
    const CloudPaths paths(layer, scattering_of(layer, bake), sources_of(bake, layer.sky.reference),
                           threads);
    constexpr std::int64_t kMost = kPlaces * kPaths * kMostCollisionsOfPath;
    TracedRadiance light;
    for (int i = 0; i < kPlaces; ++i) {
        const glm::dvec3 place = place_in(layer, comparison.lookup_place(low_discrepancy_point(i)));
        RandomStream random(0, static_cast<std::uint32_t>(i), 0);
        for (int path = 0; path < kPaths; ++path) {
            glm::dvec3 look;
            paths.draw_direction((path + 0.5) / kPaths, random, look);
            paths.walk(place, look, random, light, kMost);
        }
    }
    return light.collisions >= kMost;
}

VolumeReference radiance_reference(const CloudLayer& layer, const CloudLightBake& bake,
                                   int threads) {
    const LayerSources sources = sources_of(bake, layer.sky.reference);
    const auto paths =
        std::make_shared<const CloudPaths>(layer, scattering_of(layer, bake), sources, threads);
    return [&layer, paths, sources, bake,
            scattering = scaled_scattering_of(layer, bake)](const std::array<double, 3>& uvw) {
        const glm::dvec3 place = place_in(layer, uvw);
        // Places that differ along u have random numbers of their own.
        const auto ray = static_cast<std::uint32_t>(std::clamp(uvw[0], 0.0, 1.0) * 0xffffffffU);
        const TracedCoefficients traced = traced_coefficients(*paths, place, ray);
        Harmonics light = traced.means;
        if (sources.sun > 0) {
            const double depth = optical_depth_reference(layer, place, sources.sun_direction);
            const double more =
                exponential(-depth) - exponential(-scattering.extinction_share * depth);
            const Harmonics onwards = harmonics(-sources.sun_direction);
            for (std::size_t c = 0; c < light.size(); ++c) light[c] += more * onwards[c];
        }
        std::vector<double> values;
        for (const Harmonics& coefficients : {light, traced.standard_errors}) {
            for (std::size_t c = 0; c < config::channels_of(bake); ++c) {
                const std::size_t i = static_cast<std::size_t>(4 * (bake.part - 1)) + c;
                values.push_back(scattering.returned[degree_of_harmonic(i)] * coefficients[i]);
            }
        }
        return values;
    };
}

}  // namespace skybake::cloud_light
