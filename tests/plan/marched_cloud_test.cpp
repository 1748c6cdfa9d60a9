#include "bakers/plan/marched_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/march/cloud_light.h"

namespace skybake {
namespace {

// A layer of even density: 8x8x8 voxels of 50 m, with an optical depth of 2 from face to face.
cloud_light::CloudLayer slab() {
    cloud_light::CloudLayer layer;
    layer.size = {8, 8, 8};
    layer.voxel_m = {50, 50, 50};
    layer.optics.extinction_per_m = 2.0 / 400;
    layer.values.assign(512, 1.0F);
    return layer;
}

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.6, 0, 0.8));
const glm::dvec3 kLook = glm::normalize(glm::dvec3(0, 0.6, 0.8));

double droplet_phase_at(double cosine) {
    return cloud_light::phase_value(
        cloud_light::scattering_of(droplet_phase(kDropletDiameter_um), 1), 1 - cosine, 1 + cosine);
}

CloudWay single_scattering() {
    CloudWay way;
    way.single = true;
    way.sun_samples = 64;
    return way;
}

// Seen from below, light scattered once by a slab of the depth t is p t' exp(-t') for equal slants,
// where t' = t / 0.8.
TEST(MarchedCloud, ScattersOnceAsASlabDoes) {
    const cloud_light::CloudLayer layer = slab();
    CloudTextures textures;
    textures.layer = &layer;
    const CloudWay way = single_scattering();
    const MarchedRay ray = march_cloud(way, textures, {0.2, 0.3, 0}, kLook, kSun);
    const double slant = 2 / 0.8;
    EXPECT_NEAR(ray.passed, std::exp(-slant), 0.02 * std::exp(-slant));
    const double wanted = droplet_phase_at(glm::dot(kLook, kSun)) * slant * std::exp(-slant);
    EXPECT_NEAR(ray.radiance, wanted, 0.02 * wanted);
    EXPECT_EQ(ray.lit, 10) << "500 m in steps of 50 m";
}

Baked texture_of(float value) {
    Baked baked;
    baked.pixel_type = config::PixelType::float32;
    baked.channel_names = {"Y"};
    baked.axes.resize(3);
    Level level;
    level.size = {2, 2, 2};
    class Even : public VoxelSource {
      public:
        explicit Even(float value) : value_(value) {}
        void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
            std::fill_n(channels[0], box.count(), value_);
        }

      private:
        float value_;
    };
    level.voxels = std::make_shared<const Even>(value);
    baked.levels = {level};
    return baked;
}

// A depth texture of zeros, as a wrong bake would give, lights the slab as if the sun shone through.
TEST(MarchedCloud, WrongDepthsShow) {
    const cloud_light::CloudLayer layer = slab();
    const StoredTexture zeros(texture_of(0));
    const StoredTexture mean(texture_of(1.25F));
    CloudTextures textures;
    textures.layer = &layer;
    textures.depth = &zeros;
    CloudWay way = single_scattering();
    way.lighting = CloudLighting::depth;
    const double lit = march_cloud(way, textures, {0.2, 0.3, 0}, kLook, kSun).radiance;
    textures.depth = &mean;
    const MarchedRay ray = march_cloud(way, textures, {0.2, 0.3, 0}, kLook, kSun);
    EXPECT_NEAR(ray.radiance, lit * std::exp(-1.25), 1e-12);
    EXPECT_EQ(ray.lit, 10);
}

// More of the light is nearer to all of it: the octaves' sum lies above its first term.
TEST(MarchedCloud, OctavesAddLight) {
    const cloud_light::CloudLayer layer = slab();
    CloudTextures textures;
    textures.layer = &layer;
    CloudWay way = single_scattering();
    const double once = march_cloud(way, textures, {0.2, 0.3, 0}, kLook, kSun).radiance;
    way.single = false;
    EXPECT_GT(march_cloud(way, textures, {0.2, 0.3, 0}, kLook, kSun).radiance, 1.1 * once);
}

TEST(CloudFetches, CountSamplesOfEveryStride) {
    const cloud_light::CloudLayer layer = slab();
    const CloudFetches straight(layer, 50, nullptr, 0);
    const glm::dvec3 up(0, 0, 1);
    EXPECT_EQ(straight.along({0.5, 0.5, 0}, up, 375).all(), 8) << "at 25, 75 ... 375 m";
    const CloudFetches twice(layer, 100, nullptr, 0);
    EXPECT_EQ(twice.along({0.5, 0.5, 0}, up, 300).all(), 4);
}

// An empty volume whose cells say so costs one look at them.
TEST(CloudFetches, LeapOverEmptyCells) {
    cloud_light::CloudLayer layer = slab();
    std::fill(layer.values.begin(), layer.values.end(), 0.0F);
    Baked cells = texture_of(255.0F / 255);
    const CloudFetches leaping(layer, 50, &cells, 4);
    EXPECT_EQ(leaping.along({0.5, 0.5, 0}, glm::dvec3(0, 0, 1), 375).structure, 1);
    Baked full = texture_of(0);
    const CloudFetches occupied(layer, 50, &full, 4);
    EXPECT_EQ(occupied.along({0.5, 0.5, 0}, glm::dvec3(0, 0, 1), 375).all(), 8 + 2);
}

}  // namespace
}  // namespace skybake
