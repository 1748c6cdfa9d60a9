// The colours of pictures of one sky, put together from their parts: each is computed here along the
// ray itself, the light of the air by direct integration and that of the clouds by slow marches.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/light/sky_radiance.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/scene_view.h"
#include "tests/preview/lit_slabs.h"
#include "tests/preview/skies.h"
#include "tests/support/loops.h"
#include "tests/support/scene_reference.h"

namespace skybake {
namespace {

const test::Sky& hazy() {
    static const test::Sky sky = [] {
        std::vector<std::string> settings = test::large_tables();
        settings.insert(settings.end(), test::kHaze.begin(), test::kHaze.end());
        return test::sky_of("earth_hillaire", settings);
    }();
    return sky;
}

// Integrates with the multiple scattering that the tables of this air hold.
const SkyIntegrator& integrator() {
    static const SkyLight light = test::integrated(hazy());
    return light.integrator();
}

// A camera's view of slabs, which are listed from the highest down.
struct LitScene {
    std::vector<test::Slab> slabs;
    CloudCamera camera;
    SunDirection sun = {25, 205};

    test::LightOfAir light() const {
        return {shell_of(hazy().medium.air), integrator(),
                direction_of(sun.elevation_degrees, sun.azimuth_degrees),
                [](double altitude_km, double s_km) {
                    return integrator().sunlight(altitude_km, s_km);
                }};
    }
    // The share of its light under a clear sky that the ground below all slabs has. Their direct light
    // is the same everywhere, so its mean is what it is at any place.
    Spectrum ground_share() const {
        const test::LightOfAir air = light();
        double depth = 0;
        double all = 1;
        for (const test::Slab& slab : slabs) {
            depth += slab.optical_depth / air.sun.z;
            all *= slab.through();
        }
        const double direct = std::exp(-depth);
        const Spectrum sunlight = air.sun.z * air.sunlight(0);
        const Spectrum sky = air.of_hemisphere(0, true, test::LightOfAir::Mean::irradiance);
        return (sunlight * (direct + std::max(all - direct, 0.0)) + sky * all) / (sunlight + sky);
    }
    // `pixel` is the width of a pixel at distance 1.
    Spectrum radiance(const std::vector<SceneLayer>& layers, const glm::dvec3& direction,
                      double pixel) const {
        const test::LightOfAir air = light();
        const SkyRay ray = air.ray(camera.position_m.z / 1000, direction);
        const ReferenceScene seen = reference_scene(layers, sun, camera, direction, 400);
        const SkyRadiance behind = air.integrator.radiance(ray);
        const Spectrum mottle = mottled(hazy().medium.air.ground_albedo,
                                        ground_mottle_along(camera.position_m, direction, pixel));
        const Spectrum ground = ray.meets_ground ? mottle * ground_share() : Spectrum(1.0);
        return seen.transmittance * (behind.single + behind.multiple + ground * behind.ground) +
               air.of_slabs(slabs, seen.layers, ray);
    }
};

constexpr int kWidth = 24;
constexpr int kHeight = 16;
constexpr int kBlock = 4;

// The mean of some pixels, whose grain it removes.
Spectrum mean_of_block(const Image2<float>& picture, int left, int top) {
    Spectrum sum{};
    testing::for_each_voxel({3, kBlock, kBlock}, [&](int c, int x, int y) {
        sum[static_cast<std::size_t>(c)] += double{picture.texel(left + x, top + y)[c]};
    });
    return sum / double{kBlock * kBlock};
}

// Compares two corners and the middle of a picture that has four samples in each pixel.
void expect_parts(const LitScene& scene) {
    std::vector<CloudMedium> media;
    for (const test::Slab& slab : scene.slabs) media.push_back(slab.medium());
    std::vector<SceneLayer> layers;
    for (const CloudMedium& medium : media) layers.push_back({&medium, 2.5, 5, 40000});
    SceneFrame frame{kWidth, kHeight, scene.camera, Refinement::all, true};
    frame.camera.horizontal_field_degrees = 18;
    SceneRenderer renderer(layers, {hazy().medium, hazy().tables}, scene.sun, 1);
    const Image2<float> made = renderer.render(frame, 1).radiance;
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
