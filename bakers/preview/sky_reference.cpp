#include "bakers/preview/sky_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "bakers/atmosphere/multiple_scattering_quadrature.h"
#include "bakers/atmosphere/optical_depth.h"
#include "bakers/atmosphere/ray_breaks.h"
#include "bakers/core/gauss_legendre.h"
#include "bakers/core/parallel.h"
#include "bakers/core/transcendental.h"

namespace skybake {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kGaussNodes = 5;
constexpr double kLargestDepth = 1;  // of a piece, along the ray
// Light that has passed this optical depth adds e^-25 = 1e-11 to a picture.
constexpr double kLastLight = 25;
// Halvings of a piece: 2^-20 of a ray is metres.
constexpr int kMostHalvings = 20;
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

const QuadratureRule& gauss_rule() {
    static const QuadratureRule rule = gauss_legendre(kGaussNodes);
    return rule;
}

}  // namespace

Spectrum SkyRadiance::total() const {
    Spectrum sum{};
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] = single[c] + multiple[c] + ground[c];
    return sum;
}

struct SkyReference::Ray {
    SkyDirection direction;
    double s_km;
    double length_km;
    bool hits_ground;
    std::vector<double> phases;  // of each layer
};

struct SkyReference::Piece {
    double from_km;
    double to_km;
    Spectrum depth_from;
    Spectrum depth_to;
};

SkyReference::SkyReference(const SkyMedium& medium, const SkyView& view, int threads)
    : medium_(medium),
      shell_(shell_of(medium.air)),
      altitude_km_(view.camera_altitude_km),
      r_km_(shell_.ground_radius_km + altitude_km_),
      sun_s_km_(r_km_ * sun_sine(view)),
      sun_cos_zenith_(sun_sine(view)),
      break_altitudes_km_(quadrature_altitudes_km(medium.air)),
      multiple_scattering_(make_grid(medium.air, view, threads)) {}

Spectrum SkyReference::sunlight(double altitude_km, double s_km) const {
    if (s_km < -horizon_distance_km(shell_, altitude_km)) return {};
    Spectrum value = optical_depth_to_top(medium_.air, altitude_km, s_km);
    for (int c = 0; c < medium_.air.channels; ++c) {
        double& channel = value[static_cast<std::size_t>(c)];
        channel = exponential(-channel);
    }
    return value;
}

Spectrum SkyReference::depth_km(const Ray& ray, double distance_km) const {
    return optical_depth_along(medium_.air, altitude_km_, ray.direction.mu, distance_km);
}

// Ascending, with both ends.
std::vector<double> SkyReference::cuts_km(const Ray& ray) const {
    std::vector<double> cuts;
    for (const RayBreak& at :
         ray_breaks(shell_, altitude_km_, ray.s_km, ray.length_km, break_altitudes_km_)) {
        cuts.push_back(at.distance_km);
    }
    // The sun's ray through P grazes altitude k where |P|^2 - (P . sun)^2 = (R + k)^2 and the sun
    // is below the horizontal there; k = 0 is the edge of the shadow.
    const double nu = ray.direction.cosine_to_sun;
    const double a = ray.direction.one_minus_cosine * ray.direction.one_plus_cosine;
    const double b = r_km_ * (ray.direction.mu - sun_cos_zenith_ * nu);
    for (const double altitude : break_altitudes_km_) {
        const double gain = altitude_km_ - altitude;
        // r^2 - (R + k)^2 - (r mu_s)^2.
        const double c =
            gain * (2 * shell_.ground_radius_km + altitude_km_ + altitude) - sun_s_km_ * sun_s_km_;
        const double discriminant = b * b - a * c;
        if (!(a > 0) || discriminant < 0) continue;
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        for (const double x : {q / a, q != 0 ? c / q : 0.0}) {
            if (x > 0 && x < ray.length_km && sun_s_km_ + x * nu < 0) cuts.push_back(x);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

void SkyReference::add_piece(const Ray& ray, const Piece& piece, int halvings,
                             SkyRadiance& sum) const {
    const auto channels = static_cast<std::size_t>(medium_.air.channels);
    bool lit = false;
    double depth = 0;
    for (std::size_t c = 0; c < channels; ++c) {
        if (piece.depth_from[c] > kLastLight) continue;
        lit = true;
        depth = std::max(depth, piece.depth_to[c] - piece.depth_from[c]);
    }
    if (!lit) return;
    if (depth > kLargestDepth && halvings < kMostHalvings) {
        const double middle = 0.5 * (piece.from_km + piece.to_km);
        const Spectrum depth_middle = depth_km(ray, middle);
        add_piece(ray, {piece.from_km, middle, piece.depth_from, depth_middle}, halvings + 1, sum);
        add_piece(ray, {middle, piece.to_km, depth_middle, piece.depth_to}, halvings + 1, sum);
        return;
    }
    const double width = piece.to_km - piece.from_km;
    for (std::size_t i = 0; i < gauss_rule().nodes.size(); ++i) {
        const double x = piece.from_km + width * gauss_rule().nodes[i];
        const double altitude = std::clamp(altitude_along_km(shell_, altitude_km_, ray.s_km, x),
                                           0.0, shell_.thickness_km);  // rounding
        const double s = sun_s_km_ + x * ray.direction.cosine_to_sun;
        const Spectrum depth_here = depth_km(ray, x);
        const Spectrum sun = sunlight(altitude, s);
        const Spectrum psi =
            multiple_scattering_.at(altitude, s / (shell_.ground_radius_km + altitude));
        Spectrum scattered{};
        Spectrum towards_eye{};
        for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
            if (!medium_.layers[k].scatters) continue;
            const Spectrum scattering = scattering_at(medium_.layers[k].alone, altitude);
            for (std::size_t c = 0; c < channels; ++c) {
                scattered[c] += scattering[c];
                towards_eye[c] += scattering[c] * ray.phases[k];
            }
        }
        for (std::size_t c = 0; c < channels; ++c) {
            const double weight = width * gauss_rule().weights[i] * exponential(-depth_here[c]);
            sum.single[c] += weight * towards_eye[c] * sun[c];
            sum.multiple[c] += weight * scattered[c] * psi[c];
        }
    }
}

Spectrum SkyReference::ground_radiance(double sun_s_km) const {
    const double mu = sun_s_km / shell_.ground_radius_km;
    const Spectrum sun = sunlight(0, sun_s_km);
    const Spectrum psi = multiple_scattering_.at(0, mu);
    Spectrum value{};
    for (std::size_t c = 0; c < value.size(); ++c) {
        const double albedo = medium_.air.ground_albedo[c];
        const double direct = std::max(mu, 0.0) * sun[c] / kPi;
        // Not negative but for what the grid's interpolation leaves.
        const double from_sky = std::max(2 * psi[c] - albedo * direct, 0.0) / (1 + albedo);
        value[c] = albedo * (direct + from_sky);
    }
    return value;
}

SkyRadiance SkyReference::radiance(const SkyDirection& direction) const {
    Ray ray;
    ray.direction = direction;
    ray.s_km = r_km_ * direction.mu;
    ray.hits_ground = ray.s_km < -horizon_distance_km(shell_, altitude_km_);
    ray.length_km = ray.hits_ground ? distance_to_ground_km(shell_, altitude_km_, ray.s_km)
                                    : distance_to_top_km(shell_, altitude_km_, ray.s_km);
    for (const SkyLayer& layer : medium_.layers) {
        ray.phases.push_back(
            phase_value(layer.phase, direction.one_minus_cosine, direction.one_plus_cosine));
    }
    SkyRadiance sum;
    Spectrum depth{};
    const std::vector<double> cuts = ray.length_km > 0 ? cuts_km(ray) : std::vector<double>{};
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        if (!(cuts[i] < cuts[i + 1])) continue;
        const Spectrum next = depth_km(ray, cuts[i + 1]);
        add_piece(ray, {cuts[i], cuts[i + 1], depth, next}, 0, sum);
        depth = next;
    }
    if (ray.hits_ground) {
        sum.ground = ground_radiance(sun_s_km_ + ray.length_km * direction.cosine_to_sun);
        for (std::size_t c = 0; c < depth.size(); ++c) sum.ground[c] *= exponential(-depth[c]);
    }
    return sum;
}

Image2<float> render_sky_reference(const SkyMedium& medium, const SkyView& view, int threads) {
    const SkyReference reference(medium, view, threads);
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

}  // namespace skybake
