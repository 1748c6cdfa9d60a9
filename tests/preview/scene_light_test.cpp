// The colours of pictures of one sky, put together from their parts: each is computed here along the
// ray itself, the light of the air by direct integration and that of the clouds by slow marches.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/scene_view.h"
#include "tests/preview/clouds.h"
#include "tests/preview/multiple_scattering_grid.h"
#include "tests/preview/skies.h"
#include "tests/support/air_ray.h"
#include "tests/support/scene_reference.h"

namespace skybake {
namespace {

constexpr double kPi = std::numbers::pi;

// Haze that dims a cloud some kilometres away by a third, over bright ground.
std::vector<std::string> haze() {
    std::vector<std::string> settings = test::large_tables();
    settings.emplace_back("atmosphere.layers.mie.scattering=\"0.1 /km\"");
    settings.emplace_back("atmosphere.layers.mie.extinction=\"0.105 /km\"");
    settings.emplace_back("atmosphere.ground_albedo=0.5");
    return settings;
}

const test::Sky& hazy() {
    static const test::Sky sky = test::sky_of("earth_hillaire", haze());
    return sky;
}

// The light of this air along any ray, with the multiple scattering that its tables hold.
class HazyLight {
  public:
    HazyLight()
        : grid_(hazy().medium.air, 0, kHighestZenith, {48, 24}, 1),
          orders_(hazy().medium.air,
                  [this](double altitude_km, double sun_cosine) {
                      return grid_.at(altitude_km, sun_cosine);
                  }),
          integrator_(hazy().medium, &orders_) {}

    const SkyIntegrator& integrator() const { return integrator_; }

    // The ray from an altitude along a direction, both seen with z upwards.
    static SkyRay ray(double altitude_km, const glm::dvec3& direction, const glm::dvec3& sun) {
        return test::air_ray(shell_of(hazy().medium.air), altitude_km, direction.z, sun.z,
                             glm::dot(direction, sun));
    }

    Spectrum sunlight(double altitude_km, const glm::dvec3& sun) const {
        const double r = shell_of(hazy().medium.air).ground_radius_km + altitude_km;
        return integrator_.sunlight(altitude_km, r * sun.z);
    }

    // The mean over directions, spread evenly over a hemisphere along a spiral; or pi times the mean
    // of the radiance times the cosine, which is the irradiance.
    enum class Mean { radiance, irradiance };
    Spectrum of_hemisphere(double altitude_km, bool upper, const glm::dvec3& sun,
                           Mean mean = Mean::radiance) const {
        constexpr int kDirections = 200;
        Spectrum sum{};
        for (int i = 0; i < kDirections; ++i) {
            const double up = (i + 0.5) / kDirections;
            const double level = std::sqrt(1 - up * up);
            const double turn = 2.399963229728653 * i + 0.123;
            const glm::dvec3 direction(level * std::cos(turn), level * std::sin(turn),
                                       upper ? up : -up);
            sum += (mean == Mean::irradiance ? 2 * kPi * up : 1.0) *
                   integrator_.radiance(ray(altitude_km, direction, sun)).total();
        }
        return sum / double{kDirections};
    }

  private:
    static constexpr double kHighestZenith = 1.9;  // of the sun, at any place that a ray meets
    test::MultipleScatteringGrid grid_;
    IsotropicOrders orders_;
    SkyIntegrator integrator_;
};

const HazyLight& light() {
    static const HazyLight made;
    return made;
}

// A slab of 4 x 4 km and 500 m.
struct Slab {
    double base_m;
    double optical_depth;

    CloudMedium medium() const {
        config::Cloud cloud = test::cloud_of({4000, 4000, 500}, base_m);
        cloud.extinction_scale.per_meter = optical_depth / 500;
        const std::vector<float> voxels(8 * 8 * 32, 1.0F);
        CloudMedium medium = cloud_medium(cloud, voxels.data(), {8, 8, 32}, 1, 1);
        medium.leaps = leaps_of_voxels(medium, 4, 1);
        return medium;
    }
    // The share of diffuse light that passes it (Bohren 1987).
    double through() const {
        const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
        return 2 / (2 + (1 - g) * optical_depth);
    }
};

// A camera's view of slabs, which are listed from the highest down.
struct LitScene {
    std::vector<Slab> slabs;
    CloudCamera camera;
    SunDirection sun = {25, 205};

    glm::dvec3 to_sun() const { return direction_of(sun.elevation_degrees, sun.azimuth_degrees); }
    // Returns the light on a slab times what its march finds.
    Spectrum cloud(std::size_t slab, const ReferenceLayer& seen) const {
        double above = 1;
        double all = 1;
        for (std::size_t l = 0; l < slabs.size(); ++l) {
            if (l < slab) above *= slabs[l].through();
            all *= slabs[l].through();
        }
        const double base_km = slabs[slab].base_m / 1000;
        return light().sunlight(base_km, to_sun()) * seen.sun_at_base +
               light().sunlight(base_km + 0.5, to_sun()) * seen.sun_at_top +
               above * light().of_hemisphere(base_km + 0.5, true, to_sun()) * seen.from_sky +
               all * light().of_hemisphere(base_km, false, to_sun()) * seen.from_ground;
    }
    // The share of its light under a clear sky that the ground below all slabs has. Their direct light
    // is the same everywhere, so its mean is what it is at any place.
    Spectrum ground_share() const {
        double depth = 0;
        double all = 1;
        for (const Slab& slab : slabs) {
            depth += slab.optical_depth / to_sun().z;
            all *= slab.through();
        }
        const double direct = std::exp(-depth);
        const Spectrum sun = to_sun().z * light().sunlight(0, to_sun());
        const Spectrum sky = light().of_hemisphere(0, true, to_sun(), HazyLight::Mean::irradiance);
        return (sun * (direct + std::max(all - direct, 0.0)) + sky * all) / (sun + sky);
    }
    // `pixel` is the width of a pixel at distance 1.
    Spectrum radiance(const std::vector<SceneLayer>& layers, const glm::dvec3& direction,
                      double pixel) const {
        const SkyRay ray = HazyLight::ray(camera.position_m.z / 1000, direction, to_sun());
        const ReferenceScene seen = reference_scene(layers, sun, camera, direction, 400);
        const SkyRadiance behind = light().integrator().radiance(ray);
        const Spectrum mottle = mottled(hazy().medium.air.ground_albedo,
                                        ground_mottle_along(camera.position_m, direction, pixel));
        const Spectrum ground = ray.meets_ground ? mottle * ground_share() : Spectrum(1.0);
        Spectrum sum =
            seen.transmittance * (behind.single + behind.multiple + ground * behind.ground);
        for (std::size_t l = 0; l < layers.size(); ++l) {
            const double opacity = seen.layers[l].opacity;
            if (opacity == 0) continue;
            // The air before it sends the share of its light that its opacity has (Hillaire 2016).
            const double distance_km = seen.layers[l].distance_m / opacity / 1000;
            const auto air = light().integrator().up_to(ray, {distance_km, ray.length_km});
            const Spectrum share =
                (Spectrum(1.0) - air[0].transmittance) / (Spectrum(1.0) - air[1].transmittance);
            sum +=
                air[0].transmittance * cloud(l, seen.layers[l]) + opacity * share * air[1].total();
        }
        return sum;
    }
};

constexpr int kWidth = 24;
constexpr int kHeight = 16;
constexpr int kBlock = 4;

// The mean of some pixels, whose grain it removes.
Spectrum mean_of_block(const Image2<float>& picture, int left, int top) {
    Spectrum sum{};
    for (int y = top; y < top + kBlock; ++y) {
        for (int x = left; x < left + kBlock; ++x) {
            for (std::size_t c = 0; c < 3; ++c) sum[c] += double{picture.texel(x, y)[c]};
        }
    }
    return sum / double{kBlock * kBlock};
}

Image2<float> picture_of(const std::vector<SceneLayer>& layers, const LitScene& scene,
                         const SceneFrame& frame) {
    SceneRenderer renderer(layers, {hazy().medium, hazy().tables}, scene.sun, 1);
    return renderer.render(frame, 1).radiance;
}

// Compares two corners and the middle of a picture that has four samples in each pixel.
void expect_parts(const LitScene& scene) {
    std::vector<CloudMedium> media;
    for (const Slab& slab : scene.slabs) media.push_back(slab.medium());
    std::vector<SceneLayer> layers;
    for (const CloudMedium& medium : media) layers.push_back({&medium, 2.5, 5, 40000, false});
    SceneFrame frame{kWidth, kHeight, scene.camera, Refinement::all, true};
    frame.camera.horizontal_field_degrees = 18;
    const Image2<float> made = picture_of(layers, scene, frame);
    const CameraRays rays(frame.camera, kWidth, kHeight);
    for (const auto& [left, top] : {std::pair{0, 0}, {10, 6}, {20, 12}}) {
        const glm::dvec3 middle = rays.through(left + 0.5 * (kBlock - 1), top + 0.5 * (kBlock - 1));
        const Spectrum wanted = scene.radiance(layers, middle, rays.pixel());
        const Spectrum found = mean_of_block(made, left, top);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c] / wanted[c], 1, 0.02)
                << scene.slabs[0].optical_depth << " " << scene.camera.position_m.z << " "
                << scene.camera.elevation_degrees << " at " << left << " channel " << c;
        }
    }
}

CloudCamera camera_at(double altitude_m, double elevation, double azimuth) {
    CloudCamera camera;
    camera.position_m = {300, 700, altitude_m};
    camera.elevation_degrees = elevation;
    camera.azimuth_degrees = azimuth;
    return camera;
}

TEST(SceneLight, IsTheSumOfItsPartsFromBelow) {
    for (const double depth : {12.0, 0.4}) {
        expect_parts({{{1500, depth}}, camera_at(2, 20, 240)});
        expect_parts({{{1500, depth}}, camera_at(2, 50, 40)});
        expect_parts({{{1500, depth}}, camera_at(500, -30, 100)});  // of the ground in its shadow
    }
}

TEST(SceneLight, IsTheSumOfItsPartsFromAbove) {
    for (const double depth : {12.0, 0.6}) {
        expect_parts({{{1000, depth}}, camera_at(4000, -25, 150)});
        expect_parts({{{1000, depth}}, camera_at(4000, -60, 20)});
    }
}

TEST(SceneLight, IsTheSumOfItsPartsOfTwoLayers) {
    expect_parts({{{3000, 1.5}, {1000, 0.7}}, camera_at(2, 25, 300)});
    expect_parts({{{3000, 1.5}, {1000, 0.7}}, camera_at(2500, -35, 120)});
    expect_parts({{{3000, 6}, {1000, 3}}, camera_at(2500, -30, 210)});
    expect_parts({{{3000, 6}, {1000, 3}}, camera_at(2500, 30, 90)});
}

// The sun has set for the low layer, and shines on the high one from below.
TEST(SceneLight, IsTheSumOfItsPartsAtSunset) {
    expect_parts({{{4000, 3}, {500, 0.3}}, camera_at(2000, 40, 60), {-1.4, 30}});
}

}  // namespace
}  // namespace skybake
