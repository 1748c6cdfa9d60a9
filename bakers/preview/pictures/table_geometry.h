// Converts the coordinates of a baked table to altitudes and zenith angles, and back.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/light/multiple_scattering_mapping.h"

namespace skybake {

// Zenith angles are those of the ray in a table of transmittance, and of the sun in a table of
// multiple scattering. x and y are a mapping's own coordinates, in [0, 1].
class TableGeometry {
  public:
    // Makes the geometry from a table's manifest entry. Returns nothing if this release does not
    // know its mapping or its parameters.
    static std::optional<TableGeometry> of(const ManifestAsset& asset);

    bool is_transmittance() const { return is_transmittance_; }
    // Whether its texels are optical depths in place of transmittances.
    bool holds_optical_depth() const { return holds_optical_depth_; }
    double thickness_km() const { return shell_.thickness_km; }
    // How many tables of equal size lie below each other. The functions below are those of the first.
    int tables() const { return tables_; }
    // One per channel.
    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }

    // Returns the largest zenith angle, in degrees, of a ray from an altitude that does not hit the
    // ground. It is 180 for suns, which the table also has below the horizon.
    double largest_zenith_angle(double altitude_km) const;

    // Returns the texture coordinates of a place. The zenith angle must not exceed the largest at
    // its altitude.
    std::array<double, 2> texture_coordinates(double altitude_km, double zenith_angle) const;

    // Return the inverse: the altitude and the zenith angle at texture coordinates in [0, 1]. A
    // mapping's end points may be half a texel inside of the texture; beyond them, the function is
    // continued by odd reflection. The zenith angle of transmittance depends on the altitude.
    double altitude_km(double v) const;
    double zenith_angle(double u, double altitude_km) const;

  private:
    // Returns the mapping's coordinate, in [0, 1] or up to half a texel beyond.
    double coordinate(double texture_coordinate, int count) const;
    double altitude_at(double y) const;

    bool is_transmittance_ = false;
    bool holds_optical_depth_ = false;
    int tables_ = 1;
    Shell shell_;
    TexelConvention convention_ = TexelConvention::end_points_on_texel_centres;
    SunColumns suns_;  // of multiple scattering
    std::array<int, 2> size_{};
    std::vector<double> wavelengths_nm_;
};

}  // namespace skybake
