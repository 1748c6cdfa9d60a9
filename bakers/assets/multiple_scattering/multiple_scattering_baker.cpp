// The baker of asset = "multiple_scattering".
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "bakers/air/medium.h"
#include "bakers/assets/baker.h"
#include "bakers/assets/draft_size.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::MultipleScatteringBake;

bool is_solved(const MultipleScatteringBake& asset) {
    return asset.method == config::MultipleScatteringMethod::solved;
}

// Tables below each other.
int tables_of(const MultipleScatteringBake& asset) {
    const bool moments = asset.content == config::MultipleScatteringContent::moments;
    return is_solved(asset) && moments ? moment_count(asset.degree) : 1;
}

Outcome<Baked> bake(const Parameters& parameters, const MultipleScatteringBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    Baked table = labelled_table(parameters, std::move(label));
    if (is_solved(asset)) {
        return bake_solved_scattering(parameters.atmosphere, parameters.scene, asset, options,
                                      std::move(table));
    }
    return bake_multiple_scattering(make_medium(parameters.atmosphere), asset, options,
                                    std::move(table));
}

Estimate estimate(const Parameters&, const MultipleScatteringBake& asset) {
    if (!is_solved(asset)) return estimate_table(asset, 1e-4, 0.1);
    const std::array<int, 2> size =
        asset.max_error ? std::array<int, 2>{}
                        : std::array<int, 2>{asset.size[0], asset.size[1] * tables_of(asset)};
    return estimate_texels(asset, size, 1e-6, 2 * kSecondsToSolve);
}

// Moments are in the table of the probe's l and m.
AssetPlaces places(const Parameters& parameters, const MultipleScatteringBake& asset,
                   const StoredTexels& stored) {
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const Shell shell = shell_of(parameters.atmosphere);
    const SunColumns columns =
        sun_columns(asset.mapping, is_solved(asset) ? parameters.scene : std::nullopt, shell);
    const int tables = tables_of(asset);
    std::vector<std::string> names = {"altitude_km", "sun_cos_zenith"};
    if (tables > 1) names.insert(names.end(), {"l", "m"});
    return single_lookup(std::move(names), [=](const Place& at) {
        const int part = tables == 1 ? 0
                                     : moment_index(static_cast<int>(at[2].second),
                                                    static_cast<int>(at[3].second));
        const double v = texture_coordinate(kConvention, at[0].second / shell.thickness_km,
                                            stored.size[1] / tables);
        const double x = columns.coordinate(at[1].second);
        return Uvw{texture_coordinate(kConvention, x, stored.size[0]), (part + v) / tables, 0.5};
    });
}

void draft(MultipleScatteringBake& asset, int) {
    reduce_table(asset, {32, 32});
    asset.max_texel_error = std::max(asset.max_texel_error, 0.02);
}

}  // namespace

const Baker<config::MultipleScatteringBake>& baker(BakerTag<config::MultipleScatteringBake>) {
    static const Baker<config::MultipleScatteringBake> row = {
        .version = 2, .bake = bake, .estimate = estimate, .places = places, .draft = draft};
    return row;
}

}  // namespace skybake
