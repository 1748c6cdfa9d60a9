// The light of clouds around a camera, put together from its parts: each is computed here along the ray
// itself, from the light that the air has.
#include <gtest/gtest.h>

#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/field/baked.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"
#include "tests/preview/clouds.h"
#include "tests/support/air_ray.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using config::SkyOrders;
using test::kDegree;
using test::TestSky;

// Haze that dims a cloud some kilometres away by a third.
const SkyLight& hazy() {
    static const TestSky sky(
        test::preset_atmosphere("earth_hillaire", {"atmosphere.layers.mie.scattering=\"0.1 /km\"",
                                                   "atmosphere.layers.mie.extinction=\"0.105 /km\"",
                                                   "atmosphere.ground_albedo=0.5"}),
        SkyOrders::all);
    return sky.light();
}

CloudMedium slab(double base_m, double height_m, double optical_depth) {
    config::Cloud cloud = test::cloud_of({4000, 4000, height_m}, base_m);
    cloud.extinction_scale.per_meter = optical_depth / height_m;
    const std::vector<float> voxels(8 * 8 * 32, 1.0F);
    CloudMedium medium = cloud_medium(cloud, voxels.data(), {8, 8, 32}, 1, 1);
    medium.leaps = leaps_of_voxels(medium, 4, 1);
    return medium;
}

// The ray from an altitude along a direction (right, up, ahead).
SkyRay ray_from(double altitude_km, const glm::dvec3& direction, const glm::dvec3& sun) {
    return test::air_ray(hazy().shell(), altitude_km, direction.y, sun.y, glm::dot(direction, sun));
}

Spectrum radiance_along(const SkyRay& ray) { return hazy().integrator().radiance(ray).total(); }

Spectrum mean_of_hemisphere(double altitude_km, bool upper, const glm::dvec3& sun) {
    Spectrum sum{};
    int count = 0;
    for (const glm::dvec3& direction : test::even_directions(400)) {
        if ((direction.y > 0) != upper) continue;
        sum += radiance_along(ray_from(altitude_km, direction, sun));
        ++count;
    }
    return sum / double(count);
}

Spectrum sunlight(double altitude_km, const glm::dvec3& sun) {
    const double r = hazy().shell().ground_radius_km + altitude_km;
    return hazy().sun_transmittance(altitude_km, r * sun.y);
}

// A scene of a slab, or of two, the upper one thin.
struct LitScene {
    double altitude_m;
    std::array<int, 2> texel;
    std::vector<std::array<double, 2>> slabs;  // base in metres and optical depth, from the highest
    double sun_elevation = 25;
};

void expect_parts(const LitScene& scene) {
    std::vector<CloudMedium> media;
    double through = 1;
    const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
    for (const auto& [base_m, depth] : scene.slabs) {
        media.push_back(slab(base_m, 500, depth));
        through *= 2 / (2 + (1 - g) * depth);
    }
    EnvironmentBake bake;
    bake.size = {32, 16};
    bake.altitude = {scene.altitude_m};
    bake.sun_elevation = {scene.sun_elevation * kDegree};
    bake.sun_azimuth = {70 * kDegree};
    Baked table;
    table.name = "around";
    table.channel_names = {"R", "G", "B"};
    const auto baked = bake_environment(
        hazy(), bake, {.threads = 1, .certification = Certification::off}, table, media);
    ASSERT_TRUE(baked.value);
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(media, bake, layout, true, {.threads = 1});
    const auto [column, row] = scene.texel;
    const SeenClouds seen = clouds.texel(0, column, row);
    const glm::dvec3 sun = direction_of_angles({70 * kDegree, scene.sun_elevation * kDegree});
    const double altitude_km = scene.altitude_m / 1000;
    const SkyRay ray =
        ray_from(altitude_km, layout.direction(0, (column + 0.5) / 32, (row + 0.5) / 16), sun);
    Spectrum wanted = seen.transmittance * radiance_along(ray);
    double from_above = 1;
    for (std::size_t l = 0; l < media.size(); ++l) {
        const SeenLayer& layer = seen.layers[l];
        const double base_km = media[l].base_m / 1000;
        const double top_km = base_km + media[l].extent_m[2] / 1000;
        const Spectrum cloud =
            sunlight(base_km, sun) * layer.sun_at_base + sunlight(top_km, sun) * layer.sun_at_top +
            from_above * mean_of_hemisphere(top_km, true, sun) * layer.from_sky +
            through * mean_of_hemisphere(base_km, false, sun) * layer.from_ground;
        from_above *= 2 / (2 + (1 - g) * scene.slabs[l][1]);
        if (layer.opacity == 0) continue;
        const double distance_km = layer.distance_m / layer.opacity / 1000;
        // The air before it sends the share of its light that its opacity has (Hillaire 2016).
        const auto air =
            hazy().integrator().up_to(ray, {std::min(distance_km, ray.length_km), ray.length_km});
        const Spectrum share =
            (Spectrum(1.0) - air[0].transmittance) / (Spectrum(1.0) - air[1].transmittance);
        wanted += air[0].transmittance * cloud + layer.opacity * share * air[1].total();
    }
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(baked.value->image().texel(column, row)[c] / wanted[c], 1, 0.02)
            << scene.altitude_m << " " << column << " " << row << " channel " << c;
    }
}

TEST(EnvironmentLight, IsTheSumOfItsPartsFromBelow) {
    for (const std::array<int, 2> texel : {std::array{28, 6}, {20, 3}, {4, 5}}) {
        expect_parts({0, texel, {{1500, 12}}});
        expect_parts({0, texel, {{1500, 0.4}}});
    }
    // Haze dims a low sun much more at the base than at the top.
    expect_parts({0, {20, 3}, {{1500, 0.4}}, 4});
    expect_parts({0, {20, 3}, {{1500, 3}}, 4});
}

TEST(EnvironmentLight, IsTheSumOfItsPartsFromAbove) {
    for (const std::array<int, 2> texel : {std::array{28, 9}, {5, 10}}) {
        expect_parts({4000, texel, {{1000, 20}}});
        expect_parts({4000, texel, {{1000, 0.6}}});
    }
}

TEST(EnvironmentLight, IsTheSumOfItsPartsOfTwoLayers) {
    expect_parts({0, {28, 5}, {{3000, 1.5}, {1000, 0.7}}});
    expect_parts({0, {5, 4}, {{3000, 1.5}, {1000, 0.7}}});
    expect_parts({2500, {9, 11}, {{3000, 6}, {1000, 3}}});
    expect_parts({2500, {24, 10}, {{3000, 6}, {1000, 3}}});
}

// The sun is below the horizontal, but above the horizon of the base, 1.76 degrees deep. With two layers it
// shines on the high one alone.
TEST(EnvironmentLight, IsTheSumOfItsPartsAtSunset) {
    expect_parts({5000, {16, 10}, {{3000, 20}}, -1.6});
    expect_parts({2000, {16, 4}, {{4000, 3}, {500, 0.3}}, -1.4});
}

}  // namespace
}  // namespace skybake
