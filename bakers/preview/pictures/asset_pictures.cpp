#include "bakers/preview/pictures/asset_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bakers/render/tone_curve.h"

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

// Without an exponent of ten.
std::string exposure_text(double exposure) {
    const std::string factor =
        exposure < 100 ? fmt::format("{:.3g}", exposure) : fmt::format("{:.0f}", exposure);
    return fmt::format("exposure {} ({:+.1f} stops)", factor, std::log2(exposure));
}

std::string tone_text(double exposure) {
    return fmt::format("{}, tone curve {}", exposure_text(exposure), tone_curve_name());
}

std::string sun_text(double elevation_degrees) {
    if (elevation_degrees == 0) return "sun on the horizon";
    const double size = std::fabs(elevation_degrees);
    return fmt::format("sun {:.4g} degree{} {} the horizon", size, size == 1 ? "" : "s",
                       elevation_degrees < 0 ? "below" : "above");
}

std::string sun_stem(double elevation_degrees) {
    std::string stem = fmt::format("sun_{}{:g}", elevation_degrees < 0 ? "minus_" : "",
                                   std::fabs(elevation_degrees));
    std::replace(stem.begin(), stem.end(), '.', '_');
    return stem;
}

}  // namespace skybake
