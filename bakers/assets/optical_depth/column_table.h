// The texels of a table of columns: the place of each path, the quantity that is stored there, and
// the places of probes.
//
// The stored quantity is the eighth root of the path's mean density (column divided by length, or
// the density itself if the path has no length), which is 0 exactly where there are no particles.
// The means of thin layers fall by decades from texel to texel; their eighth roots are close enough
// to straight lines between texels, and a runtime squares three times to undo the root:
//
//   column = t^8 length,   transmittance = exp(-sum over kinds of extinction * column).
//
// Texels along u belong to kinds of rays (column_mapping.h), in this order, with N texels in all:
//
//   to_top, between by altitudes   upward N - N/2, limb N/2
//   between by distance            upward N/4, limb N/2, ground the rest
//
// Coordinates 0 and 1 are the centres of the first and last texel of a kind, and of v and w.
#pragma once

#include <array>
#include <vector>

#include "bakers/assets/optical_depth/column_mapping.h"
#include "bakers/field/choose_probes.h"

namespace skybake::config {
struct OpticalDepthBake;
}  // namespace skybake::config

namespace skybake {

double stored_of_mean_density(double mean_density);
double mean_density_of_stored(double stored);

enum class ColumnTableKind { to_top, between_altitudes, along_distance };

// Texels of a kind along u.
struct RayTexels {
    RayKind kind = RayKind::upward;
    int first = 0;
    int count = 0;
};

class ColumnTable {
  public:
    ColumnTable(const config::OpticalDepthBake& bake, const ColumnGeometry& geometry);

    ColumnTableKind kind() const { return kind_; }
    const std::array<int, 3>& size() const { return size_; }
    const std::vector<RayTexels>& kinds() const { return kinds_; }
    const ColumnGeometry& geometry() const { return geometry_; }

    // The path of a texel.
    ColumnPath path_of_texel(const std::array<int, 3>& texel) const;

    // Returns the path at texture coordinates that a lookup may have.
    ColumnPath path_at(const std::array<double, 3>& uvw) const;

    // Returns the nearest texture coordinates that a lookup may have: none lie beyond the outer
    // centres or between the texels of two kinds.
    std::array<double, 3> lookup_place(const std::array<double, 3>& uvw) const;

    // Returns the texture coordinates at which a path is looked up.
    std::array<double, 3> texture_coordinates(const ColumnPath& path) const;

  private:
    ColumnPath path(RayKind kind, double u, double v, double w) const;
    const RayTexels& texels_of(RayKind kind) const;

    ColumnTableKind kind_;
    std::array<int, 3> size_;
    ColumnGeometry geometry_;
    std::vector<RayTexels> kinds_;
};

// Returns the path of texture coordinates, at least kHorizonMargin away from the horizon, by
// quantities that a runtime knows:
//
//   to_top                    altitude_km, cos_zenith
//   between by altitudes      low_altitude_km, high_altitude_km, angle_at_centre_deg
//   between by distance       altitude_km, cos_zenith, length_km
ProbePlace column_probe_place(const ColumnTable& table, const std::array<double, 3>& uvw);

// Returns the path that a probe names.
ColumnPath column_path_of(const ColumnTable& table,
                          const std::vector<std::pair<std::string, double>>& at);

// Returns the texture coordinates of the place that a probe names.
std::array<double, 3> column_texture_coordinates(
    const ColumnTable& table, const std::vector<std::pair<std::string, double>>& at);

}  // namespace skybake
