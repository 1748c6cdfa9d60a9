// A cloud's layer as rays towards the sun meet it: the trilinearly filtered values of a stored
// volume, which repeat along x and y and are clamped along z, and the extinction that they mean.
//
// Places are in voxel units: voxel i of an axis has its centre at i + 1/2, the layer begins at z = 0
// and ends at z = size[2], and there is nothing above it.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "bakers/air/cloud_phase.h"
#include "bakers/assets/cloud_light/sky_parts.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "bakers/math/memory.h"
#include "bakers/math/vectors.h"
#include "config/sections/cloud.h"

namespace skybake {
struct Baked;
}  // namespace skybake

namespace skybake::cloud_light {

// The radiance of the sky above a layer over its mean. Both functions are of the same sky.
struct LayerSky {
    SkyByDirection shape;
    SkyByDirection reference;  // by other samples and another interpolation
};

struct CloudLayer {
    std::array<int, 3> size{};
    std::array<double, 3> voxel_m{};  // edges of a voxel in metres
    CloudOptics optics;
    AlignedFloats values;  // as stored, x fastest
    // The voxels along x and y after which a ray ends. A cloud that stands alone has none of its copies
    // within them.
    std::array<double, 2> reach = {std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::infinity()};
    LayerSky sky;  // empty unless the asset's light is that of a clear sky (layer_sky.h)
    std::optional<NeedKey> solution;  // of its radiance, if assets share it (radiance_volume.h)

    // A voxel within the volume.
    float value(int x, int y, int z) const {
        return values[(static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) +
                       static_cast<std::size_t>(y)) *
                          static_cast<std::size_t>(size[0]) +
                      static_cast<std::size_t>(x)];
    }
    // A lookup above this is cloud.
    float threshold() const {
        return optics.has_edge ? static_cast<float>(optics.threshold) : 0.0F;
    }
};

// Reads a channel of the volume's level 0, rounded to its pixel type. `cloud` has the extent of the
// volume. The layer is incomplete once options.progress is cancelled.
CloudLayer make_layer(const Baked& volume, std::size_t channel, const Cloud& cloud,
                      const BakeOptions& options);

// Returns the extinction in 1/m at a place of the repeated layer, filtered in double; 0 above the
// layer and below it.
double extinction_at(const CloudLayer& layer, const glm::dvec3& place);

// The unit vector towards a sun at an elevation above the horizon and an azimuth from +x towards +y,
// in radians.
glm::dvec3 towards(double elevation, double azimuth);

// Returns a direction in metres in voxel units per metre.
glm::dvec3 in_voxels(const CloudLayer& layer, const glm::dvec3& direction);

// Returns the metres after which a ray from a place leaves the layer. It goes `along` voxels per metre, upwards.
double ray_length(const CloudLayer& layer, const glm::dvec3& place, const glm::dvec3& along);

}  // namespace skybake::cloud_light
