// A runtime's march through a cloud with the textures of a way: stored voxels, the published lookups
// (examples/lookups/cloud_light.glsl), and the fetches that they take.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/field/baked.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/plan/cloud_ways.h"

namespace skybake {

// A texture as it is stored: a volume that repeats along x and y, or a table with end points on the
// centres of texels.
class StoredTexture {
  public:
    explicit StoredTexture(const Baked& baked);

    std::size_t channels() const { return channels_.size(); }
    // Returns the sum of the channels' trilinear lookups, each times its factor, at a place in shares of
    // the tile, or at coordinates of a table.
    double sum_at(const glm::dvec3& place, const double* factors) const;
    // Returns the lookup of the only channel.
    double at(const glm::dvec3& place) const {
        constexpr double kOnce = 1;
        return sum_at(place, &kOnce);
    }

  private:
    std::array<int, 3> size_{};
    bool is_table_ = false;
    std::vector<std::vector<float>> channels_;
};

// The textures of a way that rays read under one sun.
struct CloudTextures {
    const cloud_light::CloudLayer* layer = nullptr;  // its densities
    const StoredTexture* small_angles = nullptr;     // of radiance
    const StoredTexture* depth = nullptr;            // to the sun
    std::vector<const StoredTexture*> parts;         // of harmonics or radiance
};

struct MarchedRay {
    double radiance = 0;  // in 1/sr, of sunlight of the irradiance 1
    double passed = 1;    // of what is behind the cloud
    double length_m = 0;  // of the march, which ends where little is seen of what follows
    int lit = 0;          // samples that ask for light
};

// Marches a ray from a place in shares of the tile. `sun` is a unit vector towards the sun.
MarchedRay march_cloud(const CloudWay& way, const CloudTextures& textures, const glm::dvec3& place,
                       const glm::dvec3& look, const glm::dvec3& sun);

// The distance in metres between the samples of a way.
double stride_m(const CloudWay& way, const cloud_light::CloudLayer& layer);

// Finds the fetches of densities and cells along rays, with the cells of an occupancy grid or, with null,
// without any.
class CloudFetches {
  public:
    CloudFetches(const cloud_light::CloudLayer& layer, double stride_m, const Baked* cells,
                 int cell);

    occupancy::MarchFetches along(const glm::dvec3& place, const glm::dvec3& look,
                                  double length_m) const;

  private:
    const cloud_light::CloudLayer& layer_;
    double stride_m_;
    int cell_;  // 0: without cells
    std::vector<std::uint8_t> leaps_;
};

}  // namespace skybake
