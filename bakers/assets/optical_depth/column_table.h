// The texels of a table of columns: where each path has its place, and what is stored there.
//
// Stored is the eighth root of the path's mean density (column over length; the density itself
// where the path has no length), which is 0 exactly where there is nothing. Means of thin layers
// fall by decades from texel to texel; their eighth roots are near enough to straight lines between
// texels, and a runtime squares three times to undo it:
//
//   column = t^8 length,   transmittance = exp(-sum over kinds of extinction * column).
//
// Texels along u belong to kinds (column_mapping.h), in this order, of N in all:
//
//   to_top, between by altitudes   upward N - N/2, limb N/2
//   between by distance            upward N/4, limb N/2, ground the rest
//
// Coordinates 0 and 1 fall on the centres of the first and last texel of a kind, and of v and w.
#pragma once

#include <array>
#include <vector>

#include "bakers/assets/optical_depth/column_mapping.h"
#include "bakers/field/choose_probes.h"
#include "config/assets/optical_depth.h"

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

    ColumnTableKind kind() const;
    const std::array<int, 3>& size() const { return size_; }
    const std::vector<RayTexels>& kinds() const { return kinds_; }
    const ColumnGeometry& geometry() const { return geometry_; }

    // The path of a texel.
    ColumnPath path_of_texel(const std::array<int, 3>& texel) const;

    // The path at texture coordinates that a lookup may have.
    ColumnPath path_at(const std::array<double, 3>& uvw) const;

    // The nearest texture coordinates that a lookup may have: none come beyond the outer centres,
    // nor between the texels of two kinds.
    std::array<double, 3> lookup_place(const std::array<double, 3>& uvw) const;

    // Where a path is looked up.
    std::array<double, 3> texture_coordinates(const ColumnPath& path) const;

  private:
    ColumnPath path(RayKind kind, double u, double v, double w) const;
    const RayTexels& texels_of(RayKind kind) const;

    bool to_top_;
    config::BetweenCoordinates coordinates_;
    std::array<int, 3> size_;
    ColumnGeometry geometry_;
    std::vector<RayTexels> kinds_;
};

// Where the probes of a table of columns may lie.

// The path of texture coordinates, kept off the horizon by kHorizonMargin, by what a runtime knows
// of it:
//
//   to_top                    altitude_km, cos_zenith
//   between by altitudes      low_altitude_km, high_altitude_km, angle_at_centre_deg
//   between by distance       altitude_km, cos_zenith, length_km
ProbePlace column_probe_place(const ColumnTable& table, const std::array<double, 3>& uvw);

// The texture coordinates of the place that a probe names.
std::array<double, 3> column_texture_coordinates(
    const ColumnTable& table, const std::vector<std::pair<std::string, double>>& at);

}  // namespace skybake
