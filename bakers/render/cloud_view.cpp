#include "bakers/render/cloud_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bakers/math/tiles.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/sun_leaps.h"

namespace skybake {

namespace {

// Blocks of rays are squares of pixels, four by four after each other: what a vector holds looks
// much the same way.
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
        : medium_(medium),
          settings_(settings),
          rays_(settings.camera, settings.width, settings.height),
          sun_(direction_of(settings.sun.elevation_degrees, settings.sun.azimuth_degrees)),
          diffuse_(diffuse_share(medium, 4, threads)) {
        march_.medium = &medium_;
        march_.diffuse = &diffuse_;
        for (std::size_t a = 0; a < 3; ++a) {
            const double origin = settings.camera.position_m[a] - (a == 2 ? medium.base_m : 0);
            march_.origin[a] = static_cast<float>(origin / medium.meters_per_voxel(a));
            march_.light_direction[a] = static_cast<float>(sun_[a] / medium.meters_per_voxel(a));
        }
        march_.step_m = static_cast<float>(settings.step_m);
        march_.light_step_m = static_cast<float>(settings.light_step_m);
        if (settings.sunlit) {
            march_.light_samples = static_cast<float>(
                std::ceil(sun_march_length_m(medium, settings.sun) / settings.light_step_m));
        }
        march_.leaping = settings.leaping;
        if (settings.leaping) march_.sun_leaps = leaps_towards_sun(threads);
    }

    double through() const { return diffuse_.through; }

    FetchCounts march_tile(int tile_x, int tile_y, Image2<float>& image) const {
        RayBlock block;
        for (int i = 0; i < RayBlock::kCount; ++i) {
            const TilePixel pixel = tile_pixel(i);
            const int x = tile_x * kTile + pixel.x;
            const int y = tile_y * kTile + pixel.y;
            if (x < image.width && y < image.height) {
                set_ray(block, static_cast<std::size_t>(i), x, y);
            }
        }
        RayResults results;
        FetchCounts counts;
        march_cloud_rays(march_, block, results, counts);
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
    std::vector<float> leaps_towards_sun(int threads) const {
        const auto& direction = march_.light_direction;
        const glm::dvec3 step =
            double{march_.light_step_m} * glm::dvec3(direction[0], direction[1], direction[2]);
        return sun_leaps(medium_.leaps, medium_.volume.size, step,
                         static_cast<int>(march_.light_samples), threads);
    }

    void set_ray(RayBlock& block, std::size_t i, int x, int y) const {
        const glm::dvec3 direction = rays_.through(x, y);
        const RaySpan span = span_in_layer(medium_, settings_.camera, direction, settings_.reach_m);
        for (std::size_t a = 0; a < 3; ++a) {
            block.direction[a][i] = static_cast<float>(direction[a] / medium_.meters_per_voxel(a));
        }
        block.sun_offset[i] = static_cast<float>(one_minus_cosine(direction, sun_));
        block.jitter[i] = gradient_noise(x, y, 0);
        block.light_jitter[i] = gradient_noise(x, y, 1);
        if (span.first_m > span.last_m) return;  // 0 ... 0: no samples
        // One sample more on each side: the march looks whether they are within.
        block.first[i] =
            static_cast<float>(std::max(std::floor(span.first_m / settings_.step_m) - 1, 0.0));
        block.end[i] = static_cast<float>(std::ceil(span.last_m / settings_.step_m) + 1);
    }

    const CloudMedium& medium_;
    const CloudViewSettings& settings_;
    CameraRays rays_;
    glm::dvec3 sun_;
    DiffuseShare diffuse_;
    CloudMarch march_;
};

}  // namespace

double sun_march_length_m(const CloudMedium& medium, const SunDirection& sun) {
    const double longest = medium.repeats ? std::max(medium.extent_m[0], medium.extent_m[1])
                                          : std::hypot(medium.extent_m[0], medium.extent_m[1]);
    const double slope = std::fabs(sine_of_degrees(sun.elevation_degrees));
    return slope * longest > medium.extent_m[2] ? medium.extent_m[2] / slope : longest;
}

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

}  // namespace skybake
