#include "bakers/plan/found_cloud.h"

#include "bakers/math/parallel.h"

namespace skybake {

const cloud_light::CloudLayer& CloudOfWay::layer_of(const BakedAsset& asset) {
    const auto known = layers_.find(&asset);
    if (known != layers_.end()) return known->second;
    BakeOptions quiet = options_;
    quiet.progress = nullptr;
    return layers_.emplace(&asset, cloud_light::make_layer(asset.baked, 0, cloud_, quiet))
        .first->second;
}

const StoredTexture& CloudOfWay::texture_of(const BakedAsset& asset) {
    return textures_.try_emplace(&asset, asset.baked).first->second;
}

CloudTextures CloudOfWay::textures(const CloudWay& way,
                                   const std::vector<const BakedAsset*>& assets, std::size_t sun) {
    CloudTextures textures;
    textures.layer = &layer_of(*assets[0]);
    if (way.lighting == CloudLighting::march) return textures;
    std::size_t next = way.first;
    std::size_t end = assets.size();
    if (way.lighting == CloudLighting::radiance)
        textures.small_angles = &texture_of(*assets[next++]);
    if (way.lighting != CloudLighting::harmonics) {
        next += sun * way.per_sun;
        end = next + way.per_sun;
        textures.depth = &texture_of(*assets[next++]);
    }
    while (next < end) textures.parts.push_back(&texture_of(*assets[next++]));
    return textures;
}

const std::vector<MarchedRay>& CloudOfWay::marched(const CloudWay& way,
                                                   const std::vector<const BakedAsset*>& assets) {
    const auto [known, is_new] = marched_.try_emplace(way.drawing);
    if (!is_new) return known->second;
    std::vector<CloudTextures> of_suns;
    const std::vector<CloudView>& views = truth_.views();
    for (const CloudView& view : views) {
        while (of_suns.size() <= view.sun) {
            of_suns.push_back(textures(way, assets, way.per_sun > 0 ? of_suns.size() : 0));
        }
    }
    std::vector<MarchedRay>& rays = known->second;
    rays.resize(views.size());
    parallel_for(static_cast<int>(views.size()), options_.threads, [&](int i) {
        const CloudView& view = views[static_cast<std::size_t>(i)];
        rays[static_cast<std::size_t>(i)] =
            march_cloud(way, of_suns[view.sun], view.place, view.look, truth_.sun(view));
    });
    return rays;
}

FoundCloud CloudOfWay::find(const CloudWay& way, const std::vector<const BakedAsset*>& assets) {
    const std::vector<MarchedRay>& rays = marched(way, assets);
    const cloud_light::CloudLayer& layer = layer_of(*assets[0]);
    const CloudFetches fetches(layer, stride_m(way, layer),
                               way.cell > 0 ? &assets[1]->baked : nullptr, way.cell);
    FoundCloud found;
    found.radiance.resize(rays.size());
    std::vector<double> of_views(rays.size());
    parallel_for(static_cast<int>(rays.size()), options_.threads, [&](int n) {
        const auto i = static_cast<std::size_t>(n);
        const CloudView& view = truth_.views()[i];
        found.radiance[i] = rays[i].radiance;
        of_views[i] =
            rays[i].light_fetches + fetches.along(view.place, view.look, rays[i].length_m);
    });
    for (const double one : of_views) found.fetches += one / static_cast<double>(rays.size());
    return found;
}

}  // namespace skybake
