#include "bakers/light/strip_orders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bakers/field/interpolation.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr double kStripWidth = std::numbers::pi / StripOrders::kStrips;  // of azimuth, in radians
constexpr int kSuns = 64;
constexpr int kAltitudes = 32;
constexpr auto kMapping = config::MultipleScatteringMapping::twilight;
constexpr auto kStripConvention = TexelConvention::end_points_on_texel_centres;

SunZenith strip_sun(double cosine) { return {cosine, std::sqrt((1 - cosine) * (1 + cosine))}; }

// The cosine of the azimuth of a sector's middle.
double middle_cosine(int strip) { return sine_and_cosine((strip + 0.5) * kStripWidth).cosine; }

// A direction of the quadrature over a sector.
struct StripNode {
    int strip = 0;
    double mu = 0;
    double sine = 0;
    double azimuth_cosine = 0;
    double azimuth_sine = 0;
    double solid_angle = 0;
};

// Returns the nodes of the sectors on one side of the sun.
std::vector<StripNode> make_nodes() {
    constexpr int kZenithNodes = 4;
    constexpr int kAzimuthNodes = 4;
    const QuadratureRule zeniths = gauss_legendre(kZenithNodes);
    const QuadratureRule azimuths = gauss_legendre(kAzimuthNodes);
    std::vector<StripNode> nodes;
    for (int strip = 0; strip < StripOrders::kStrips; ++strip) {
        for (std::size_t i = 0; i < zeniths.nodes.size(); ++i) {
            const double mu = zeniths.nodes[i];
            for (std::size_t j = 0; j < azimuths.nodes.size(); ++j) {
                const SineCosine azimuth =
                    sine_and_cosine((strip + azimuths.nodes[j]) * kStripWidth);
                nodes.push_back({strip, mu, std::sqrt((1 - mu) * (1 + mu)), azimuth.cosine,
                                 azimuth.sine,
                                 kStripWidth * zeniths.weights[i] * azimuths.weights[j]});
            }
        }
    }
    return nodes;
}

const std::vector<StripNode>& strip_nodes() {
    static const std::vector<StripNode> nodes = make_nodes();
    return nodes;
}

}  // namespace

StripOrders::StripOrders(const SkyMedium& medium, const BakeOptions& options)
    : thickness_km_(medium.air.thickness_km) {
    for (const SkyLayer& layer : medium.layers) phases_.push_back(layer.phase);
    for (Image2<float>& strip : grid_) {
        strip = Image2<float>(kSuns, kAltitudes, medium.air.channels);
    }
    const Shell shell = shell_of(medium.air);
    const SkyIntegrator single(medium, nullptr);
    const double sine = std::sqrt(0.75);  // 60 degrees from the zenith
    for_each_tile(kAltitudes, options, "strips", [&](int y) {
        const double root = texel_coordinate(kStripConvention, y, kAltitudes);
        const double altitude_km = root * root * thickness_km_;
        for (int x = 0; x < kSuns; ++x) {
            const SunZenith sun = strip_sun(
                sun_cos_zenith_at(kMapping, texel_coordinate(kStripConvention, x, kSuns)));
            for (int i = 0; i < kStrips; ++i) {
                const SkyDirection middle = sky_direction(sun, 0.5, sine, middle_cosine(i));
                const Spectrum light =
                    single.radiance(sky_ray(shell, altitude_km, sun, middle)).single;
                float* texel = grid_[static_cast<std::size_t>(i)].texel(x, y);
                for (int c = 0; c < medium.air.channels; ++c) {
                    texel[c] = static_cast<float>(light[static_cast<std::size_t>(c)]);
                }
            }
        }
    });
}

std::array<Spectrum, StripOrders::kStrips> StripOrders::radiances(double altitude_km,
                                                                  double sun_cos_zenith) const {
    const double u =
        texture_coordinate(kStripConvention, sun_coordinate(kMapping, sun_cos_zenith), kSuns);
    const double v = texture_coordinate(
        kStripConvention, std::sqrt(std::clamp(altitude_km / thickness_km_, 0.0, 1.0)), kAltitudes);
    std::array<Spectrum, kStrips> result{};
    for (std::size_t i = 0; i < result.size(); ++i) bilinear(grid_[i], u, v, data(result[i]));
    return result;
}

Spectrum StripOrders::scattered(const ScatteringPoint& point,
                                const std::vector<Spectrum>& scattering_per_km) const {
    const std::array<Spectrum, kStrips> light = radiances(point.altitude_km, point.sun_cos_zenith);
    const double view_mu = point.view_cos_zenith;
    const double view_sine = std::sqrt((1 - view_mu) * (1 + view_mu));
    const double view_azimuth_sine =
        std::sqrt(std::max((1 - point.azimuth_cosine) * (1 + point.azimuth_cosine), 0.0));
    Spectrum sum{};
    for (const StripNode& node : strip_nodes()) {
        const Spectrum& radiance = light[static_cast<std::size_t>(node.strip)];
        for (const double side : {-1.0, 1.0}) {
            // 1 -+ cosine as half the squares of the difference and of the sum of both directions.
            const double east = node.sine * node.azimuth_sine * side;
            const double along = node.sine * node.azimuth_cosine;
            const auto half_square = [&](double sign) {
                const double z = node.mu + sign * view_mu;
                const double x = along + sign * view_sine * point.azimuth_cosine;
                const double y = east + sign * view_sine * view_azimuth_sine;
                return 0.5 * (z * z + x * x + y * y);
            };
            const double one_minus = half_square(-1);
            const double one_plus = half_square(1);
            for (std::size_t layer = 0; layer < phases_.size(); ++layer) {
                const Spectrum p = phase_values(phases_[layer], one_minus, one_plus);
                sum += scattering_per_km[layer] * radiance * p * node.solid_angle;
            }
        }
    }
    return sum;
}

Spectrum StripOrders::sky_irradiance(double sun_cos_zenith) const {
    // The integral of mu over a sector is half its width in azimuth. Each sector occurs twice.
    Spectrum sum{};
    for (const Spectrum& radiance : radiances(0, sun_cos_zenith)) {
        sum += kStripWidth * radiance;
    }
    return sum;
}

}  // namespace skybake
