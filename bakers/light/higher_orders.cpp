#include "bakers/light/higher_orders.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>

#include "bakers/air/optical_depth.h"
#include "bakers/field/interpolation.h"
#include "bakers/light/nearby_suns.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// The light that one km of air scatters towards an eye, from moments of the light (solved_light.h).

// A moment L_lm, and the factor by which cos(m phi) is multiplied for the current view.
struct WeightedMoment {
    double weight = 0;
    Spectrum value{};
};

// Returns the sum over layers of sigma_s times the sum over l up to the degree of chi_l times the
// sum over m of weight L_lm cos(m phi). `phase_moments` are chi of each layer; `moment(l, m)`
// returns a WeightedMoment.
template <class Moment>
Spectrum moment_sum(int degree, double azimuth_cosine,
                    const std::vector<Spectrum>& scattering_per_km,
                    const std::vector<std::vector<Spectrum>>& phase_moments, const Moment& moment) {
    Spectrum sum{};
    for (int l = 0; l <= degree; ++l) {
        Spectrum of_degree{};
        double last = 1;  // cos(m phi), by Chebyshev's recursion
        double before = azimuth_cosine;
        for (int m = 0; m <= l; ++m) {
            const WeightedMoment of = moment(l, m);
            of_degree += of.weight * last * of.value;
            const double next = 2 * azimuth_cosine * last - before;
            before = last;
            last = next;
        }
        for (std::size_t k = 0; k < scattering_per_km.size(); ++k) {
            const Spectrum& chi = phase_moments[k][static_cast<std::size_t>(l)];
            sum += scattering_per_km[k] * chi * of_degree;
        }
    }
    return sum;
}

}  // namespace

ScatteringPoint scattering_point(double altitude_km, double view_cos_zenith, double sun_cos_zenith,
                                 double nu) {
    ScatteringPoint point;
    point.altitude_km = altitude_km;
    point.sun_cos_zenith = std::clamp(sun_cos_zenith, -1.0, 1.0);    // rounding
    point.view_cos_zenith = std::clamp(view_cos_zenith, -1.0, 1.0);  // rounding
    const double sines = std::sqrt((1 - point.sun_cos_zenith) * (1 + point.sun_cos_zenith) *
                                   (1 - point.view_cos_zenith) * (1 + point.view_cos_zenith));
    const double along = nu - point.sun_cos_zenith * point.view_cos_zenith;
    // A vertical view or sun has no azimuth, and what depends on it vanishes with the sines.
    point.azimuth_cosine = std::fabs(along) < sines ? along / sines : std::copysign(1.0, along);
    return point;
}

HigherOrders::OfSuns HigherOrders::at(const PointOfRay& point,
                                      const std::vector<Spectrum>& scattering_per_km) const {
    return [=, this](const SunBundle& suns, double* sums) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(suns.wanted); ++i) {
            const double s_km =
                point.begin_radius_km * suns.sun_cosines[i] + point.distance_km * suns.nu[i];
            const Spectrum light = scattered(scattering_point(point.altitude_km, point.view_cosine,
                                                              s_km / point.radius_km, suns.nu[i]),
                                             scattering_per_km);
            for (std::size_t c = 0; c < kMaxChannels; ++c) sums[i * kChannelSlots + c] += light[c];
        }
    };
}

IsotropicOrders::IsotropicOrders(const Medium& medium, MeanRadiance mean_radiance)
    : medium_(medium), mean_radiance_(std::move(mean_radiance)) {}

Spectrum IsotropicOrders::scattered(const ScatteringPoint& point,
                                    const std::vector<Spectrum>& scattering_per_km) const {
    const Spectrum psi = mean_radiance_(point.altitude_km, point.sun_cos_zenith);
    Spectrum sum{};
    for (const Spectrum& layer : scattering_per_km) {
        sum += layer * psi;
    }
    return sum;
}

Spectrum IsotropicOrders::sky_irradiance(double sun_cos_zenith) const {
    constexpr double kPi = std::numbers::pi;
    const Spectrum psi = mean_radiance_(0, sun_cos_zenith);
    const Spectrum& albedo = medium_.ground_albedo;
    Spectrum sun{};
    if (sun_cos_zenith > 0) {
        const double s_km = medium_.ground_radius_km * sun_cos_zenith;
        sun = sun_cos_zenith * exponential(-optical_depth_to_top(medium_, 0, s_km)) / kPi;
    }
    // Not negative but for what the table's interpolation leaves.
    return kPi * maximum(2.0 * psi - albedo * sun, Spectrum(0.0)) / (1.0 + albedo);
}

SolvedOrders::SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree)
    : light_(light), degree_(std::min(degree, light.degree())) {
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(scattered_moments(layer, degree_));
    }
}

Spectrum SolvedOrders::scattered(const ScatteringPoint& point,
                                 const std::vector<Spectrum>& scattering_per_km) const {
    assert(scattering_per_km.size() == phase_moments_.size());
    std::vector<Spectrum> moments(static_cast<std::size_t>(moment_count(light_.degree())));
    light_.moments_at(point.altitude_km, point.sun_cos_zenith, moments.data());
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, point.view_cos_zenith, harmonics.data());
    return moment_sum(degree_, point.azimuth_cosine, scattering_per_km, phase_moments_,
                      [&](int l, int m) {
                          const auto lm = static_cast<std::size_t>(moment_index(l, m));
                          return WeightedMoment{harmonics[lm], moments[lm]};
                      });
}

HigherOrders::OfSuns SolvedOrders::at(const PointOfRay& point,
                                      const std::vector<Spectrum>& scattering_per_km) const {
    assert(scattering_per_km.size() == phase_moments_.size());
    const auto nearby =
        std::make_shared<NearbySuns>(light_, point, scattering_per_km, phase_moments_, degree_);
    return [nearby](const SunBundle& suns, double* sums) { nearby->add(suns, sums); };
}

Spectrum SolvedOrders::sky_irradiance(double sun_cos_zenith) const {
    return light_.sky_irradiance_at(sun_cos_zenith);
}

TableOrders::TableOrders(const SkyMedium& medium, const Image2<float>& table, int degree,
                         PlaceInTable place)
    : table_(table),
      degree_(degree),
      place_(std::move(place)),
      mean_(medium.air, [this](double altitude_km, double sun_cos_zenith) {
          return moment_at({altitude_km, sun_cos_zenith, 0, 0}, 0);
      }) {
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(scattered_moments(layer, degree));
    }
}

Spectrum TableOrders::moment_at(const ScatteringPoint& point, int part) const {
    const int parts = moment_count(degree_);
    const TablePlace at = place_(point.altitude_km, point.sun_cos_zenith);
    const auto convention = TexelConvention::end_points_on_texel_centres;
    const double v = texture_coordinate(convention, at.y, table_.height / parts);
    Spectrum value{};
    bilinear(table_, texture_coordinate(convention, at.x, table_.width), (part + v) / parts,
             data(value));
    return value;
}

Spectrum TableOrders::scattered(const ScatteringPoint& point,
                                const std::vector<Spectrum>& scattering_per_km) const {
    if (degree_ == 0) return mean_.scattered(point, scattering_per_km);
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, point.view_cos_zenith, harmonics.data());
    return moment_sum(
        degree_, point.azimuth_cosine, scattering_per_km, phase_moments_, [&](int l, int m) {
            const int lm = moment_index(l, m);
            return WeightedMoment{harmonics[static_cast<std::size_t>(lm)] / harmonic_norm(l, m),
                                  moment_at(point, lm)};
        });
}

Spectrum TableOrders::sky_irradiance(double sun_cos_zenith) const {
    return mean_.sky_irradiance(sun_cos_zenith);
}

}  // namespace skybake
