#include "bakers/preview/pictures/asset_pictures.h"

#include <string_view>

#include "bakers/preview/pictures/bruneton_pictures.h"
#include "bakers/preview/pictures/noise_pictures.h"
#include "bakers/preview/pictures/phase_pictures.h"
#include "bakers/preview/pictures/sky_asset_pictures.h"
#include "bakers/preview/pictures/table_pictures.h"

namespace skybake {
namespace {

// The pictures of assets that have some of their own. Clouds have theirs with what lights them.
struct AssetPictures {
    std::string_view kind;
    std::vector<PreviewPicture> (*pictures)(const PreviewAsset& asset);
};

constexpr AssetPictures kPictures[] = {
    {"transmittance", table_pictures},   {"multiple_scattering", table_pictures},
    {"sky_view", sky_view_pictures},     {"environment", environment_pictures},
    {"irradiance", irradiance_pictures}, {"aerial_perspective", aerial_pictures},
    {"phase", phase_pictures},           {"bruneton", bruneton_pictures},
};

}  // namespace

std::vector<PreviewPicture> asset_pictures(const PreviewAsset& asset) {
    for (const AssetPictures& row : kPictures) {
        if (row.kind == asset.entry.kind) return row.pictures(asset);
    }
    if (asset.entry.is_volume()) return noise_pictures(asset);
    return {};
}

}  // namespace skybake
