#include "bakers/assets/bruneton/scattering_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/assets/bruneton/axis_taps.h"
#include "bakers/field/pixel_type.h"

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
    const ScatteringRow row = rows.row(view, SunFan(suns, nu));
    std::vector<ScatteringParts> parts(width);
    for (std::size_t u = 0; u < width; ++u) parts[u] = content.parts(row, u, nu[u]);
    return parts;
}

HeldVoxels scattering_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                             const TableParts& parts) {
    HeldVoxels table(mapping.size(), content.channels());
    for (std::size_t i = 0; i < table.channel(0).size(); ++i) {
        ScatteringParts at;
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            if (parts.first) at.air[c] = parts.first->air[i][c];
            if (parts.first) at.mie[c] = parts.first->mie[i][c];
            if (parts.higher) at.higher[c] = (*parts.higher)[i][c];
        }
        const Texel texel = content.texel(at);
        for (std::size_t c = 0; c < content.channels(); ++c) {
            table.channel(c)[i] = static_cast<float>(texel[c]);
        }
    }
    return table;
}

Texel look_up(const HeldVoxels& table, const ScatteringMapping& mapping,
              const ScatteringCoordinates& x, config::PixelType type) {
    Texel sum{};
    for_each_tap(mapping, x, [&](int u, int v, int w, double weight) {
        const std::size_t at = table.offset(u, v, w);
        for (std::size_t i = 0; i < table.channels(); ++i) {
            sum[i] += weight * double{round_to_pixel_type(table.channel(i)[at], type)};
        }
    });
    return sum;
}

}  // namespace skybake
