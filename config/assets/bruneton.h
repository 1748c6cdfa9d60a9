// This header declares the asset "bruneton": the tables of Bruneton's precomputed scattering.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"

namespace skybake::config {

enum class BrunetonTable { transmittance, scattering, single_mie, higher_orders, irradiance };
enum class BrunetonConvention { bruneton, takram, calcmysky };

// This is one table of the precomputed scattering of Bruneton & Neyret 2008, in the form that
// Bruneton's implementation of 2017 gives it.
struct BrunetonBake : LightFiles {
    BrunetonTable table = BrunetonTable::scattering;
    // These are the texels along u, v and w. The axes of the tables of scattering are nu and the
    // sun's cosine (u), the view's cosine (v) and altitude (w). Those of transmittance are zenith
    // angle, altitude and 1, and those of irradiance the sun's cosine, altitude and 1.
    std::array<int, 3> size{};
    int nu_size = 0;        // for tables of scattering: sub-images along u; it divides size[0]
    bool combined = false;  // for scattering: A holds the first order of Mie layers, red only
    int orders = 0;         // orders of scattering; 0: all
    BrunetonConvention convention = BrunetonConvention::bruneton;
    double sun_cos_zenith_min = 0;         // the least cosine on the sun's axis
    std::vector<std::string> mie_layers;   // layers whose single scattering is kept apart
    std::vector<double> solar_irradiance;  // one per channel; it multiplies all light
};

// Whether a file with the parameters that the table's reader needs is written beside the table.
// Only the table of scattering with convention takram has such a file.
inline bool has_companion(const BrunetonBake& bake) {
    return bake.convention == BrunetonConvention::takram && bake.table == BrunetonTable::scattering;
}

}  // namespace skybake::config

namespace skybake {
using config::BrunetonBake;
using config::BrunetonTable;
}  // namespace skybake
