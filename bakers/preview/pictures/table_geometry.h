// What the coordinates of a baked table mean: altitudes and zenith angles.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/light/multiple_scattering_mapping.h"

namespace skybake {

// Zenith angles are those of the ray in a table of transmittance, of the sun in one of multiple
// scattering. x and y are a mapping's own coordinates, in [0, 1].
class TableGeometry {
  public:
    // From what a manifest says of a table; none where its mapping or its parameters are unknown
    // to this release.
    static std::optional<TableGeometry> of(const ManifestAsset& asset);

    bool is_transmittance() const { return is_transmittance_; }
    double thickness_km() const { return shell_.thickness_km; }
    // One per channel.
    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }

    // The largest zenith angle of a ray at an altitude that does not hit the ground; 180 for suns,
    // which the table has below the horizon, too.
    double largest_zenith_angle(double altitude_km) const;

    // The texture coordinates of a place; zenith angles up to the largest at its altitude.
    std::array<double, 2> texture_coordinates(double altitude_km, double zenith_angle) const;

    // The inverse: what lies at texture coordinates in [0, 1]. Beyond a mapping's end points, which
    // may lie half a texel inside of the texture, it goes on as it came, mirrored. The zenith angle
    // of transmittance depends on the altitude.
    double altitude_km(double v) const;
    double zenith_angle(double u, double altitude_km) const;

  private:
    // The mapping's coordinate, in [0, 1] and half a texel beyond.
    double coordinate(double texture_coordinate, int count) const;
    double altitude_at(double y) const;

    bool is_transmittance_ = false;
    Shell shell_;
    TexelConvention convention_ = TexelConvention::end_points_on_texel_centres;
    SunColumns suns_;  // of multiple scattering
    std::array<int, 2> size_{};
    std::vector<double> wavelengths_nm_;
};

}  // namespace skybake
