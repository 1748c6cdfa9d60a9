// The light of the sun's disc at the camera of an environment.
//
// The disc is 0.533 degrees wide (sun_disc.h of render) and evenly bright, spread over points of equal
// weight. The horizon cuts it; each point's light is dimmed by the air, and by the clouds, along its
// own direction.
#pragma once

#include <vector>

#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/image.h"
#include "bakers/math/bake_options.h"

namespace skybake::config {
struct EnvironmentBake;
}  // namespace skybake::config

namespace skybake {

inline constexpr double kSunRadius_deg = 0.2665;

// One point of the disc: its direction (right, up, ahead) and the irradiance, at normal incidence, of
// its share of the disc, one value for each channel that files hold.
struct SunPoint {
    glm::dvec3 direction{};
    std::vector<double> light;
};

// `clouds` may be null. The sum of the points' light is the irradiance of a surface that faces the
// sun, for a solar irradiance of 1.
std::vector<SunPoint> sun_points(const SkyLights& lights, const config::EnvironmentBake& bake,
                                 const CloudsAround* clouds);

// Returns the irradiance by all points of a surface that faces the sun, or of a level one.
enum class LitSurface { facing_sun, level };
std::vector<double> irradiance_of(const std::vector<SunPoint>& points, LitSurface surface,
                                  int channels);

// Adds the light of each point to the texel that shows its direction, as radiance: light over the
// texel's solid angle.
void add_sun_points(const std::vector<SunPoint>& points, const EnvironmentLayout& layout,
                    Image2<double>& map);

// Returns fewer points, each of which stands for neighbours, for what blurs the disc.
std::vector<SunPoint> merged(const std::vector<SunPoint>& points);

// Adds the light of each point that rough surfaces reflect to a level: the closed form of prefilter.h in
// the place of its sums, which would find a disc smaller than their samples by chance. A texel has the
// value in its middle, or its mean where the lobe is narrower than the texel.
void add_reflected_sun(const std::vector<SunPoint>& points, const EnvironmentLayout& layout,
                       double roughness, const BakeOptions& options, Image2<double>& level);

}  // namespace skybake
