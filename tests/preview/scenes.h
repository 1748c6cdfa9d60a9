// Scenes of several layers of cloud in memory, and their pictures under the sky of Earth.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/render/scene_view.h"
#include "tests/preview/clouds.h"
#include "tests/preview/skies.h"

namespace skybake::test {

inline CloudMedium clumps(const std::array<double, 3>& extent_m, double base_m,
                          const std::array<int, 3>& size, std::uint32_t seed, double filled = 0.3) {
    return medium_of(extent_m, base_m, size, clumped_voxels(size, seed, filled));
}

// Three layers: two that overlap in altitude and one far above, of tiles of different sizes.
struct ThreeLayers {
    CloudMedium low = clumps({1200, 900, 600}, 500, {12, 9, 6}, 3);
    CloudMedium overlapping = clumps({700, 1100, 500}, 800, {7, 11, 5}, 4);
    CloudMedium high = clumps({2000, 1500, 300}, 2500, {10, 15, 4}, 5);

    explicit ThreeLayers(bool varied = false) {
        for (CloudMedium* medium : {&low, &overlapping, &high}) {
            if (varied) medium->variation = varied_tiles(*medium);
        }
    }
    std::vector<SceneLayer> layers(double step_m) const {
        return {{&low, step_m, step_m, 8000},
                {&overlapping, step_m, step_m, 8000},
                {&high, step_m, step_m, 8000}};
    }
};

inline SceneFrame frame_from(const glm::dvec3& position, double elevation_degrees, int width = 6,
                             int height = 4) {
    SceneFrame frame;
    frame.width = width;
    frame.height = height;
    frame.camera.position_m = position;
    frame.camera.azimuth_degrees = 33;
    frame.camera.elevation_degrees = elevation_degrees;
    return frame;
}

inline Image2<float> picture_of(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                                const SceneFrame& frame) {
    SceneRenderer renderer(layers, {earth().medium, earth().tables}, sun, 1);
    return renderer.render(frame, 1).radiance;
}

}  // namespace skybake::test
