// The coordinates of a path in the tables of columns.
//
// A path is a straight line in the shell that does not enter the ground. It is an *upward* ray,
// which rises along its whole length; a *limb* ray, which passes its point nearest to the planet's
// centre at the altitude h_p; or a *ground* ray, which falls to the ground. Each kind has its own
// texels along u. Tables must resolve altitudes, those of the ends and h_p: thin fog is a few scale
// heights out of 64 km. Altitudes are scaled by
//
//   g(h) = sqrt(ln(1 + h / f) / ln(1 + D / f)),   D the shell's thickness, f `fine_km`,
//
// which behaves as sqrt(h), smooth along grazing rays, up to f and as sqrt(ln h) above. With R the
// ground's radius, r = R + h, s = r mu and mu the cosine of the zenith angle, the coordinates in
// [0, 1] are:
//
//   to the top, from h
//     altitude  g(h)
//     upward    angle = (d - d_0) / (d_h - d_0), d the distance to the top, d_0 = D - h that of the
//               vertical ray, d_h that of the level one (Bruneton & Neyret 2008, above the
//               horizontal)
//     limb      angle = sqrt(1 - g(h_p) / g(h)), 0 for a level ray and 1 for one that grazes the
//               ground
//   between two points at altitudes low <= high, so that exchanging them changes nothing
//     high      g(high)
//     low       g(low) / g(high)
//     upward    angle = (d - d_0) / (d_h - d_0), d their distance, d_0 = high - low, d_h that of a
//               path which is level at the lower point
//     limb      angle = sqrt(1 - g(h_p) / g(low))
//   from h along a ray
//     altitude  g(h)
//     upward    angle as to the top
//               distance = sqrt((g(h') - g(h)) / (1 - g(h))), h' the altitude where the path ends
//     limb      angle as to the top
//               distance = (b(end) - b(start)) / (b(top) - b(start)),
//               b = sqrt(g(altitude) - g(h_p)), negative before the nearest point
//     ground    angle = (rho - d) / (rho - h), d the distance to the ground, rho to the horizon
//               distance = 1 - sqrt(g(h') / g(h))
//
// All coordinates are continuous from kind to kind. Hard cases: h = 0 and D, where ranges have no
// width (the coordinate is 0); paths of no length; h_p = 0; level rays.
#pragma once

#include "bakers/air/ray.h"

namespace skybake {

struct AltitudeScale {
    double thickness_km = 0;
    double fine_km = 0;  // f: below it g behaves as sqrt(h)
};

// Returns g, from 0 to 1. altitude_at is its inverse.
double scaled_altitude(const AltitudeScale& scale, double altitude_km);
double altitude_at(const AltitudeScale& scale, double scaled);

struct ColumnGeometry {
    Shell shell;
    AltitudeScale scale;
};

// A path that starts at an altitude, with s = r mu there. A path between two points starts at the
// lower one.
struct ColumnPath {
    double altitude_km = 0;
    double s_km = 0;
    double length_km = 0;
};

// Returns the altitude where a path ends.
double end_altitude_km(const Shell& shell, const ColumnPath& path);

enum class RayKind { upward, limb, ground };

struct TopCoordinates {
    RayKind kind = RayKind::upward;
    double angle = 0;
    double altitude = 0;
};
ColumnPath path_to_top(const ColumnGeometry& geometry, const TopCoordinates& x);
TopCoordinates top_coordinates(const ColumnGeometry& geometry, double altitude_km, double s_km);

struct PairCoordinates {
    RayKind kind = RayKind::upward;
    double angle = 0;
    double high = 0;
    double low = 0;
};
ColumnPath path_between(const ColumnGeometry& geometry, const PairCoordinates& x);

// Returns the coordinates of a path in either direction.
PairCoordinates pair_coordinates(const ColumnGeometry& geometry, const ColumnPath& path);

// Returns the path between two altitudes whose ends are `angle` radians apart as seen from the
// planet's centre. It must not enter the ground.
ColumnPath path_of_angle(const Shell& shell, double altitude_km, double other_altitude_km,
                         double angle);

struct DistanceCoordinates {
    RayKind kind = RayKind::upward;
    double angle = 0;
    double altitude = 0;
    double distance = 0;
};
ColumnPath path_along(const ColumnGeometry& geometry, const DistanceCoordinates& x);
DistanceCoordinates distance_coordinates(const ColumnGeometry& geometry, const ColumnPath& path);

}  // namespace skybake
