#include "bakers/sky/table_orders.h"

#include <cstddef>
#include <utility>

#include "bakers/core/bilinear.h"
#include "bakers/core/texel_axis.h"
#include "bakers/phase/legendre_moments.h"
#include "bakers/scattering/light_moments.h"

namespace skybake {

TableOrders::TableOrders(const SkyMedium& medium, const Image2<float>& table, int degree,
                         PlaceInTable place)
    : table_(table),
      degree_(degree),
      place_(std::move(place)),
      mean_(medium.air, [this](double altitude_km, double sun_cos_zenith) {
          return moment_at({altitude_km, sun_cos_zenith, 0, 0}, 0);
      }) {
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(legendre_moments(layer.phase, degree));
    }
}

Spectrum TableOrders::moment_at(const ScatteringPoint& point, int part) const {
    const int parts = moment_count(degree_);
    const TablePlace at = place_(point.altitude_km, point.sun_cos_zenith);
    const auto convention = TexelConvention::end_points_on_texel_centres;
    const double v = texture_coordinate(convention, at.y, table_.height / parts);
    Spectrum value{};
    bilinear(table_, texture_coordinate(convention, at.x, table_.width), (part + v) / parts,
             value.data());
    return value;
}

Spectrum TableOrders::scattered(const ScatteringPoint& point,
                                const std::vector<Spectrum>& scattering_per_km) const {
    if (degree_ == 0) return mean_.scattered(point, scattering_per_km);
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, point.view_cos_zenith, harmonics.data());
    Spectrum sum{};
    for (int l = 0; l <= degree_; ++l) {
        Spectrum of_degree{};
        double last = 1;  // cos(m phi), by Chebyshev's recursion
        double before = point.azimuth_cosine;
        for (int m = 0; m <= l; ++m) {
            const int lm = moment_index(l, m);
            const Spectrum moment = moment_at(point, lm);
            const double weight = harmonics[static_cast<std::size_t>(lm)] / harmonic_norm(l, m);
            for (std::size_t c = 0; c < sum.size(); ++c) of_degree[c] += weight * last * moment[c];
            const double next = 2 * point.azimuth_cosine * last - before;
            before = last;
            last = next;
        }
        for (std::size_t k = 0; k < scattering_per_km.size(); ++k) {
            const double chi = phase_moments_[k][static_cast<std::size_t>(l)];
            for (std::size_t c = 0; c < sum.size(); ++c) {
                sum[c] += scattering_per_km[k][c] * chi * of_degree[c];
            }
        }
    }
    return sum;
}

Spectrum TableOrders::sky_irradiance(double sun_cos_zenith) const {
    return mean_.sky_irradiance(sun_cos_zenith);
}

}  // namespace skybake
