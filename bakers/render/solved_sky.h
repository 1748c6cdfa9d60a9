// The solved sky that a camera sees under a sun, looked up in a baked asset `sky_view`: all orders
// of scattering, without the sun's disc, with the ground below the horizon.
#pragma once

#include <optional>

#include "bakers/air/ray.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

class SolvedSky {
  public:
    // The camera's altitude, and the sun's elevation.
    struct Place {
        double altitude_km = 0;
        double sun_elevation_degrees = 0;
        bool operator==(const Place&) const = default;
    };
    // Returns nothing if the asset is not a sky view, in this shell, of one sun.
    static std::optional<SolvedSky> of(const PreviewAsset& sky_view, const Shell& shell,
                                       const Place& place);

    const Place& place() const { return place_; }
    int channels() const { return table_.channels; }

    // Writes the radiance (1/sr, for a solar irradiance of 1) of each channel along an elevation and an
    // azimuth from the sun, in degrees.
    void look_up(double elevation_degrees, double azimuth_degrees, double* radiance) const;

  private:
    SolvedSky(const Image2<float>& table, const Shell& shell, const Place& place)
        : table_(table), camera_(shell, place.altitude_km), place_(place) {}

    Image2<float> table_;
    SkyViewCamera camera_;
    Place place_;
};

}  // namespace skybake
