// The parts of all texels of a size, made once in a run: the table of scattering, that of single
// Mie scattering and that of higher orders ask for the same ones.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/air/sky_medium.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

using StoredSpectrum = std::array<float, kMaxChannels>;

// Of texels, u fastest; as ScatteringParts has them.
struct FirstOrderParts {
    std::vector<StoredSpectrum> air;
    std::vector<StoredSpectrum> mie;
};
using HigherOrderParts = std::vector<StoredSpectrum>;

struct TableParts {
    std::shared_ptr<const FirstOrderParts> first;    // null: not wanted
    std::shared_ptr<const HigherOrderParts> higher;  // the same
};

// Makes them anew. Without `light` there are no higher orders.
TableParts make_parts(const SkyMedium& medium, const SolvedLight* light, bool wants_first,
                      const ScatteringContent& content, const ScatteringMapping& mapping,
                      const BakeOptions& options);

// The same, or those of before. The last ones made are kept: 36 bytes a texel. After
// an interruption they are not to be used, and are not kept.
TableParts remembered_parts(const SkyMedium& medium,
                            const std::shared_ptr<const SolvedLight>& light,
                            const ScatteringContent& content, const ScatteringMapping& mapping,
                            bool wants_first, bool wants_higher, const BakeOptions& options);

}  // namespace skybake
