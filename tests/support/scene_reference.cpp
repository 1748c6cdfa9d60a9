#include "tests/support/scene_reference.h"

#include <algorithm>
#include <cmath>

#include "bakers/march/cloud_light.h"
#include "bakers/render/cloud_camera.h"
#include "tests/support/light_in_cloud_reference.h"

namespace skybake {
namespace {

int wrapped_index(double index, int size) {
    const double turns = std::floor(index / size);
    return static_cast<int>(index - turns * size);
}

double voxel(const PaddedVolume& volume, double x, double y, double z) {
    const int i = wrapped_index(x, volume.size[0]);
    const int j = wrapped_index(y, volume.size[1]);
    const int k = static_cast<int>(std::clamp(z, 0.0, volume.size[2] - 1.0));
    return volume.values[static_cast<std::size_t>((k + 1) * volume.plane() +
                                                  (j + 1) * volume.row() + i + 1)];
}

// In voxels, where voxel i has its centre at i + 1/2.
double trilinear(const PaddedVolume& volume, const glm::dvec3& at) {
    const glm::dvec3 low = glm::floor(at - 0.5);
    const glm::dvec3 t = at - 0.5 - low;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = corner >> 1 & 1;
        const int k = corner >> 2;
        sum += (i != 0 ? t.x : 1 - t.x) * (j != 0 ? t.y : 1 - t.y) * (k != 0 ? t.z : 1 - t.z) *
               voxel(volume, low.x + i, low.y + j, low.z + k);
    }
    return sum;
}

double eroded(double weight) { return std::max(0.0, 1 - 1.6 * weight); }

// The weight at a place of tile number `tile` along an axis: 1 within it, 1/2 at its borders.
double tile_weight(double at, double tile, double size, double margin) {
    const double inside = std::min(at - tile * size, (tile + 1) * size - at);
    const double x = std::clamp(std::fabs(inside) / margin, 0.0, 1.0);
    const double half = 0.5 * x * x * (3 - 2 * x);
    return inside >= 0 ? 0.5 + half : 0.5 - half;
}

// All copies around a place, whether they reach it or not.
double varied_value(const CloudMedium& medium, const glm::dvec3& at) {
    const TileVariation& variation = medium.variation;
    const std::array<int, 3>& size = medium.volume.size;
    double value = -1e300;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const double i = std::floor(at.x / size[0]) + dx;
            const double j = std::floor(at.y / size[1]) + dy;
            const auto copy = static_cast<std::size_t>(
                wrapped_index(j, kVariedTiles) * kVariedTiles + wrapped_index(i, kVariedTiles));
            const double erosion =
                std::max(eroded(tile_weight(at.x, i, size[0], variation.margin_x)),
                         eroded(tile_weight(at.y, j, size[1], variation.margin_y)));
            const glm::dvec3 moved = at + glm::dvec3(variation.shift_x[copy] - i * size[0],
                                                     variation.shift_y[copy] - j * size[1], 0);
            value = std::max(
                value, trilinear(medium.volume, moved) - erosion * double{variation.greatest});
        }
    }
    return value;
}

glm::dvec3 to_voxels(const CloudMedium& medium, const glm::dvec3& at) {
    return {at.x / medium.meters_per_voxel(0), at.y / medium.meters_per_voxel(1),
            (at.z - medium.base_m) / medium.meters_per_voxel(2)};
}

double share(const CloudMedium& medium, const PaddedVolume& shares, const glm::dvec3& at) {
    glm::dvec3 place = to_voxels(medium, at);
    for (std::size_t a = 0; a < 3; ++a) place[a] *= double(shares.size[a]) / medium.volume.size[a];
    return trilinear(shares, place);
}

}  // namespace

double reference_extinction(const CloudMedium& medium, const glm::dvec3& at) {
    const glm::dvec3 place = to_voxels(medium, at);
    if (place.z < 0 || place.z > medium.volume.size[2]) return 0;
    const double value =
        medium.variation.varies() ? varied_value(medium, place) : trilinear(medium.volume, place);
    return medium.optics.extinction_per_m * density(medium.optics, value);
}

double reference_depth(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                       const glm::dvec3& from, int steps) {
    const glm::dvec3 direction = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    double sum = 0;
    for (const SceneLayer& layer : layers) {
        const CloudMedium& medium = *layer.medium;
        const double low = medium.base_m - from.z;
        const double high = low + medium.extent_m[2];
        double first = 0;
        double last = sun_march_length_m(medium, sun);
        if (direction.z != 0) {
            const double enters = (direction.z > 0 ? low : high) / direction.z;
            const double leaves = (direction.z > 0 ? high : low) / direction.z;
            first = std::max(enters, 0.0);
            last = std::min(first + last, leaves);
        } else if (low > 0 || high < 0) {
            continue;
        }
        if (!(first < last)) continue;
        const double step = (last - first) / steps;
        for (int i = 0; i < steps; ++i) {
            sum +=
                step * reference_extinction(medium, from + (first + (i + 0.5) * step) * direction);
        }
    }
    return sum;
}

// Layers that repeat fade smoothly over the last 33 % of their reach.
double not_faded(const SceneLayer& layer, double distance_m) {
    const double left = 1 - distance_m / layer.reach_m;
    if (!layer.medium->repeats) return left >= 0 ? 1 : 0;
    const double x = std::clamp(left / 0.33, 0.0, 1.0);
    return 3 * x * x - 2 * x * x * x;
}

ReferenceScene reference_scene(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                               const CloudCamera& camera, const glm::dvec3& direction, int steps) {
    ReferenceScene scene;
    scene.layers.resize(layers.size());
    double first = 1e300;
    double last = 0;
    std::vector<DiffuseShare> diffuse;
    for (const SceneLayer& layer : layers) {
        const RaySpan span =
            span_in_layer(*layer.medium, camera.position_m, direction, layer.reach_m);
        diffuse.push_back(diffuse_share(*layer.medium, 4, 1));
        if (span.first_m >= span.last_m) continue;
        first = std::min(first, span.first_m);
        last = std::max(last, span.last_m);
    }
    if (!(first < last)) return scene;
    const glm::dvec3 to_sun = direction_of(sun.elevation_degrees, sun.azimuth_degrees);
    const auto octaves = octave_phases(droplet_phase(kDropletDiameter_um));
    const double step = (last - first) / steps;
    for (int i = 0; i < steps; ++i) {
        const double t = first + (i + 0.5) * step;
        const glm::dvec3 at = camera.position_m + t * direction;
        std::vector<double> sigma;
        double whole = 0;
        for (const SceneLayer& layer : layers) {
            const double met = layer.solved != nullptr ? layer.solved->share : 1;
            sigma.push_back(met * not_faded(layer, t) * reference_extinction(*layer.medium, at));
            whole += sigma.back();
        }
        if (whole == 0) continue;
        const double through = exponential(-whole * step);
        const double offset = one_minus_cosine(direction, to_sun);
        const double tau = reference_depth(layers, sun, at, steps / 4);
        for (std::size_t l = 0; l < layers.size(); ++l) {
            const CloudMedium& medium = *layers[l].medium;
            const double weight = scene.transmittance * (1 - through) * sigma[l] / whole;
            const double height = (at.z - medium.base_m) / medium.extent_m[2];
            if (!(weight > 0)) continue;
            double sunlight = sun_scattering(octaves, offset, tau);
            double from_sky = 0.5 * share(medium, diffuse[l].from_sky, at);
            double from_ground = 0.5 * share(medium, diffuse[l].from_ground, at);
            if (layers[l].solved != nullptr) {
                const double own = reference_depth({layers[l]}, sun, at, steps / 4);
                const glm::dvec3 place = glm::fract(
                    to_voxels(medium, at) / glm::dvec3(medium.volume.size[0], medium.volume.size[1],
                                                       medium.volume.size[2]));
                const ReferenceLight light =
                    reference_light(*layers[l].solved, direction, offset, place, {tau, tau - own});
                sunlight = light.sun;
                from_sky = light.sky;
                from_ground = light.ground;
            }
            ReferenceLayer& seen = scene.layers[l];
            seen.sun_at_base += weight * sunlight * (1 - height);
            seen.sun_at_top += weight * sunlight * height;
            seen.from_sky += weight * from_sky;
            seen.from_ground += weight * from_ground;
            seen.opacity += weight;
            seen.distance_m += weight * t;
        }
        scene.transmittance *= through;
    }
    return scene;
}

}  // namespace skybake
