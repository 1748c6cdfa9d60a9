// The clear sky around a camera in any direction, interpolated between the rays of a table whose rows
// part at the horizon.
//
// Azimuths are spaced evenly from the sun to its opposite side, angles above and below the horizon as
// squares (sky_view_mapping.h). Between them values are cubic polynomials through the four nearest
// nodes along each axis.
//
// The model of the asset sky_view for rows of thousands of azimuths.
#pragma once

#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/field/image.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/bake_options.h"

namespace skybake {

class SkyAround {
  public:
    // `sky` is a model of sky_view, or the colours made of several. `camera` must outlive this
    // object.
    SkyAround(const TableModel& sky, const SkyViewCamera& camera, const BakeOptions& options);

    // Writes the channels at an angle above the horizontal in radians, and an azimuth from the sun in
    // half turns to either side, in [-2, 2].
    void at(double elevation, double half_turns, double* values) const;

  private:
    const SkyViewCamera& camera_;
    double lowest_;
    // The halves of the sphere; row 0 is at the horizon.
    Image2<double> above_;
    Image2<double> below_;
};

// Returns an azimuth in half turns, to either side, as the turns from the sun in [0, 1].
double turn_from_sun(double half_turns);

// Whether a camera sees air or ground at an angle above the horizon. Rays from space that pass above
// the air see nothing.
bool sees_air(const SkyViewCamera& camera, double above_horizon);

// Returns sky_view_model with rows by wide_row.h. All arguments must outlive the model.
TableModel wide_sky_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground = SeenGround::lit);

}  // namespace skybake
