// A table of scattering in memory, the parts from which its texels are made, and the lookup that a
// runtime makes.
//
// Some texels have a nu that no view and sun can have (outside mu mu_s -+ sin sin_s). They still
// count in lookups next to the edge of the possible ones: there they hold the smooth continuation
// of the light in nu, up to kMostBeyond beyond the edge. Texels farther away hold the value at that
// distance.
//
// The sky as a runtime finds it in a stored table of scattering.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/voxel_array.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/assets/bruneton.h"
#include "config/sections/atmosphere.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// The parts of all texels of a size are made once in a run: the table of scattering, that of single
// Mie scattering and that of higher orders use the same ones.
using StoredSpectrum = std::array<float, kMaxChannels>;

// The first-order parts of all texels, u fastest, defined as in ScatteringParts.
struct FirstOrderParts {
    std::vector<StoredSpectrum> air;
    std::vector<StoredSpectrum> mie;
};
using HigherOrderParts = std::vector<StoredSpectrum>;

struct TableParts {
    std::shared_ptr<const FirstOrderParts> first;    // null if not wanted
    std::shared_ptr<const HigherOrderParts> higher;  // null if not wanted

    ScatteringParts at(std::size_t texel) const;  // 0 where not wanted
};

// Makes the parts. If `light` is null there are no higher orders, if `sunlight` is null there is no
// first order (scattering_row.h).
TableParts make_parts(const SkyMedium& medium, const SolvedLight* light,
                      std::shared_ptr<const TransmittanceField> sunlight,
                      const ScatteringContent& content, const ScatteringMapping& mapping,
                      const BakeOptions& options);

// Light of some tables, scattered once or more than once.
struct PartsRequest {
    config::Atmosphere atmosphere;
    std::vector<std::string> mie_layers;
    std::array<int, 3> size{};
    int nu_size = 0;
    double sun_cos_zenith_min = 0;
    int orders = 0;  // the last order: 1 for light scattered once; 0: all
    bool operator==(const PartsRequest&) const = default;
};

PartsRequest parts_request(const config::Atmosphere& atmosphere, const BrunetonBake& bake,
                           int orders);

Need need_of(const PartsRequest& request);

// Returns the same parts as make_parts for a table with this light, shared with other tables. After
// an interruption the parts must not be used.
TableParts shared_parts(const config::Atmosphere& atmosphere, const BrunetonBake& bake,
                        const SkyMedium& medium, const SolvedLight* light,
                        std::shared_ptr<const TransmittanceField> sunlight,
                        const ScatteringContent& content, const ScatteringMapping& mapping,
                        const BakeOptions& options);

// The farthest continuation in nu: one step of nu in a table of 8, beyond which no lookup in that
// table goes. Polynomials of degree 8, by which higher orders are continued, grow by at most half
// over this distance.
inline constexpr double kMostBeyond = 2.0 / 7;

// Returns the cosine to the sun for which a texel is made.
double continued_nu(const ScatteringView& view, const Shell& shell, double sun_cos_zenith,
                    double nu);

// Returns the parts of all texels that share a view ray, in the order of u.
std::vector<ScatteringParts> parts_of_row(const ScatteringRows& rows,
                                          const ScatteringContent& content,
                                          const ScatteringMapping& mapping,
                                          const ScatteringView& view);

// Returns the exact texels of a content's table. Either kind of parts may be absent.
VoxelArray scattering_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                             const TableParts& parts);

// Looks up the first `channels` channels, linearly in each of the four coordinates between texels
// of one half.
Texel look_up(const VoxelArray& table, const ScatteringMapping& mapping,
              const ScatteringCoordinates& x, PixelType type);

// Returns the radiance of the air at the samples, for a solar irradiance of 1. `packets` are the airs
// of the packets of wavelengths, and `places` those of the asset's probes.
LightAtPlaces sky_of_scattering(std::vector<std::shared_ptr<const TracedAir>> packets,
                                const BrunetonBake& asset, AssetPlaces places,
                                const std::vector<SkySample>& samples);

}  // namespace skybake
