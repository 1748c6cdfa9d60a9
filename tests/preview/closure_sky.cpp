#include "tests/preview/closure_sky.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <optional>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr MultipleScatteringGrid::Size kGrid = {64, 48};

// The angle at the planet's centre between the camera and the farthest point of the shell that it
// sees.
double widest_turn(const Shell& shell, double altitude_km) {
    const auto dip = [&](double altitude) {
        return arc_cosine(shell.ground_radius_km / (shell.ground_radius_km + altitude));
    };
    return dip(altitude_km) + dip(shell.thickness_km);
}

MultipleScatteringGrid make_grid(const Medium& air, const SkyView& view, int threads) {
    const double zenith = (90 - view.sun_elevation_degrees) / 180 * kPi;
    const double turn = widest_turn(shell_of(air), view.camera_altitude_km);
    return {air, std::max(zenith - turn, 0.0), std::min(zenith + turn, kPi), kGrid, threads};
}

}  // namespace

ClosureSky::ClosureSky(const SkyMedium& medium, const SkyView& view, int threads)
    : altitude_km_(view.camera_altitude_km),
      sun_{sun_sine(view), sun_cosine(view)},
      multiple_scattering_(make_grid(medium.air, view, threads)),
      higher_orders_(medium.air,
                     [this](double altitude_km, double sun_cos_zenith) {
                         return multiple_scattering_.at(altitude_km, sun_cos_zenith);
                     }),
      integrator_(medium, &higher_orders_) {}

SkyRadiance ClosureSky::radiance(const SkyDirection& direction) const {
    return integrator_.radiance(altitude_km_, sun_, direction);
}

Image2<float> render_closure_sky(const SkyMedium& medium, const SkyView& view, int threads) {
    const ClosureSky reference(medium, view, threads);
    Image2<float> image(view.width, view.height, medium.air.channels);
    parallel_for(view.height, threads, [&](int y) {
        for (int x = 0; x < (view.width + 1) / 2; ++x) {
            const std::optional<SkyDirection> direction = direction_at(view, x, y);
            if (!direction) continue;
            const Spectrum radiance = reference.radiance(*direction).total();
            for (int c = 0; c < image.channels; ++c) {
                const auto value = static_cast<float>(radiance[static_cast<std::size_t>(c)]);
                image.texel(x, y)[c] = value;
                image.texel(view.width - 1 - x, y)[c] = value;
            }
        }
    });
    return image;
}

}  // namespace skybake::test
