#include "bakers/plan/cloud_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/math/vectors.h"
#include "bakers/plan/marched_cloud.h"
#include "config/sweep/sobol.h"

namespace skybake {

CloudRange cloud_range(const config::Scene& scene, const Cloud& cloud) {
    CloudRange range;
    range.lowest_altitude_m = scene.altitude[0].meters;
    range.highest_altitude_m = scene.altitude[1].meters;
    range.base_m = cloud.base_altitude.meters;
    range.height_m = cloud.extent[2].meters;
    range.view_distance_m = scene.view_distance.meters;
    range.has_own_suns = !scene.suns.empty();
    const auto add = [&](double sun_deg) {
        if (sun_deg >= kLowestCloudSun_deg) range.suns_deg.push_back(sun_deg);
    };
    for (const config::Angle& sun : scene.suns) add(sun.radians * kDegreesPerRadian);
    if (range.has_own_suns) return range;
    const double lowest =
        std::max(scene.sun_elevation[0].radians * kDegreesPerRadian, kLowestCloudSun_deg);
    const double highest = scene.sun_elevation[1].radians * kDegreesPerRadian;
    for (const double sun_deg : {10.0, 30.0, 60.0}) {
        const double within = std::clamp(sun_deg, std::min(lowest, highest), highest);
        if (range.suns_deg.empty() || range.suns_deg.back() != within) add(within);
    }
    return range;
}

std::vector<CloudView> cloud_views(const CloudRange& range, int count, std::uint32_t first) {
    std::vector<CloudView> views;
    for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(count); ++i) {
        const auto share = [i](int dimension) { return config::sobol_coordinate(i, dimension); };
        const double altitude_m = range.lowest_altitude_m +
                                  share(1) * (range.highest_altitude_m - range.lowest_altitude_m);
        const double height = (altitude_m - range.base_m) / range.height_m;  // 0 to 1: within
        const bool looks_up = height <= 0 || (height < 1 && share(6) < 0.5);
        const double rise_m = (looks_up ? 1 - height : height) * range.height_m;
        const double lowest = std::asin(std::min(1.0, rise_m / range.view_distance_m));
        const double elevation = lowest + share(2) * (std::numbers::pi / 2 - lowest);
        CloudView view;
        view.sun = static_cast<std::size_t>(share(0) * static_cast<double>(range.suns_deg.size()));
        view.look = cloud_light::towards(looks_up ? elevation : -elevation,
                                         2 * std::numbers::pi * share(3));
        view.place = {share(4), share(5), std::clamp(height, 0.0, 1.0)};
        views.push_back(view);
    }
    return views;
}

namespace {

constexpr double kCovered = 0.01;
constexpr std::uint64_t kSeed = 29;

glm::dvec3 towards_sun(double elevation_deg) {
    return cloud_light::towards(elevation_deg / kDegreesPerRadian, 0);
}

}  // namespace

CloudTruth::CloudTruth(const cloud_light::CloudLayer& layer, const CloudRange& range,
                       std::vector<CloudView> views, const BakeOptions& options)
    : layer_(layer),
      range_(range),
      options_(options),
      views_(std::move(views)),
      light_(views_.size()) {}

glm::dvec3 CloudTruth::sun(const CloudView& view) const {
    return towards_sun(range_.suns_deg[view.sun]);
}

bool CloudTruth::is_covered(const CloudView& view) const {
    CloudWay plain;
    plain.single = true;
    plain.sun_samples = 1;
    CloudTextures textures;
    textures.layer = &layer_;
    return march_cloud(plain, textures, view.place, view.look, sun(view)).passed < 1 - kCovered;
}

void CloudTruth::trace(double paths) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (is_covered(views_[i])) covered_.push_back(i);
    }
    if (covered_.empty()) return;
    paths_ = static_cast<int>(std::ceil(paths / static_cast<double>(covered_.size())));
    std::vector<cloud_light::CloudPaths> of_suns;
    for (const double sun_deg : range_.suns_deg) {
        cloud_light::LayerSources sources;
        sources.sun = 1;
        sources.sun_direction = towards_sun(sun_deg);
        of_suns.emplace_back(layer_,
                             cloud_light::scattering_of(cloud_phase(layer_.optics.particles), 1),
                             sources, options_.threads);
    }
    const glm::dvec3 voxels(layer_.size[0], layer_.size[1], layer_.size[2]);
    for_each_tile(static_cast<int>(covered_.size()), options_, "tracing paths", [&](int n) {
        const std::size_t i = covered_[static_cast<std::size_t>(n)];
        const CloudView& view = views_[i];
        light_[i] = of_suns[view.sun].trace(view.place * voxels, view.look, paths_, kSeed,
                                            static_cast<std::uint32_t>(i));
    });
}

// Returns 0 where paths find no light.
double CloudTruth::exposure() const {
    std::vector<double> seen;
    for (const std::size_t i : covered_) seen.push_back(light_[i].sum());
    std::ranges::sort(seen);
    if (seen.empty() || !(seen[seen.size() * 9 / 10] > 0)) return 0;
    return 1.5 / seen[seen.size() * 9 / 10];
}

SkyError CloudTruth::error(const std::vector<double>& found, double& rms) const {
    SkyError error;
    const double k = exposure();
    if (k == 0) {
        error.left_out = 1;
        return error;
    }
    double squares = 0;
    double noise = 0;
    std::vector<double> errors;
    for (const std::size_t i : covered_) {
        const cloud_light::TracedRadiance& traced = light_[i];
        const double shown = std::exp(-k * traced.sum());
        // Few harmonics may add up to less than nothing, which a picture shows as black.
        errors.push_back(std::fabs(std::exp(-k * std::max(found[i], 0.0)) - shown));
        squares += errors.back() * errors.back();
        noise += std::pow(shown * k * traced.standard_error, 2);
    }
    const auto count = static_cast<double>(errors.size());
    std::ranges::sort(errors);
    rms = std::sqrt(std::max(squares - noise, 0.0) / count);
    const auto decile = [&](double share) {
        return errors[static_cast<std::size_t>(share * (count - 1))];
    };
    error.median = decile(0.5);
    error.ninth_decile = decile(0.9);
    error.max = decile(1);
    error.points = static_cast<int>(errors.size());
    error.standard_error = std::sqrt(noise / count);
    error.reference = fmt::format("{} paths of light in {} of {} views, through {}x{}x{} voxels",
                                  paths_ * error.points, error.points, views_.size(),
                                  layer_.size[0], layer_.size[1], layer_.size[2]);
    return error;
}

}  // namespace skybake
