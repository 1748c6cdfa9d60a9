#include "bakers/render/sky_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "bakers/air/ray.h"
#include "bakers/math/parallel.h"
#include "bakers/render/sky_march.h"

namespace skybake {

namespace {

// Half of the sun's mean angular diameter from Earth, 0.533 degrees.

std::array<float, kMaxChannels> floats(const Spectrum& values) {
    return {static_cast<float>(values.x), static_cast<float>(values.y),
            static_cast<float>(values.z), static_cast<float>(values.w)};
}

MarchLayer march_layer(const SkyLayer& layer) {
    MarchLayer result;
    if (!layer.alone.exponential_layers.empty()) {
        const ExponentialLayer& air = layer.alone.exponential_layers.front();
        result.scale_height_km = static_cast<float>(air.scale_height_km);
        result.scattering_per_km = floats(air.scattering_per_km);
        result.extinction_per_km = floats(air.extinction_per_km);
    } else {
        const PiecewiseLayer& air = layer.alone.piecewise_layers.front();
        for (const LinearPiece& piece : air.pieces) {
            result.pieces.push_back({static_cast<float>(piece.bottom_km),
                                     static_cast<float>(piece.top_km),
                                     static_cast<float>(piece.density_at_bottom),
                                     static_cast<float>(piece.density_per_km)});
        }
        result.scattering_per_km = floats(air.scattering_per_km);
        result.extinction_per_km = floats(air.extinction_per_km);
    }
    result.scatters = layer.scatters;
    return result;
}

SkyMarch make_march(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                    int steps) {
    const Medium& air = medium.air;
    SkyMarch sky;
    sky.channels = air.channels;
    sky.ground_radius_km = static_cast<float>(air.ground_radius_km);
    sky.thickness_km = static_cast<float>(air.thickness_km);
    sky.top_horizon_km = static_cast<float>(horizon_distance_km(shell_of(air), air.thickness_km));
    sky.camera_altitude_km = static_cast<float>(view.camera_altitude_km);
    sky.sun_s_km =
        static_cast<float>((air.ground_radius_km + view.camera_altitude_km) * sun_sine(view));
    sky.ground_albedo = floats(air.ground_albedo);
    for (const SkyLayer& layer : medium.layers) sky.layers.push_back(march_layer(layer));
    sky.tables = &tables;
    sky.steps = steps;
    return sky;
}

void add_ray(const SkyDirection& direction, MarchRays& rays) {
    rays.mu.push_back(static_cast<float>(direction.mu));
    rays.cosine_to_sun.push_back(static_cast<float>(direction.cosine_to_sun));
    ++rays.count;
}

// Fills in the phase functions of all layers for the directions of the rays.
void add_phases(const SkyMedium& medium, const std::vector<SkyDirection>& directions,
                MarchRays& rays) {
    const auto channels = static_cast<std::size_t>(medium.air.channels);
    rays.phases.resize(medium.layers.size() * channels * directions.size());
    for (std::size_t layer = 0; layer < medium.layers.size(); ++layer) {
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const Spectrum phase =
                phase_values(medium.layers[layer].phase, directions[i].one_minus_cosine,
                             directions[i].one_plus_cosine);
            for (std::size_t c = 0; c < channels; ++c) {
                rays.phases[(layer * channels + c) * directions.size() + i] =
                    static_cast<float>(phase[c]);
            }
        }
    }
}

// Renders the left half of a row; the right half is its mirror image.
template <class March>
void render_row(const SkyMedium& medium, const SkyMarch& sky, const SkyView& view, int y,
                const March& march, Image2<float>& image) {
    MarchRays rays;
    std::vector<int> columns;
    std::vector<SkyDirection> directions;
    for (int x = 0; x < (view.width + 1) / 2; ++x) {
        const std::optional<SkyDirection> direction = direction_at(view, x, y);
        if (!direction) continue;
        columns.push_back(x);
        directions.push_back(*direction);
    }
    if (columns.empty()) return;
    while (directions.size() % kMarchPadding != 0) directions.push_back(directions.back());
    for (const SkyDirection& direction : directions) add_ray(direction, rays);
    add_phases(medium, directions, rays);
    std::vector<float> radiance(static_cast<std::size_t>(rays.count * sky.channels));
    march(sky, rays, radiance.data());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (int c = 0; c < sky.channels; ++c) {
            const float value = radiance[static_cast<std::size_t>(c * rays.count) + i];
            image.texel(columns[i], y)[c] = value;
            image.texel(view.width - 1 - columns[i], y)[c] = value;
        }
    }
}

template <class March>
Image2<float> render(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                     int threads, int steps, const March& march) {
    const SkyMarch sky = make_march(medium, tables, view, steps);
    Image2<float> image(view.width, view.height, sky.channels);
    parallel_for(view.height, threads,
                 [&](int y) { render_row(medium, sky, view, y, march, image); });
    return image;
}

}  // namespace

Image2<float> render_sky(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                         int threads, int steps) {
    return render(medium, tables, view, threads, steps, march_rays);
}

Image2<float> render_sky_scalar(const SkyMedium& medium, const SkyTables& tables,
                                const SkyView& view, int threads) {
    return render(medium, tables, view, threads, kSkySteps, march_rays_scalar);
}

}  // namespace skybake
