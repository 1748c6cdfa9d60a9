#include "bakers/render/sky_march.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/render/sky_march.cpp"
#include <hwy/foreach_target.h>

#include <cstddef>
#include <numbers>

#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

static_assert(FloatLanes::kCount <= static_cast<std::size_t>(kMarchPadding));

// Looks up a table bilinearly between texel centres, clamped to the edge. x and y are in [0, 1]
// except for rounding.
template <class Real, int kChannels>
HWY_INLINE void look_up(const LookupTable& table, Real x, Real y, Real* value) {
    const Real across = minimum(maximum(x * Real(table.scale_x) + Real(table.offset_x), Real(0.0f)),
                                Real(static_cast<float>(table.width - 1)));
    const Real up = minimum(maximum(y * Real(table.scale_y) + Real(table.offset_y), Real(0.0f)),
                            Real(static_cast<float>(table.height - 1)));
    const auto column = to_int(across);
    const auto row = to_int(up);
    const Real s = across - to_float(column);
    const Real t = up - to_float(row);
    const auto index = (row * table.texels_per_row + column) * kChannels;
    const float* low = table.texels.data();
    const float* high = low + table.texels_per_row * kChannels;
    const Real low_left = (Real(1.0f) - s) * (Real(1.0f) - t);
    const Real low_right = s * (Real(1.0f) - t);
    const Real high_left = (Real(1.0f) - s) * t;
    const Real high_right = s * t;
    for (int c = 0; c < kChannels; ++c) {
        value[c] =
            (gather(low + c, index) * low_left + gather(low + c + kChannels, index) * low_right) +
            (gather(high + c, index) * high_left +
             gather(high + c + kChannels, index) * high_right);
    }
}

// A point on a ray and the sun's position there.
template <class Real>
struct MarchPoint {
    Real altitude_km;
    Real r_km;
    Real horizon_km;  // distance to the horizon, rho
    Real sun_s_km;    // r mu_s
};

template <class Real>
HWY_INLINE MarchPoint<Real> point_at(const SkyMarch& sky, Real altitude_km, Real sun_s_km) {
    const Real ground(sky.ground_radius_km);
    return {altitude_km, ground + altitude_km,
            square_root(altitude_km * (ground + ground + altitude_km)), sun_s_km};
}

// Returns the transmittance towards the sun, which is 0 if the planet is in between.
template <class Real, int kChannels>
HWY_INLINE void sunlight(const SkyMarch& sky, const MarchPoint<Real>& point, Real* value) {
    const Real gain = Real(sky.thickness_km) - point.altitude_km;
    const Real d =
        square_root(point.sun_s_km * point.sun_s_km + gain * (point.r_km + point.r_km + gain)) -
        point.sun_s_km;
    const Real top_horizon(sky.top_horizon_km);
    const Real x_mu = (d - gain) / (point.horizon_km + top_horizon - gain);
    look_up<Real, kChannels>(sky.tables->transmittance, x_mu, point.horizon_km / top_horizon,
                             value);
    const auto hidden = point.sun_s_km < -point.horizon_km;
    for (int c = 0; c < kChannels; ++c) {
        if (sky.tables->holds_optical_depth) value[c] = exponential_of_negative(-value[c]);
        value[c] = select(hidden, Real(0.0f), value[c]);
    }
}

template <class Real, int kChannels>
HWY_INLINE void multiple_scattering(const SkyMarch& sky, const MarchPoint<Real>& point,
                                    Real* value) {
    Real mu = point.sun_s_km / point.r_km;
    if (sky.tables->twilight) {
        const Real root = square_root(absolute(mu));
        mu = select(mu < Real(0.0f), -root, root);
    }
    look_up<Real, kChannels>(sky.tables->multiple_scattering, Real(0.5f) + Real(0.5f) * mu,
                             point.altitude_km / Real(sky.thickness_km), value);
}

template <class Real>
HWY_INLINE Real density_at(const MarchLayer& layer, Real altitude_km) {
    if (layer.scale_height_km > 0) {
        return exponential_of_negative(altitude_km * Real(-1.0f / layer.scale_height_km));
    }
    Real density(0.0f);
    for (const MarchPiece& piece : layer.pieces) {
        const Real within = Real(piece.density_at_bottom) +
                            Real(piece.density_per_km) * (altitude_km - Real(piece.bottom_km));
        density = select(altitude_km < Real(piece.bottom_km), density,
                         select(altitude_km < Real(piece.top_km), within, Real(0.0f)));
    }
    return density;
}

// Returns (1 - e^-x) / x for x >= 0; `transmitted` is e^-x. For small x, where the difference would
// lose digits, it uses the series. The first omitted term is at most 0.5^8 / 9! = 1e-8.
template <class Real>
HWY_INLINE Real mean_transmittance(Real x, Real transmitted) {
    Real series(-1.0f / 40320);
    series = series * x + Real(1.0f / 5040);
    series = series * x + Real(-1.0f / 720);
    series = series * x + Real(1.0f / 120);
    series = series * x + Real(-1.0f / 24);
    series = series * x + Real(1.0f / 6);
    series = series * x + Real(-0.5f);
    series = series * x + Real(1.0f);
    const Real direct = (Real(1.0f) - transmitted) / maximum(x, Real(0.5f));
    return select(x < Real(0.5f), series, direct);
}

// Returns the radiance of the ground where the ray meets it; see sky_view.h.
template <class Real, int kChannels>
HWY_INLINE void ground_radiance(const SkyMarch& sky, Real sun_s_km, Real* value) {
    const MarchPoint<Real> point = point_at(sky, Real(0.0f), sun_s_km);
    const Real mu = maximum(sun_s_km / point.r_km, Real(0.0f));
    Real sun[kChannels];
    Real psi[kChannels];
    sunlight<Real, kChannels>(sky, point, sun);
    multiple_scattering<Real, kChannels>(sky, point, psi);
    for (int c = 0; c < kChannels; ++c) {
        const float albedo = sky.ground_albedo[static_cast<std::size_t>(c)];
        const Real direct = mu * sun[c] * Real(std::numbers::inv_pi_v<float>);
        // Only interpolation errors of the tables can make this negative.
        const Real from_sky =
            maximum(psi[c] + psi[c] - Real(albedo) * direct, Real(0.0f)) * Real(1 / (1 + albedo));
        value[c] = Real(albedo) * (direct + from_sky);
    }
}

// Where a ray ends and where its air is densest.
template <class Real>
struct MarchPath {
    Real s_km;  // r mu
    Real length_km;
    Real densest_km;
    decltype(Real() < Real()) hits_ground;
};

template <class Real>
HWY_INLINE MarchPath<Real> path_of(const SkyMarch& sky, Real mu) {
    const float r = sky.ground_radius_km + sky.camera_altitude_km;
    const float gain = sky.thickness_km - sky.camera_altitude_km;
    const float drop = sky.camera_altitude_km * (sky.ground_radius_km + r);  // rho^2
    const Real s = Real(r) * mu;
    const auto hits_ground = s < Real(-square_root(drop));
    // The distances are those of bakers/air/ray.h. At the top of the atmosphere, a horizontal ray
    // has no length.
    const float rise = gain * (2 * r + gain);
    const Real root_to_top = square_root(s * s + Real(rise));
    const Real to_top = select(Real(0.0f) < s, Real(rise) / (root_to_top + s), root_to_top - s);
    const Real to_ground = Real(drop) / (square_root(maximum(s * s - Real(drop), Real(0.0f))) - s);
    return {s, select(hits_ground, to_ground, to_top),
            select(hits_ground, to_ground, maximum(-s, Real(0.0f))), hits_ground};
}

template <class Real>
HWY_INLINE Real altitude_at(const SkyMarch& sky, Real s_km, Real distance_km) {
    const Real r(sky.ground_radius_km + sky.camera_altitude_km);
    const Real q = distance_km * (distance_km + s_km + s_km);
    const Real altitude =
        Real(sky.camera_altitude_km) + q / (square_root(maximum(r * r + q, Real(0.0f))) + r);
    // Only rounding can take the altitude out of the shell.
    return minimum(maximum(altitude, Real(0.0f)), Real(sky.thickness_km));
}

// The sums over all layers at the middle of a segment.
template <class Real, int kChannels>
struct AirSample {
    Real extinction[kChannels];
    Real scattering[kChannels];
    Real scattered_to_eye[kChannels];  // sum of sigma_s p
};

template <class Real, int kChannels>
HWY_INLINE void sample_air(const SkyMarch& sky, Real altitude_km, const float* phases, int stride,
                           AirSample<Real, kChannels>& sample) {
    for (int c = 0; c < kChannels; ++c) {
        sample.extinction[c] = Real(0.0f);
        sample.scattering[c] = Real(0.0f);
        sample.scattered_to_eye[c] = Real(0.0f);
    }
    for (const MarchLayer& layer : sky.layers) {
        const Real density = density_at(layer, altitude_km);
        for (int c = 0; c < kChannels; ++c) {
            const Real phase = LaneAccess<Real>::load(phases);
            phases += stride;
            const auto channel = static_cast<std::size_t>(c);
            sample.extinction[c] =
                sample.extinction[c] + density * Real(layer.extinction_per_km[channel]);
            if (!layer.scatters) continue;
            const Real scattering = density * Real(layer.scattering_per_km[channel]);
            sample.scattering[c] = sample.scattering[c] + scattering;
            sample.scattered_to_eye[c] = sample.scattered_to_eye[c] + scattering * phase;
        }
    }
}

// Marches one ray per lane. `phases` has the phase functions of the layers in each channel, `stride`
// apart.
template <class Real, int kChannels>
HWY_INLINE void march(const SkyMarch& sky, Real mu, Real cosine_to_sun, const float* phases,
                      int stride, Real* radiance) {
    const MarchPath<Real> path = path_of(sky, mu);
    const Real begin = -square_root(path.densest_km);
    const Real range = square_root(path.length_km - path.densest_km) - begin;
    Real throughput[kChannels];
    for (int c = 0; c < kChannels; ++c) {
        throughput[c] = Real(1.0f);
        radiance[c] = Real(0.0f);
    }
    Real from = begin * absolute(begin);  // counted from the densest point
    for (int step = 1; step <= sky.steps; ++step) {
        const Real y =
            begin + range * Real(static_cast<float>(step) / static_cast<float>(sky.steps));
        const Real to = y * absolute(y);
        const Real width = to - from;
        const Real t = path.densest_km + Real(0.5f) * (from + to);
        from = to;
        const MarchPoint<Real> point =
            point_at(sky, altitude_at(sky, path.s_km, t), Real(sky.sun_s_km) + t * cosine_to_sun);
        AirSample<Real, kChannels> air;
        sample_air(sky, point.altitude_km, phases, stride, air);
        Real sun[kChannels];
        Real psi[kChannels];
        sunlight<Real, kChannels>(sky, point, sun);
        multiple_scattering<Real, kChannels>(sky, point, psi);
        for (int c = 0; c < kChannels; ++c) {
            const Real depth = air.extinction[c] * width;
            const Real transmitted = exponential_of_negative(-depth);
            const Real source = air.scattered_to_eye[c] * sun[c] + air.scattering[c] * psi[c];
            radiance[c] = radiance[c] +
                          throughput[c] * source * width * mean_transmittance(depth, transmitted);
            throughput[c] = throughput[c] * transmitted;
        }
    }
    if (!any(path.hits_ground)) return;
    Real ground[kChannels];
    ground_radiance<Real, kChannels>(sky, Real(sky.sun_s_km) + path.length_km * cosine_to_sun,
                                     ground);
    for (int c = 0; c < kChannels; ++c) {
        radiance[c] =
            select(path.hits_ground, radiance[c] + throughput[c] * ground[c], radiance[c]);
    }
}

template <class Real, int kChannels>
HWY_INLINE void march_all(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    using Access = LaneAccess<Real>;
    for (int i = 0; i < rays.count; i += Access::kCount) {
        const auto at = static_cast<std::size_t>(i);
        const Real cosine = Access::load(rays.cosine_to_sun.data() + at);
        Real value[kChannels];
        march<Real, kChannels>(sky, Access::load(rays.mu.data() + at), cosine,
                               rays.phases.data() + at, rays.count, value);
        for (int c = 0; c < kChannels; ++c) Access::store(value[c], radiance + c * rays.count + i);
    }
}

template <class Real>
HWY_INLINE void march_channels(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    switch (sky.channels) {
        case 1:
            return march_all<Real, 1>(sky, rays, radiance);
        case 2:
            return march_all<Real, 2>(sky, rays, radiance);
        case 3:
            return march_all<Real, 3>(sky, rays, radiance);
        default:
            return march_all<Real, kMaxChannels>(sky, rays, radiance);
    }
}

void MarchRow(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    march_channels<FloatLanes>(sky, rays, radiance);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(MarchRow);

void march_rays(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    HWY_DYNAMIC_DISPATCH(MarchRow)(sky, rays, radiance);
}

void march_rays_scalar(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    HWY_NAMESPACE::march_channels<float>(sky, rays, radiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
