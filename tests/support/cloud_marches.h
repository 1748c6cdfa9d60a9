// One cloud layer, marched by itself.
#pragma once

#include <algorithm>

#include "bakers/render/cloud_view.h"
#include "bakers/render/scene_march.h"
#include "bakers/render/scene_view.h"
#include "tests/support/loops.h"

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

// The result of the march, which does not depend on the colours of light: one channel for each
// member of RayResults, in their order. Row 0 is at the top.
struct MarchedView {
    static constexpr int kChannels = 6;
    Image2<float> results;
    FetchCounts fetches;
};

inline MarchedView march_view(const CloudMedium& medium, const MarchSettings& settings,
                              int threads) {
    const SceneMarch march({settings.layer(medium)}, settings.sun, settings.sunlit,
                           settings.leaping, threads);
    const MarchedScene marched = march.march(settings.frame(), threads, nullptr);
    MarchedView view = {{settings.width, settings.height, MarchedView::kChannels}, marched.fetches};
    testing::for_each_texel(settings.width, settings.height, [&](int x, int y) {
        const float* seen = marched.results.texel(x, y);
        float* out = view.results.texel(x, y);
        std::copy(seen, seen + 4, out);
        out[4] = seen[MarchedScene::kLayerChannels];
        out[5] = seen[5];
    });
    return view;
}

inline Image2<float> render_cloud(const CloudMedium& medium, const Atmosphere& atmosphere,
                                  const MarchSettings& settings, int threads) {
    SceneRenderer renderer({settings.layer(medium)}, atmosphere, settings.sun, threads);
    return renderer.render(settings.frame(), threads).radiance;
}

}  // namespace skybake
