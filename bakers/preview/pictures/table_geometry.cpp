#include "bakers/preview/pictures/table_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/recipe/asset_parameters.h"

namespace skybake {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// Returns the angle in degrees. The cosine is clamped, because rounding may bring it slightly
// beyond its bounds.
double angle_of(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * degrees_per_radian;
}

double cosine_of_angle(double angle) { return std::cos(angle / degrees_per_radian); }

// Continues a function of [0, 1] beyond its ends by odd reflection, so that a monotonic function
// stays monotonic.
template <class Function>
double continued(double x, Function&& function) {
    if (x < 0) return 2 * function(0.0) - function(-x);
    if (x > 1) return 2 * function(1.0) - function(2 - x);
    return function(x);
}

}  // namespace

std::optional<TableGeometry> TableGeometry::of(const ManifestAsset& asset) {
    // The parameters that an asset carries are themselves a recipe.
    const auto recipe = config::parse_asset_parameters(asset.parameters, asset.name);
    if (!recipe.value || recipe.value->parameters.bakes.size() != 1 || asset.size.size() != 2) {
        return std::nullopt;
    }
    const Parameters& parameters = recipe.value->parameters;
    TableGeometry geometry;
    geometry.shell_ = shell_of(make_medium(parameters.atmosphere));
    geometry.size_ = {asset.size[0], asset.size[1]};
    for (const config::Length& wavelength : parameters.wavelengths) {
        geometry.wavelengths_nm_.push_back(wavelength.meters * 1e9);
    }
    const Bake& bake = parameters.bakes.front();
    if (const auto* transmittance = bake.find<config::TransmittanceBake>()) {
        geometry.is_transmittance_ = true;
        geometry.holds_optical_depth_ =
            transmittance->content == config::TransmittanceContent::optical_depth;
        if (transmittance->mapping == config::TransmittanceMapping::ue) {
            geometry.convention_ = TexelConvention::end_points_on_edges;
        }
        return geometry;
    }
    if (const auto* scattering = bake.find<config::MultipleScatteringBake>()) {
        const bool solved = scattering->method == config::MultipleScatteringMethod::solved;
        geometry.tables_ = tables_of(*scattering);
        geometry.size_[1] /= geometry.tables_;
        geometry.suns_ = sun_columns(scattering->mapping, solved ? parameters.scene : std::nullopt,
                                     geometry.shell_);
        return geometry;
    }
    return std::nullopt;
}

double TableGeometry::largest_zenith_angle(double altitude_km) const {
    if (!is_transmittance_) return 180;
    // The horizon is at r mu = -rho.
    return angle_of(-horizon_distance_km(shell_, altitude_km) /
                    (shell_.ground_radius_km + altitude_km));
}

std::array<double, 2> TableGeometry::texture_coordinates(double altitude_km,
                                                         double zenith_angle) const {
    std::array<double, 2> x{};
    if (is_transmittance_) {
        const UnitCoordinates place =
            transmittance_coordinates(shell_, altitude_km, cosine_of_angle(zenith_angle));
        x = {place.x_mu, place.x_r};
    } else {
        x = {suns_.coordinate(cosine_of_angle(zenith_angle)), altitude_km / shell_.thickness_km};
    }
    return {texture_coordinate(convention_, x[0], size_[0]),
            texture_coordinate(convention_, x[1], size_[1])};
}

double TableGeometry::altitude_km(double v) const {
    return continued(coordinate(v, size_[1]), [this](double y) { return altitude_at(y); });
}

double TableGeometry::altitude_at(double y) const {
    if (!is_transmittance_) return y * shell_.thickness_km;
    return transmittance_ray(shell_, {0, y}).altitude_km;
}

double TableGeometry::zenith_angle(double u, double altitude_km) const {
    const double x_r = transmittance_coordinates(shell_, altitude_km, 1).x_r;
    return continued(coordinate(u, size_[0]), [&](double x) {
        if (!is_transmittance_) return angle_of(suns_.cosine(x));
        return angle_of(cos_zenith_of(shell_, transmittance_ray(shell_, {x, x_r})));
    });
}

double TableGeometry::coordinate(double texture_coordinate, int count) const {
    if (convention_ == TexelConvention::end_points_on_edges) return texture_coordinate;
    if (count == 1) return 0.5;
    return (texture_coordinate * count - 0.5) / (count - 1);
}

}  // namespace skybake
