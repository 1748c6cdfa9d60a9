#include "bakers/light/table_orders.h"

#include <cstddef>
#include <utility>

#include "bakers/field/image.h"
#include "bakers/field/interpolation.h"
#include "bakers/light/moment_sum.h"

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
