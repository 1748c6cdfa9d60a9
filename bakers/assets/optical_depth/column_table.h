// The texels of a table of columns: where each path has its place, and what is stored there.
//
// Stored is the eighth root of the path's mean density (column over length; the density itself
// where the path has no length), which is 0 exactly where there is nothing. Means of thin layers
// fall by decades from texel to texel; their eighth roots are near enough to straight lines between
// texels, and a runtime squares three times to undo it:
//
//   column = t^8 length,   transmittance = exp(-sum over kinds of extinction * column).
//
// Texels along u belong to courses (column_mapping.h), in this order, of N in all:
//
//   to_top, between by altitudes   rises N - N/2, passes N/2
//   between by distance            rises N/4, passes N/2, falls the rest
//
// Coordinates 0 and 1 fall on the centres of the first and last texel of a course, and of v and w.
#pragma once

#include <array>
#include <vector>

#include "bakers/assets/optical_depth/column_mapping.h"
#include "config/assets/optical_depth.h"

namespace skybake {

double stored_of_mean_density(double mean_density);
double mean_density_of_stored(double stored);

enum class ColumnTableKind { to_top, between_altitudes, along_distance };

// Texels of a course along u.
struct CourseTexels {
    Course course = Course::rises;
    int first = 0;
    int count = 0;
};

class ColumnTable {
  public:
    ColumnTable(const config::OpticalDepthBake& bake, const ColumnGeometry& geometry);

    ColumnTableKind kind() const;
    const std::array<int, 3>& size() const { return size_; }
    const std::vector<CourseTexels>& courses() const { return courses_; }
    const ColumnGeometry& geometry() const { return geometry_; }

    // The path of a texel.
    ColumnPath path_of_texel(const std::array<int, 3>& texel) const;

    // The path at texture coordinates that a lookup may have.
    ColumnPath path_at(const std::array<double, 3>& uvw) const;

    // The nearest texture coordinates that a lookup may have: none come beyond the outer centres,
    // nor between the texels of two courses.
    std::array<double, 3> lookup_place(const std::array<double, 3>& uvw) const;

    // Where a path is looked up.
    std::array<double, 3> texture_coordinates(const ColumnPath& path) const;

  private:
    ColumnPath path(Course course, double u, double v, double w) const;
    const CourseTexels& texels_of(Course course) const;

    bool to_top_;
    config::BetweenCoordinates coordinates_;
    std::array<int, 3> size_;
    ColumnGeometry geometry_;
    std::vector<CourseTexels> courses_;
};

}  // namespace skybake
