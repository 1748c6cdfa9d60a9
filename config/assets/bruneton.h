// asset = "bruneton". The tables of Bruneton's precomputed scattering.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset.h"
#include "config/sections/files.h"

namespace skybake::config {

enum class BrunetonTable { transmittance, scattering, single_mie, higher_orders, irradiance };
enum class BrunetonConvention { bruneton, takram };
enum class BrunetonMethod { solved, iterated };

// One table of the precomputed scattering of Bruneton & Neyret 2008, as their implementation of
// 2017 has it.
struct BrunetonBake : AssetFiles {
    BrunetonTable table = BrunetonTable::scattering;
    // Texels along u, v, w. Tables of scattering: nu and the sun's cosine, the view's cosine,
    // altitude; transmittance: zenith angle, altitude, 1; irradiance: the sun's cosine,
    // altitude, 1.
    std::array<int, 3> size{};
    int nu_size = 0;       // tables of scattering: sub-images along u, which divide size[0]
    bool combined = true;  // scattering: the first order of Mie layers in A, red alone
    int orders = 0;        // of scattering; 0: all
    BrunetonMethod method = BrunetonMethod::solved;
    BrunetonConvention convention = BrunetonConvention::bruneton;
    double sun_cos_zenith_min = 0;         // where the axis of the sun begins
    std::vector<std::string> mie_layers;   // whose single scattering is kept apart
    std::vector<double> solar_irradiance;  // one per channel, multiplies all light
};

// Whether files of a table have their reader's parameters beside them: the table of scattering of
// convention takram.
inline bool has_companion(const BrunetonBake& bake) {
    return bake.convention == BrunetonConvention::takram && bake.table == BrunetonTable::scattering;
}

const AssetKind& asset_kind(Tag<BrunetonBake>);

}  // namespace skybake::config
