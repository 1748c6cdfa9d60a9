#include "bakers/assets/bruneton/scattering_table.h"

#include <algorithm>
#include <utility>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/assets/description/estimate.h"
#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "config/sections/layer.h"

namespace skybake {

double continued_nu(const ScatteringView& view, const Shell& shell, double sun_cos_zenith,
                    double nu) {
    const double mu =
        std::clamp(view.s_km / (shell.ground_radius_km + view.altitude_km), -1.0, 1.0);
    const FeasibleCosines feasible = feasible_cosines(mu, sun_cos_zenith);
    return std::clamp(nu, std::max(feasible.low - kMostBeyond, -1.0),
                      std::min(feasible.high + kMostBeyond, 1.0));
}

std::vector<ScatteringParts> parts_of_row(const ScatteringRows& rows,
                                          const ScatteringContent& content,
                                          const ScatteringMapping& mapping,
                                          const ScatteringView& view) {
    const auto width = static_cast<std::size_t>(mapping.size()[0]);
    std::vector<double> suns(width);
    std::vector<double> nu(width);
    for (std::size_t u = 0; u < width; ++u) {
        suns[u] = mapping.sun_of_texel(static_cast<int>(u));
        nu[u] =
            continued_nu(view, mapping.shell(), suns[u], mapping.nu_of_texel(static_cast<int>(u)));
    }
    const ScatteringRow row = rows.row(view, SunBundle(suns, nu));
    std::vector<ScatteringParts> parts(width);
    for (std::size_t u = 0; u < width; ++u) parts[u] = content.parts(row, u, nu[u]);
    return parts;
}

ScatteringParts TableParts::at(std::size_t texel) const {
    ScatteringParts parts;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        if (first) parts.air[c] = first->air[texel][c];
        if (first) parts.mie[c] = first->mie[texel][c];
        if (higher) parts.higher[c] = (*higher)[texel][c];
    }
    return parts;
}

VoxelArray scattering_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                             const TableParts& parts) {
    VoxelArray table(mapping.size(), content.channels());
    for (std::size_t i = 0; i < table.channel(0).size(); ++i) {
        const Texel texel = content.texel(parts.at(i));
        for (std::size_t c = 0; c < content.channels(); ++c) {
            table.channel(c)[i] = static_cast<float>(texel[c]);
        }
    }
    return table;
}

Texel look_up(const VoxelArray& table, const ScatteringMapping& mapping,
              const ScatteringCoordinates& x, PixelType type) {
    Texel sum{};
    for_each_tap(mapping, x, [&](int u, int v, int w, double weight) {
        const std::size_t at = table.offset(u, v, w);
        for (std::size_t i = 0; i < table.channels(); ++i) {
            sum[i] += weight * double{round_to_pixel_type(table.channel(i)[at], type)};
        }
    });
    return sum;
}

namespace {

StoredSpectrum stored(const Spectrum& value) {
    return {static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z),
            static_cast<float>(value.w)};
}

}  // namespace

TableParts make_parts(const SkyMedium& medium, const SolvedLight* light,
                      std::shared_ptr<const TransmittanceField> sunlight,
                      const ScatteringContent& content, const ScatteringMapping& mapping,
                      const BakeOptions& options) {
    const std::array<int, 3>& size = mapping.size();
    const auto width = static_cast<std::size_t>(size[0]);
    const std::size_t texels =
        width * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    const bool wants_first = sunlight != nullptr;
    auto first = std::make_shared<FirstOrderParts>();
    auto higher = std::make_shared<HigherOrderParts>();
    if (wants_first) {
        first->air.resize(texels);
        first->mie.resize(texels);
    }
    if (light != nullptr) higher->resize(texels);
    const ScatteringRows rows(medium, light, std::move(sunlight));
    for_each_tile(size[1] * size[2], options, "scattering", [&](int tile) {
        const std::vector<ScatteringParts> parts = parts_of_row(
            rows, content, mapping, mapping.view_of_texel(tile % size[1], tile / size[1]));
        const std::size_t from = static_cast<std::size_t>(tile) * width;
        for (std::size_t u = 0; u < width; ++u) {
            if (wants_first) {
                first->air[from + u] = stored(parts[u].air);
                first->mie[from + u] = stored(parts[u].mie);
            }
            if (light != nullptr) (*higher)[from + u] = stored(parts[u].higher);
        }
    });
    TableParts result;
    if (wants_first) result.first = std::move(first);
    if (light != nullptr) result.higher = std::move(higher);
    return result;
}

PartsRequest parts_request(const config::Atmosphere& atmosphere, const BrunetonBake& bake,
                           int orders) {
    return {.atmosphere = atmosphere,
            .mie_layers = bake.mie_layers,
            .size = bake.size,
            .nu_size = bake.nu_size,
            .sun_cos_zenith_min = bake.sun_cos_zenith_min,
            .orders = orders};
}

Need need_of(const PartsRequest& request) {
    constexpr double kSecondsPerTexel = 2e-6;
    const double texels = voxels_of(request.size, 1);
    const double bytes = texels * static_cast<double>(sizeof(StoredSpectrum));
    const bool is_first = request.orders == 1;
    return {NeedKey(request), is_first ? "light scattered once" : "light scattered more than once",
            texels * kSecondsPerTexel, (is_first ? 2 : 1) * bytes / kMebibyte};
}

TableParts shared_parts(const config::Atmosphere& atmosphere, const BrunetonBake& bake,
                        const SkyMedium& medium, const SolvedLight* light,
                        std::shared_ptr<const TransmittanceField> sunlight,
                        const ScatteringContent& content, const ScatteringMapping& mapping,
                        const BakeOptions& options) {
    TableParts parts;
    if (sunlight) {
        parts.first = shared_or_made<FirstOrderParts>(
            options.intermediates, NeedKey(parts_request(atmosphere, bake, 1)), [&] {
                TableParts made = make_parts(medium, nullptr, sunlight, content, mapping, options);
                return options.cancelled() ? nullptr : std::move(made.first);
            });
    }
    if (light != nullptr) {
        parts.higher = shared_or_made<HigherOrderParts>(
            options.intermediates, NeedKey(parts_request(atmosphere, bake, bake.orders)), [&] {
                TableParts made = make_parts(medium, light, nullptr, content, mapping, options);
                return options.cancelled() ? nullptr : std::move(made.higher);
            });
    }
    return parts;
}

LightAtPlaces sky_of_scattering(std::vector<std::shared_ptr<const TracedAir>> packets,
                                const BrunetonBake& asset, AssetPlaces places,
                                const std::vector<SkySample>& samples) {
    std::vector<Place> at;
    std::vector<double> cosines;
    for (const SkySample& sample : samples) {
        cosines.push_back(std::clamp(sample.direction.cosine_to_sun, -1.0, 1.0));
        at.push_back({{"altitude_km", sample.altitude_km},
                      {"cos_zenith", sample.direction.mu},
                      {"sun_cos_zenith", sample.sun.cosine},
                      {"nu", cosines.back()},
                      {"ground", sample.above_horizon_deg < 0 ? 1 : 0}});
    }
    return [=, packets = std::move(packets), places = std::move(places), at = std::move(at),
            cosines = std::move(cosines)](const Baked& baked, int) {
        std::vector<ScatteringContent> of_packets;
        for (const auto& air : packets) of_packets.emplace_back(air->medium(), asset);
        std::vector<const ScatteringContent*> contents;
        for (const ScatteringContent& packet : of_packets) contents.push_back(&packet);
        const TableContent content(std::move(contents), weights_of(baked.conventions),
                                   asset.solar_irradiance);
        std::vector<Spectrum> light;
        for (const auto& channels : look_up_places(baked, places, at)) {
            Texel texel{};
            std::ranges::copy(channels, texel.begin());
            light.push_back(content.radiance(texel, cosines[light.size()]));
        }
        return light;
    };
}

}  // namespace skybake
