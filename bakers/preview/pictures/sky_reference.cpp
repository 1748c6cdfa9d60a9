#include "bakers/preview/pictures/sky_reference.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "bakers/math/parallel.h"
#include "bakers/render/sky_view.h"

namespace skybake {

Image2<float> render_sky_reference(const SkyLight& light, const SkyView& view, int threads) {
    const SunZenith sun = {sun_sine(view), sun_cosine(view)};
    Image2<float> image(view.width, view.height, light.medium().air.channels);
    parallel_for(view.height, threads, [&](int y) {
        for (int x = 0; x < (view.width + 1) / 2; ++x) {
            const std::optional<SkyDirection> direction = direction_at(view, x, y);
            if (!direction) continue;
            const Spectrum radiance =
                light.wanted(light.integrator().radiance(view.camera_altitude_km, sun, *direction));
            for (int c = 0; c < image.channels; ++c) {
                const auto value = static_cast<float>(radiance[static_cast<std::size_t>(c)]);
                image.texel(x, y)[c] = value;
                image.texel(view.width - 1 - x, y)[c] = value;
            }
        }
    });
    return image;
}

SkyCost sky_cost(const SkyMedium& medium, const SkyTables& tables, const SkyLight& light,
                 const SkyView& view, int threads) {
    Image2<float> solved = render_sky_reference(light, view, threads);
    const Image2<float> picture = render_sky(medium, tables, view, threads);
    const Image2<float> exact_march = render_sky(medium, tables, view, threads, kExactSteps);
    SkyCost cost;
    cost.difference = sky_difference(picture, solved, view);
    cost.marching = sky_difference(picture, exact_march, view).error;
    cost.solved = std::move(solved);
    return cost;
}

}  // namespace skybake
