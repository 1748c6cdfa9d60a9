#include "bakers/assets/bruneton/iterated_scattering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/air/optical_depth.h"
#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr int kDirections = 16;            // zenith angles, and twice as many azimuths
constexpr int kIrradianceDirections = 32;  // the same, half of them above the horizon
constexpr int kSteps = 50;
constexpr int kIrradianceSize = 64;

using Grid = std::vector<Spectrum>;  // [w][v][u]

class Iteration {
  public:
    Iteration(const SkyMedium& medium, const ScatteringMapping& mapping, const BakeOptions& options)
        : medium_(medium),
          mapping_(mapping),
          options_(options),
          shell_(shell_of(medium.air)),
          integrator_(medium, nullptr),
          width_(static_cast<std::size_t>(mapping.size()[0])),
          texels_(width_ * static_cast<std::size_t>(mapping.size()[1]) *
                  static_cast<std::size_t>(mapping.size()[2])) {}

    Grid sum(int orders) {
        make_first();
        make_direct_irradiance();
        Grid sum(texels_);
        for (int order = 2; order <= orders && !options_.cancelled(); ++order) {
            const Grid density = scattering_density(order);
            irradiance_ = indirect_irradiance(order);
            last_ = along_rays(density);
            for (std::size_t i = 0; i < texels_; ++i) sum[i] += last_[i];
        }
        return sum;
    }

  private:
    double radius(double altitude_km) const { return shell_.ground_radius_km + altitude_km; }
    double cosine(const ScatteringView& view) const {
        return std::clamp(view.s_km / radius(view.altitude_km), -1.0, 1.0);
    }
    std::size_t first_of(int v, int w) const {
        return (static_cast<std::size_t>(w) * static_cast<std::size_t>(mapping_.size()[1]) +
                static_cast<std::size_t>(v)) *
               width_;
    }
    // nu of a texel, or the nearest nu that directions can have.
    double nu_of(int u, double view_cosine) const {
        const FeasibleCosines feasible = feasible_cosines(view_cosine, mapping_.sun_of_texel(u));
        return std::clamp(mapping_.nu_of_texel(u), std::max(feasible.low, -1.0),
                          std::min(feasible.high, 1.0));
    }
    ScatteringView view_at(double altitude_km, double view_cosine, bool meets_ground) const {
        ScatteringView view;
        view.altitude_km = altitude_km;
        view.s_km = radius(altitude_km) * view_cosine;
        view.meets_ground = meets_ground;
        view.length_km = ray_length_km(shell_, altitude_km, view.s_km, meets_ground);
        return view;
    }
    bool meets_ground(double altitude_km, double view_cosine) const {
        return radius(altitude_km) * view_cosine < -horizon_distance_km(shell_, altitude_km);
    }
    Spectrum transmittance(const ScatteringView& view, double distance_km) const {
        return exponential(
            -optical_depth_along(medium_.air, view.altitude_km, cosine(view), distance_km));
    }

    template <class Visit>
    void for_each_row(const char* step, const Visit& visit) const {
        const std::array<int, 3>& size = mapping_.size();
        for_each_tile(size[1] * size[2], options_, step,
                      [&](int tile) { visit(tile % size[1], tile / size[1]); });
    }

    void make_first() {
        const ScatteringRows rows(medium_, nullptr, make_sunlight(medium_.air, options_.threads));
        single_.assign(medium_.layers.size(), Grid(texels_));
        for_each_row("first order", [&](int v, int w) {
            const ScatteringView view = mapping_.view_of_texel(v, w);
            std::vector<double> suns;
            std::vector<double> nu;
            for (int u = 0; u < mapping_.size()[0]; ++u) {
                suns.push_back(mapping_.sun_of_texel(u));
                nu.push_back(nu_of(u, cosine(view)));
            }
            const ScatteringRow row = rows.row(view, SunBundle(suns, nu));
            for (std::size_t k = 0; k < single_.size(); ++k) {
                std::ranges::copy(row.single[k],
                                  single_[k].begin() + static_cast<std::ptrdiff_t>(first_of(v, w)));
            }
        });
    }

    void make_direct_irradiance() {
        for (int i = 0; i < kIrradianceSize; ++i) {
            const double sun = 2.0 * i / (kIrradianceSize - 1) - 1;
            irradiance_[static_cast<std::size_t>(i)] = {};
            if (sun <= 0) continue;
            irradiance_[static_cast<std::size_t>(i)] +=
                sun * integrator_.sunlight(0, shell_.ground_radius_km * sun);
        }
    }

    Spectrum ground_irradiance(double sun_cos_zenith) const {
        const AxisTaps taps = axis_taps(0.5 * (sun_cos_zenith + 1), kIrradianceSize);
        Spectrum value{};
        for (std::size_t i = 0; i < 2; ++i) {
            value += taps.weight[i] * irradiance_[static_cast<std::size_t>(taps.texel[i])];
        }
        return value;
    }

    Spectrum look_up(const Grid& grid, const ScatteringCoordinates& x) const {
        Spectrum value{};
        for_each_tap(mapping_, x, [&](int u, int v, int w, double weight) {
            value += weight * grid[first_of(v, w) + static_cast<std::size_t>(u)];
        });
        return value;
    }

    // Light of the order before `order` from a direction.
    Spectrum incident(int order, const ScatteringCoordinates& x, double nu) const {
        if (order > 2) return look_up(last_, x);
        Spectrum value{};
        for (std::size_t k = 0; k < single_.size(); ++k) {
            if (!medium_.layers[k].scatters) continue;
            const Spectrum light = look_up(single_[k], x);
            const Spectrum phase = phase_values(medium_.layers[k].phase, 1 - nu, 1 + nu);
            value += light * phase;
        }
        return value;
    }

    // Returns the light that a km of air at a texel's point scatters towards its beginning.
    Grid scattering_density(int order) const {
        Grid density(texels_);
        for_each_row("density", [&](int v, int w) {
            const ScatteringView view = mapping_.view_of_texel(v, w);
            for (int l = 0; l < kDirections; ++l) {
                add_direction(order, view, (l + 0.5) / kDirections, &density[first_of(v, w)]);
            }
        });
        return density;
    }

    void add_direction(int order, const ScatteringView& view, double half_turns,
                       Spectrum* row) const {
        const double mu = cosine(view);
        const double sine = std::sqrt((1 - mu) * (1 + mu));
        const double from_cosine = cosine_of_pi(half_turns);
        const double from_sine = std::sqrt((1 - from_cosine) * (1 + from_cosine));
        const ScatteringView from =
            view_at(view.altitude_km, from_cosine, meets_ground(view.altitude_km, from_cosine));
        const Spectrum to_ground =
            from.meets_ground ? transmittance(from, from.length_km) : Spectrum{};
        const double solid_angle =
            std::numbers::pi / kDirections * (std::numbers::pi / kDirections) * from_sine;
        std::vector<Spectrum> scattering;
        for (const SkyLayer& layer : medium_.layers) {
            scattering.push_back(layer.scatters ? scattering_at(layer.alone, view.altitude_km)
                                                : Spectrum{});
        }
        for (int u = 0; u < mapping_.size()[0]; ++u) {
            const double sun = mapping_.sun_of_texel(u);
            const double nu = nu_of(u, mu);
            const double sun_x = sine > 0 ? (nu - mu * sun) / sine : 0;
            const glm::dvec3 sun_vector = {
                sun_x, std::sqrt(std::max(1 - sun_x * sun_x - sun * sun, 0.0)), sun};
            ScatteringCoordinates x = mapping_.coordinates(from, sun, 0);
            for (int m = 0; m < 2 * kDirections; ++m) {
                const SineCosine azimuth =
                    sine_and_cosine(std::numbers::pi * (m + 0.5) / kDirections);
                const glm::dvec3 omega = {azimuth.cosine * from_sine, azimuth.sine * from_sine,
                                          from_cosine};
                const double from_nu = std::clamp(glm::dot(omega, sun_vector), -1.0, 1.0);
                x.x_nu = 0.5 * (from_nu + 1);
                Spectrum light = incident(order, x, from_nu);
                if (from.meets_ground) add_ground(view, from, sun, from_nu, to_ground, light);
                const double turn = std::clamp(sine * omega.x + mu * omega.z, -1.0, 1.0);
                for (std::size_t k = 0; k < scattering.size(); ++k) {
                    const Spectrum phase =
                        phase_values(medium_.layers[k].phase, 1 - turn, 1 + turn);
                    row[u] += solid_angle * light * scattering[k] * phase;
                }
            }
        }
    }

    void add_ground(const ScatteringView& view, const ScatteringView& from, double sun, double nu,
                    const Spectrum& passing, Spectrum& light) const {
        // The sun's cosine where the ray meets the ground.
        const double there = std::clamp(
            (radius(view.altitude_km) * sun + from.length_km * nu) / shell_.ground_radius_km, -1.0,
            1.0);
        const Spectrum irradiance = ground_irradiance(there);
        light += passing * medium_.air.ground_albedo / std::numbers::pi * irradiance;
    }

    using Irradiance = std::array<Spectrum, kIrradianceSize>;

    // Returns the irradiance of the ground by the order before `order`.
    Irradiance indirect_irradiance(int order) const {
        Irradiance result{};
        for_each_tile(kIrradianceSize, options_, "irradiance", [&](int i) {
            const double sun = 2.0 * i / (kIrradianceSize - 1) - 1;
            const double sun_sine = std::sqrt((1 - sun) * (1 + sun));
            for (int j = 0; j < kIrradianceDirections / 2; ++j) {
                const double mu = cosine_of_pi((j + 0.5) / kIrradianceDirections);
                const double sine = std::sqrt((1 - mu) * (1 + mu));
                ScatteringCoordinates x = mapping_.coordinates(view_at(0, mu, false), sun, 0);
                const double weight = std::numbers::pi / kIrradianceDirections *
                                      (std::numbers::pi / kIrradianceDirections) * sine * mu;
                for (int m = 0; m < 2 * kIrradianceDirections; ++m) {
                    const double along =
                        sine_and_cosine(std::numbers::pi * (m + 0.5) / kIrradianceDirections)
                            .cosine;
                    const double nu = std::clamp(mu * sun + sine * sun_sine * along, -1.0, 1.0);
                    x.x_nu = 0.5 * (nu + 1);
                    result[static_cast<std::size_t>(i)] += weight * incident(order, x, nu);
                }
            }
        });
        return result;
    }

    Grid along_rays(const Grid& density) const {
        Grid result(texels_);
        for_each_row("order", [&](int v, int w) {
            const ScatteringView view = mapping_.view_of_texel(v, w);
            const double step = view.length_km / kSteps;
            for (int i = 0; i <= kSteps && step > 0; ++i) {
                const double distance = step * i;
                const double altitude =
                    std::clamp(altitude_along_km(shell_, view.altitude_km, view.s_km, distance),
                               0.0, shell_.thickness_km);
                ScatteringView here = view;
                here.altitude_km = altitude;
                here.s_km = view.s_km + distance;
                here.length_km = view.length_km - distance;
                const Spectrum passing = transmittance(view, distance);
                const double weight = i == 0 || i == kSteps ? 0.5 * step : step;
                for (int u = 0; u < mapping_.size()[0]; ++u) {
                    const double nu = nu_of(u, cosine(view));
                    const double sun = std::clamp(
                        (radius(view.altitude_km) * mapping_.sun_of_texel(u) + distance * nu) /
                            radius(altitude),
                        -1.0, 1.0);
                    const Spectrum light = look_up(density, mapping_.coordinates(here, sun, nu));
                    Spectrum& texel = result[first_of(v, w) + static_cast<std::size_t>(u)];
                    texel += weight * passing * light;
                }
            }
        });
        return result;
    }

    const SkyMedium& medium_;
    const ScatteringMapping& mapping_;
    const BakeOptions& options_;
    Shell shell_;
    SkyIntegrator integrator_;
    std::size_t width_;
    std::size_t texels_;
    std::vector<Grid> single_;  // of each layer, without its phase function
    Grid last_;
    Irradiance irradiance_{};  // of the ground by the order before the last
};

}  // namespace

std::vector<Spectrum> iterated_scattering(const SkyMedium& medium, const ScatteringMapping& mapping,
                                          int orders, const BakeOptions& options) {
    return Iteration(medium, mapping, options).sum(orders);
}

}  // namespace skybake
