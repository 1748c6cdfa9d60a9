#include "bakers/render/cloud_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/math/parallel.h"
#include "bakers/render/cloud_air.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/sky_view.h"

namespace skybake {

namespace {

// A block of rays is a square of pixels, ordered in groups of four by four, so that the rays of one
// vector have similar directions.
constexpr int kTile = 16;
static_assert(kTile * kTile == RayBlock::kCount);

struct TilePixel {
    int x;
    int y;
};
TilePixel tile_pixel(int i) {
    return {(i & 3) | ((i >> 2) & 12), ((i >> 2) & 3) | ((i >> 4) & 12)};
}

class ViewMarch {
  public:
    ViewMarch(const CloudMedium& medium, const CloudViewSettings& settings, int threads)
        : rays_(settings.camera, settings.width, settings.height),
          march_(medium, settings.camera.position_m, settings.sun,
                 {settings.step_m, settings.light_step_m, settings.reach_m, settings.leaping,
                  settings.sunlit},
                 threads) {}

    double through() const { return march_.through(); }

    FetchCounts march_tile(int tile_x, int tile_y, Image2<float>& image) const {
        RayBlock block;
        for (int i = 0; i < RayBlock::kCount; ++i) {
            const TilePixel pixel = tile_pixel(i);
            const int x = tile_x * kTile + pixel.x;
            const int y = tile_y * kTile + pixel.y;
            if (x < image.width && y < image.height) {
                march_.set_ray(block, static_cast<std::size_t>(i), rays_.through(x, y),
                               gradient_noise(x, y, 0), gradient_noise(x, y, 1));
            }
        }
        RayResults results;
        FetchCounts counts;
        march_.march(block, results, counts);
        for (int i = 0; i < RayBlock::kCount; ++i) {
            const TilePixel pixel = tile_pixel(i);
            const int x = tile_x * kTile + pixel.x;
            const int y = tile_y * kTile + pixel.y;
            if (x >= image.width || y >= image.height) continue;
            const auto ray = static_cast<std::size_t>(i);
            const float values[] = {results.sun_at_base[ray],   results.sun_at_top[ray],
                                    results.from_sky[ray],      results.from_ground[ray],
                                    results.transmittance[ray], results.distance_m[ray]};
            std::copy(std::begin(values), std::end(values), image.texel(x, y));
        }
        return counts;
    }

  private:
    CameraRays rays_;
    LayerMarch march_;
};

}  // namespace

MarchedView march_view(const CloudMedium& medium, const CloudViewSettings& settings, int threads,
                       Progress* progress) {
    const ViewMarch march(medium, settings, threads);
    MarchedView view;
    view.through = march.through();
    view.results = Image2<float>(settings.width, settings.height, MarchedView::kChannels);
    const int across = (settings.width + kTile - 1) / kTile;
    const int down = (settings.height + kTile - 1) / kTile;
    std::vector<FetchCounts> counts(static_cast<std::size_t>(across * down));
    const BakeOptions options{threads, Certification::off, progress};
    for_each_tile(across * down, options, "marching", [&](int tile) {
        counts[static_cast<std::size_t>(tile)] =
            march.march_tile(tile % across, tile / across, view.results);
    });
    for (const FetchCounts& count : counts) {
        view.fetches.samples += count.samples;
        view.fetches.light_samples += count.light_samples;
        view.fetches.cells += count.cells;
    }
    return view;
}

namespace {

double clamped_altitude_km(const Shell& shell, double altitude_m) {
    return std::clamp(altitude_m / 1000, 0.0, shell.thickness_km);
}

Spectrum sunlight_at(const Atmosphere& atmosphere, double altitude_m, const SunDirection& sun) {
    const Shell shell = shell_of(atmosphere.medium.air);
    const double altitude_km = clamped_altitude_km(shell, altitude_m);
    const double r = shell.ground_radius_km + altitude_km;
    return look_up_sunlight(atmosphere.tables, shell, altitude_km,
                            r * sine_of_degrees(sun.elevation_degrees));
}

// Returns the mean radiance over the directions between two elevations, all with the same weight.
Spectrum mean_radiance(const Atmosphere& atmosphere, double altitude_m, const SunDirection& sun,
                       double lowest_degrees, double highest_degrees, int threads) {
    SkyView view;
    view.projection = SkyProjection::panorama;
    view.width = 64;
    view.height = 64;
    view.camera_altitude_km = clamped_altitude_km(shell_of(atmosphere.medium.air), altitude_m);
    view.sun_elevation_degrees = sun.elevation_degrees;
    view.lowest_degrees = lowest_degrees;
    view.highest_degrees = highest_degrees;
    const Image2<float> radiance = render_sky(atmosphere.medium, atmosphere.tables, view, threads);
    Spectrum sum{};
    double weights = 0;
    for (int y = 0; y < radiance.height; ++y) {
        const double t = (y + 0.5) / radiance.height;
        const double weight =
            cosine_of_degrees(highest_degrees + t * (lowest_degrees - highest_degrees));
        for (int x = 0; x < radiance.width; ++x) {
            for (int c = 0; c < radiance.channels; ++c) {
                sum[static_cast<std::size_t>(c)] += weight * double{radiance.texel(x, y)[c]};
            }
            weights += weight;
        }
    }
    return sum / weights;
}

// Returns the range of elevations that a picture shows.
CloudAir::Range range_of(const CloudViewSettings& settings, const CameraRays& rays) {
    double lowest = 90;
    double highest = -90;
    for (int x = 0; x < settings.width; ++x) {
        for (int y = 0; y < settings.height; ++y) {
            if (x != 0 && x != settings.width / 2 && y != 0 && y != settings.height - 1) continue;
            const double elevation =
                90 - arc_cosine(std::clamp(rays.through(x, y).z, -1.0, 1.0)) * kDegreesPerRadian;
            lowest = std::min(lowest, elevation);
            highest = std::max(highest, elevation);
        }
    }
    CloudAir::Range range;
    range.degrees_per_pixel = settings.camera.horizontal_field_degrees / settings.width;
    range.lowest_degrees = std::max(lowest - range.degrees_per_pixel, -90.0);
    range.highest_degrees = std::min(highest + range.degrees_per_pixel, 90.0);
    range.reach_m = settings.reach_m;
    return range;
}

// Calculates the radiance of the cloud in a pixel from the results of its march.
Spectrum cloud_radiance(const CloudIllumination& light, const float* seen) {
    return light.sun_at_base * double{seen[0]} + light.sun_at_top * double{seen[1]} +
           light.sky * double{seen[2]} + light.ground * double{seen[3]};
}

}  // namespace

CloudIllumination illumination(const CloudMedium& medium, const Atmosphere& atmosphere,
                               const SunDirection& sun, int threads) {
    const double top_m = medium.base_m + medium.extent_m[2];
    CloudIllumination light;
    light.sun_at_base = sunlight_at(atmosphere, medium.base_m, sun);
    light.sun_at_top = sunlight_at(atmosphere, top_m, sun);
    light.sky = mean_radiance(atmosphere, top_m, sun, 0, 90, threads);
    light.ground = mean_radiance(atmosphere, medium.base_m, sun, -90, 0, threads);
    return light;
}

CloudView render_cloud(const CloudMedium& medium, const Atmosphere& atmosphere,
                       const CloudViewSettings& settings, int threads, Progress* progress) {
    const int channels = atmosphere.medium.air.channels;
    CloudIllumination light = illumination(medium, atmosphere, settings.sun, threads);
    CloudViewSettings lit_settings = settings;
    const Spectrum dark{};
    if (light.sun_at_base == dark && light.sun_at_top == dark) lit_settings.sunlit = false;
    const MarchedView marched = march_view(medium, lit_settings, threads, progress);
    light.ground *= marched.through;
    const CameraRays rays(settings.camera, settings.width, settings.height);
    const CloudAir air(atmosphere, settings.camera, settings.sun, range_of(settings, rays),
                       threads);
    CloudView view;
    view.fetches = marched.fetches;
    view.radiance = Image2<float>(settings.width, settings.height, channels);
    parallel_for(settings.height, threads, [&](int y) {
        for (int x = 0; x < settings.width; ++x) {
            const glm::dvec3 direction = rays.through(x, y);
            const double elevation =
                90 - arc_cosine(std::clamp(direction.z, -1.0, 1.0)) * kDegreesPerRadian;
            const double level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
            const double turn = level > 0 ? arc_cosine(std::clamp(direction.x / level, -1.0, 1.0)) *
                                                kDegreesPerRadian
                                          : 0;
            const double azimuth = direction.y < 0 ? -turn : turn;
            const float* seen = marched.results.texel(x, y);
            const double opacity = 1 - double{seen[4]};
            const double distance = opacity > 0 ? double{seen[5]} / opacity : 0;
            const CloudAir::Along along = air.along(elevation, azimuth, distance);
            const Spectrum cloud = cloud_radiance(light, seen);
            for (int c = 0; c < channels; ++c) {
                const auto i = static_cast<std::size_t>(c);
                view.radiance.texel(x, y)[c] = static_cast<float>(
                    along.transmittance[i] * cloud[i] + opacity * along.in_scattered[i] +
                    double{seen[4]} * along.sky[i]);
            }
        }
    });
    return view;
}

}  // namespace skybake
