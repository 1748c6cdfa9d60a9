// A table of scattering in memory, and the lookup that a runtime makes of it.
//
// Texels whose nu no view and sun have (nu outside mu mu_s -+ sin sin_s) still count in lookups
// next to the edge of those that have one: there they hold the smooth continuation of the light in
// nu, up to kMostBeyond past the edge; texels farther away hold what is there.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/field/baked.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// Voxels that stand in memory.
class DenseVolume : public VoxelSource {
  public:
    DenseVolume(const std::array<int, 3>& size, std::size_t channels);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const std::array<int, 3>& size() const { return size_; }
    std::size_t channels() const { return values_.size(); }
    std::size_t offset(int x, int y, int z) const;
    std::vector<float>& channel(std::size_t c) { return values_[c]; }
    const std::vector<float>& channel(std::size_t c) const { return values_[c]; }
    double largest(std::size_t channel) const;

  private:
    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

// The parts of all texels of a size, made once in a run: the table of scattering, that of single
// Mie scattering and that of higher orders ask for the same ones.

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

// One step of nu in a table of 8: no lookup in it goes farther. Polynomials of the 8th degree, as
// which higher orders are continued, grow by no more than half over it.
inline constexpr double kMostBeyond = 2.0 / 7;

// The cosine to the sun that a texel is made for.
double continued_nu(const ScatteringView& view, const Shell& shell, double sun_cos_zenith,
                    double nu);

// All texels' parts of a view ray, in the order of u.
std::vector<ScatteringParts> parts_of_row(const ScatteringRows& rows,
                                          const ScatteringContent& content,
                                          const ScatteringMapping& mapping,
                                          const ScatteringView& view);

// The texels of a content's table, as they are exactly. Of either kind of parts there may be none.
DenseVolume scattering_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                              const TableParts& parts);

// Linear in each of the four coordinates between texels of one half. `channels` of them.
Texel look_up(const DenseVolume& table, const ScatteringMapping& mapping,
              const ScatteringCoordinates& x, config::PixelType type);

// Light of a grid as a table of scattering holds it.

// Light of all texels, u fastest, in 1/sr, over Rayleigh's phase function at their nu: where there
// is none such, at the nearest that there is, as of iterated_scattering.
HigherOrderParts over_rayleigh(const std::vector<Spectrum>& light,
                               const ScatteringMapping& mapping);

}  // namespace skybake
