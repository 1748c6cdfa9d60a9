#include "bakers/render/sky_march.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/render/sky_march.cpp"
#include <hwy/foreach_target.h>

#include <cstddef>
#include <numbers>

#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

using Real = FloatLanes;  // of as many rays
static_assert(Real::kCount <= static_cast<std::size_t>(kMarchPadding));

// The four texels about a place, by the index of the lower left one, and their weights.
struct TexelPlace {
    IntLanes index;
    Real low_left, low_right, high_left, high_right;
};

// Returns the place between texel centres, clamped to the edge. x and y are in [0, 1] except for
// rounding.
HWY_INLINE TexelPlace place_in(const LookupTable& table, Real x, Real y) {
    const Real across = minimum(maximum(x * Real(table.scale_x) + Real(table.offset_x), Real(0.0f)),
                                Real(static_cast<float>(table.width - 1)));
    const Real up = minimum(maximum(y * Real(table.scale_y) + Real(table.offset_y), Real(0.0f)),
                            Real(static_cast<float>(table.height - 1)));
    const auto column = to_int(across);
    const auto row = to_int(up);
    const Real s = across - to_float(column);
    const Real t = up - to_float(row);
    return {(row * table.texels_per_row + column) * table.channels,
            (Real(1.0f) - s) * (Real(1.0f) - t), s * (Real(1.0f) - t), (Real(1.0f) - s) * t, s * t};
}

// Looks up the channels from number `first` on bilinearly.
template <int kChannels>
HWY_INLINE void look_up(const LookupTable& table, const TexelPlace& place, int first, Real* value) {
    const float* low = table.texels.data() + first;
    const float* high = low + table.texels_per_row * table.channels;
    const int right = table.channels;
    for (int c = 0; c < kChannels; ++c) {
        value[c] = (gather(low + c, place.index) * place.low_left +
                    gather(low + c + right, place.index) * place.low_right) +
                   (gather(high + c, place.index) * place.high_left +
                    gather(high + c + right, place.index) * place.high_right);
    }
}

// A ray where it begins.
struct MarchRay {
    Real altitude_km;
    Real s_km;      // r mu
    Real sun_s_km;  // r mu_s
    Real cosine_to_sun;
    Real reach_km;
};

// A point on a ray and the sun's position there.
struct MarchPoint {
    Real altitude_km;
    Real r_km;
    Real horizon_km;  // distance to the horizon, rho
    Real sun_s_km;    // r mu_s
};

HWY_INLINE MarchPoint point_at(const SkyMarch& sky, Real altitude_km, Real sun_s_km) {
    const Real ground(sky.ground_radius_km);
    return {altitude_km, ground + altitude_km,
            square_root(altitude_km * (ground + ground + altitude_km)), sun_s_km};
}

// Returns the transmittance towards the sun, which is 0 if the planet is in between.
template <int kChannels>
HWY_INLINE void sunlight(const SkyMarch& sky, const MarchPoint& point, Real* value) {
    const Real gain = Real(sky.thickness_km) - point.altitude_km;
    const Real d =
        square_root(point.sun_s_km * point.sun_s_km + gain * (point.r_km + point.r_km + gain)) -
        point.sun_s_km;
    const Real top_horizon(sky.top_horizon_km);
    const Real x_mu = (d - gain) / (point.horizon_km + top_horizon - gain);
    const LookupTable& table = sky.tables->transmittance;
    look_up<kChannels>(table, place_in(table, x_mu, point.horizon_km / top_horizon), 0, value);
    const auto hidden = point.sun_s_km < -point.horizon_km;
    for (int c = 0; c < kChannels; ++c) {
        if (sky.tables->holds_optical_depth) value[c] = exponential_of_negative(-value[c]);
        value[c] = select(hidden, Real(0.0f), value[c]);
    }
}

// Returns the place of a point in the table of light that is scattered again.
HWY_INLINE TexelPlace scattering_place(const SkyMarch& sky, const MarchPoint& point) {
    Real mu = point.sun_s_km / point.r_km;
    if (sky.tables->twilight) {
        const Real root = square_root(absolute(mu));
        mu = select(mu < Real(0.0f), -root, root);
    }
    return place_in(sky.tables->multiple_scattering, Real(0.5f) + Real(0.5f) * mu,
                    point.altitude_km / Real(sky.thickness_km));
}

HWY_INLINE Real density_at(const MarchLayer& layer, Real altitude_km) {
    if (layer.scale_height_km > 0) {
        return exponential_of_negative(altitude_km * Real(-1.0f / layer.scale_height_km));
    }
    Real density(0.0f);
    for (const LinearPiece& piece : layer.pieces) {
        const Real bottom_km(static_cast<float>(piece.bottom_km));
        const Real within =
            Real(static_cast<float>(piece.density_at_bottom)) +
            Real(static_cast<float>(piece.density_per_km)) * (altitude_km - bottom_km);
        const Real top_km(static_cast<float>(piece.top_km));
        density = select(altitude_km < bottom_km, density,
                         select(altitude_km < top_km, within, Real(0.0f)));
    }
    return density;
}

// Returns (1 - e^-x) / x for x >= 0; `transmitted` is e^-x. For small x, where the difference would
// lose digits, it uses the series. The first omitted term is at most 0.5^8 / 9! = 1e-8.
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
template <int kChannels>
HWY_INLINE void ground_radiance(const SkyMarch& sky, Real sun_s_km, Real* value) {
    const MarchPoint point = point_at(sky, Real(0.0f), sun_s_km);
    const Real mu = maximum(sun_s_km / point.r_km, Real(0.0f));
    Real sun[kChannels];
    Real psi[kChannels];
    sunlight<kChannels>(sky, point, sun);
    look_up<kChannels>(sky.tables->multiple_scattering, scattering_place(sky, point), 0, psi);
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
struct MarchPath {
    Real length_km;
    Real densest_km;
    decltype(Real() < Real()) hits_ground;
};

HWY_INLINE MarchPath path_of(const SkyMarch& sky, const MarchRay& ray) {
    const Real r = Real(sky.ground_radius_km) + ray.altitude_km;
    const Real gain = Real(sky.thickness_km) - ray.altitude_km;
    const Real drop = ray.altitude_km * (Real(sky.ground_radius_km) + r);  // rho^2
    const Real s = ray.s_km;
    const auto hits_ground = s < -square_root(drop);
    // The distances are those of bakers/air/ray.h. At the top of the atmosphere, a horizontal ray
    // has no length.
    const Real rise = gain * (r + r + gain);
    const Real root_to_top = square_root(s * s + rise);
    const Real to_top = select(Real(0.0f) < s, rise / (root_to_top + s), root_to_top - s);
    const Real to_ground = drop / (square_root(maximum(s * s - drop, Real(0.0f))) - s);
    const Real to_end = select(hits_ground, to_ground, to_top);
    const Real densest = select(hits_ground, to_ground, maximum(-s, Real(0.0f)));
    const decltype(hits_ground) ends_there = hits_ground & (to_end < ray.reach_km);
    return {minimum(to_end, ray.reach_km), minimum(densest, ray.reach_km), ends_there};
}

HWY_INLINE Real altitude_at(const SkyMarch& sky, const MarchRay& ray, Real distance_km) {
    const Real r = Real(sky.ground_radius_km) + ray.altitude_km;
    const Real q = distance_km * (distance_km + ray.s_km + ray.s_km);
    const Real altitude = ray.altitude_km + q / (square_root(maximum(r * r + q, Real(0.0f))) + r);
    // Only rounding can take the altitude out of the shell.
    return minimum(maximum(altitude, Real(0.0f)), Real(sky.thickness_km));
}

// The sums over all layers at the middle of a segment.
template <int kChannels>
struct AirSample {
    Real extinction[kChannels];
    Real scattering[kMostMomentDegree + 1][kChannels];  // times the Legendre moments
    Real scattered_to_eye[kChannels];                   // sum of sigma_s p
};

template <int kChannels>
HWY_INLINE void sample_air(const SkyMarch& sky, Real altitude_km, const float* phases, int stride,
                           AirSample<kChannels>& sample) {
    for (int c = 0; c < kChannels; ++c) {
        sample.extinction[c] = Real(0.0f);
        sample.scattered_to_eye[c] = Real(0.0f);
        for (int l = 0; l <= sky.degree; ++l) sample.scattering[l][c] = Real(0.0f);
    }
    for (const MarchLayer& layer : sky.layers) {
        const Real density = density_at(layer, altitude_km);
        for (int c = 0; c < kChannels; ++c) {
            const Real phase = Real::load(phases);
            phases += stride;
            const auto channel = static_cast<std::size_t>(c);
            sample.extinction[c] =
                sample.extinction[c] + density * Real(layer.extinction_per_km[channel]);
            if (!layer.scatters) continue;
            sample.scattered_to_eye[c] =
                sample.scattered_to_eye[c] +
                density * Real(layer.scattering_per_km.front()[channel]) * phase;
            for (int l = 0; l <= sky.degree; ++l) {
                const auto of_degree = static_cast<std::size_t>(l);
                sample.scattering[l][c] =
                    sample.scattering[l][c] +
                    density * Real(layer.scattering_per_km[of_degree][channel]);
            }
        }
    }
}

// Returns the light that a km of air scatters again towards the eye, whose direction has the cosine
// `mu` of the zenith angle: the sum of solved_scattering_table.h, which is that of the published lookup
// (examples/lookups/moments.glsl).
template <int kChannels>
HWY_INLINE void scattered_again(const SkyMarch& sky, const MarchPoint& point, Real mu,
                                Real cosine_to_sun, const AirSample<kChannels>& air, Real* value) {
    const LookupTable& table = sky.tables->multiple_scattering;
    const TexelPlace place = scattering_place(sky, point);
    const Real one(1.0f);
    const Real sun_mu = minimum(maximum(point.sun_s_km / point.r_km, -one), one);
    mu = minimum(maximum(mu, -one), one);
    const Real sine = square_root((one - mu) * (one + mu));
    const Real sines = sine * square_root((one - sun_mu) * (one + sun_mu));
    const Real along = cosine_to_sun - mu * sun_mu;
    // A vertical view or sun has no azimuth, and what depends on it vanishes with the sines.
    const Real azimuth_cosine =
        select(absolute(along) < sines, along / sines, select(along < Real(0.0f), -one, one));
    for (int c = 0; c < kChannels; ++c) value[c] = Real(0.0f);
    Real last = one;  // cos(m phi), by Chebyshev's recursion
    Real before = azimuth_cosine;
    Real sectoral = one;  // P_m^m
    for (int m = 0; m <= sky.degree; ++m) {
        Real lower(0.0f);
        Real harmonic = sectoral;  // P_l^m, by the recursion that ascends in l
        for (int l = m; l <= sky.degree; ++l) {
            Real moment[kChannels];
            look_up<kChannels>(table, place, (l * (l + 1) / 2 + m) * kChannels, moment);
            for (int c = 0; c < kChannels; ++c) {
                value[c] = value[c] + air.scattering[l][c] * (harmonic * last) * moment[c];
            }
            const Real higher = (Real(static_cast<float>(2 * l + 1)) * mu * harmonic -
                                 Real(static_cast<float>(l + m)) * lower) *
                                Real(1 / static_cast<float>(l + 1 - m));
            lower = harmonic;
            harmonic = higher;
        }
        sectoral = sectoral * sine * Real(static_cast<float>(2 * m + 1));
        const Real next = azimuth_cosine * (last + last) - before;
        before = last;
        last = next;
    }
}

// Marches one ray per lane. `phases` has the phase functions of the layers in each channel, `stride`
// apart.
template <int kChannels>
HWY_INLINE void march(const SkyMarch& sky, const MarchRay& ray, const float* phases, int stride,
                      Real* radiance) {
    const MarchPath path = path_of(sky, ray);
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
        const MarchPoint point =
            point_at(sky, altitude_at(sky, ray, t), ray.sun_s_km + t * ray.cosine_to_sun);
        AirSample<kChannels> air;
        sample_air(sky, point.altitude_km, phases, stride, air);
        Real sun[kChannels];
        Real again[kChannels];
        sunlight<kChannels>(sky, point, sun);
        scattered_again(sky, point, (ray.s_km + t) / point.r_km, ray.cosine_to_sun, air, again);
        for (int c = 0; c < kChannels; ++c) {
            const Real depth = air.extinction[c] * width;
            const Real transmitted = exponential_of_negative(-depth);
            const Real source = air.scattered_to_eye[c] * sun[c] + again[c];
            radiance[c] = radiance[c] +
                          throughput[c] * source * width * mean_transmittance(depth, transmitted);
            throughput[c] = throughput[c] * transmitted;
        }
    }
    if (!any(path.hits_ground)) return;
    Real ground[kChannels];
    ground_radiance<kChannels>(sky, ray.sun_s_km + path.length_km * ray.cosine_to_sun, ground);
    for (int c = 0; c < kChannels; ++c) {
        radiance[c] =
            select(path.hits_ground, radiance[c] + throughput[c] * ground[c], radiance[c]);
    }
}

template <int kChannels>
HWY_INLINE void march_all(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    for (int i = 0; i < rays.count; i += static_cast<int>(Real::kCount)) {
        const auto at = static_cast<std::size_t>(i);
        const MarchRay ray = {
            Real::load(rays.altitude_km.data() + at), Real::load(rays.s_km.data() + at),
            Real::load(rays.sun_s_km.data() + at), Real::load(rays.cosine_to_sun.data() + at),
            Real::load(rays.reach_km.data() + at)};
        Real value[kChannels];
        march<kChannels>(sky, ray, rays.phases.data() + at, rays.count, value);
        for (int c = 0; c < kChannels; ++c) value[c].store(radiance + c * rays.count + i);
    }
}

void MarchRow(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    switch (sky.channels) {
        case 1:
            return march_all<1>(sky, rays, radiance);
        case 2:
            return march_all<2>(sky, rays, radiance);
        case 3:
            return march_all<3>(sky, rays, radiance);
        default:
            return march_all<kMaxChannels>(sky, rays, radiance);
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(MarchRow);

void march_rays(const SkyMarch& sky, const MarchRays& rays, float* radiance) {
    HWY_DYNAMIC_DISPATCH(MarchRow)(sky, rays, radiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
