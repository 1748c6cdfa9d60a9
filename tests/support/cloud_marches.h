// One cloud layer, marched by itself.
#pragma once

#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"
#include "bakers/render/scene_view.h"

namespace skybake {

struct MarchSettings : CloudViewSettings {
    bool leaping = true;                   // uses medium.leaps; changes no pixel
    bool sunlit = true;                    // false: march_view does not march towards the sun
    const LightInCloud* solved = nullptr;  // null: the light of octaves

    SceneLayer layer(const CloudMedium& medium) const {
        return {&medium, step_m, light_step_m, reach_m, 1, solved};
    }
    SceneFrame frame() const { return {width, height, camera}; }
};

inline MarchedScene march_view(const CloudMedium& medium, const MarchSettings& settings,
                               int threads) {
    return SceneMarch({settings.layer(medium)}, settings.sun, settings.sunlit, settings.leaping,
                      threads)
        .march(settings.frame(), threads, nullptr);
}

inline Image2<float> render_cloud(const CloudMedium& medium, const Atmosphere& atmosphere,
                                  const MarchSettings& settings, int threads) {
    SceneRenderer renderer({settings.layer(medium)}, atmosphere, settings.sun, threads);
    return renderer.render(settings.frame(), threads).radiance;
}

}  // namespace skybake
