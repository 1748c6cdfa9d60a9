#include "bakers/render/sky_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/math/parallel.h"
#include "bakers/render/sky_march.h"

namespace skybake {
namespace {

std::array<float, kMaxChannels> floats(const Spectrum& values) {
    return {static_cast<float>(values.x), static_cast<float>(values.y),
            static_cast<float>(values.z), static_cast<float>(values.w)};
}

MarchLayer march_layer(const SkyLayer& layer, int degree) {
    MarchLayer result;
    if (!layer.alone.exponential_layers.empty()) {
        result.scale_height_km =
            static_cast<float>(layer.alone.exponential_layers.front().scale_height_km);
    } else {
        result.pieces = layer.alone.piecewise_layers.front().pieces;
    }
    const Coefficients full = full_coefficients(layer);
    for (const Spectrum& moment : scattered_moments(layer, degree)) {
        result.scattering_per_km.push_back(floats(full.scattering_per_km * moment));
    }
    result.extinction_per_km = floats(full.extinction_per_km);
    result.scatters = layer.scatters;
    return result;
}

SkyMarch make_march(const SkyMedium& medium, const SkyTables& tables, int steps) {
    const Medium& air = medium.air;
    SkyMarch sky;
    sky.channels = air.channels;
    sky.degree = tables.degree;
    sky.ground_radius_km = static_cast<float>(air.ground_radius_km);
    sky.thickness_km = static_cast<float>(air.thickness_km);
    sky.top_horizon_km = static_cast<float>(horizon_distance_km(shell_of(air), air.thickness_km));
    sky.ground_albedo = floats(air.ground_albedo);
    for (const SkyLayer& layer : medium.layers) {
        sky.layers.push_back(march_layer(layer, tables.degree));
    }
    sky.tables = &tables;
    sky.steps = steps;
    return sky;
}

void add_ray(const SkyRay& ray, double reach_km, MarchRays& rays) {
    rays.altitude_km.push_back(static_cast<float>(ray.altitude_km));
    rays.s_km.push_back(static_cast<float>(ray.s_km));
    rays.sun_s_km.push_back(static_cast<float>(ray.sun_s_km));
    rays.cosine_to_sun.push_back(static_cast<float>(ray.cosine_to_sun));
    rays.reach_km.push_back(static_cast<float>(reach_km));
    ++rays.count;
}

// Fills in the phase functions of all layers for the rays.
void add_phases(const SkyMedium& medium, const std::vector<SkyRay>& from, MarchRays& rays) {
    const auto channels = static_cast<std::size_t>(medium.air.channels);
    rays.phases.resize(medium.layers.size() * channels * from.size());
    for (std::size_t layer = 0; layer < medium.layers.size(); ++layer) {
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Spectrum phase = first_phase_values(
                medium.layers[layer], from[i].one_minus_cosine, from[i].one_plus_cosine);
            for (std::size_t c = 0; c < channels; ++c) {
                rays.phases[(layer * channels + c) * from.size() + i] =
                    static_cast<float>(phase[c]);
            }
        }
    }
}

// Returns the radiance along rays, of which there is at least one, up to these distances: none are as
// far as the air.
std::vector<Spectrum> marched(const SkyMedium& medium, const SkyMarch& sky,
                              std::vector<SkyRay> rays, std::span<const double> reaches_km) {
    std::vector<Spectrum> light(rays.size());
    while (rays.size() % kMarchPadding != 0) rays.push_back(rays.back());
    MarchRays together;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        add_ray(rays[i], i < reaches_km.size() ? reaches_km[i] : HUGE_VAL, together);
    }
    add_phases(medium, rays, together);
    const auto channels = static_cast<std::size_t>(sky.channels);
    std::vector<float> radiance(rays.size() * channels);
    march_rays(sky, together, radiance.data());
    for (std::size_t i = 0; i < light.size(); ++i) {
        for (std::size_t c = 0; c < channels; ++c) light[i][c] = radiance[c * rays.size() + i];
    }
    return light;
}

// Renders the left half of a row; the right half is its mirror image.
void render_row(const SkyMedium& medium, const SkyMarch& sky, const SkyView& view, int y,
                Image2<float>& image) {
    const SunZenith sun = {sun_sine(view), sun_cosine(view)};
    std::vector<int> columns;
    std::vector<SkyRay> rays;
    for (int x = 0; x < (view.width + 1) / 2; ++x) {
        const std::optional<SkyDirection> direction = direction_at(view, x, y);
        if (!direction) continue;
        columns.push_back(x);
        rays.push_back(sky_ray(shell_of(medium.air), view.camera_altitude_km, sun, *direction));
    }
    if (columns.empty()) return;
    const std::vector<Spectrum> light = marched(medium, sky, std::move(rays), {});
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (int c = 0; c < sky.channels; ++c) {
            const auto value = static_cast<float>(light[i][static_cast<std::size_t>(c)]);
            image.texel(columns[i], y)[c] = value;
            image.texel(view.width - 1 - columns[i], y)[c] = value;
        }
    }
}

}  // namespace

Image2<float> render_sky(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                         int threads, int steps) {
    const SkyMarch sky = make_march(medium, tables, steps);
    Image2<float> image(view.width, view.height, sky.channels);
    parallel_for(view.height, threads, [&](int y) { render_row(medium, sky, view, y, image); });
    return image;
}

std::vector<Spectrum> march_sky(const SkyMedium& medium, const SkyTables& tables,
                                const std::vector<SkyRay>& rays, int steps, int threads,
                                std::span<const double> reaches_km) {
    constexpr std::ptrdiff_t kTogether = 8 * kMarchPadding;
    const SkyMarch sky = make_march(medium, tables, steps);
    std::vector<Spectrum> light(rays.size());
    const auto count = static_cast<std::ptrdiff_t>(rays.size());
    parallel_for(static_cast<int>((count + kTogether - 1) / kTogether), threads, [&](int part) {
        const std::ptrdiff_t begin = part * kTogether;
        const std::ptrdiff_t end = std::min(begin + kTogether, count);
        const auto from = static_cast<std::size_t>(begin);
        const auto reaches = reaches_km.empty() ? reaches_km : reaches_km.subspan(from);
        std::ranges::copy(marched(medium, sky, {rays.begin() + begin, rays.begin() + end}, reaches),
                          light.begin() + begin);
    });
    return light;
}

}  // namespace skybake
