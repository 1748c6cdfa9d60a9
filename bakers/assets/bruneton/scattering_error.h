// Measures the error of a table of scattering, both of its texels and of the lookups that a runtime
// makes.
#pragma once

#include <functional>
#include <vector>

#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_row.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/field/conventions.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/bake_options.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// The reference for tables of scattering: each value by direct integration along its view ray
// (sky_radiance.h), each group of layers separately.
class ScatteringReference {
  public:
    // The arguments must outlive this object. If `higher` is null, there are no higher orders.
    ScatteringReference(const SkyMedium& medium, const ScatteringContent& content,
                        const HigherOrders* higher);

    // Returns the parts, for a nu that directions can have.
    ScatteringParts parts(const ScatteringView& view, double sun_cos_zenith, double nu) const;

  private:
    const ScatteringContent& content_;
    SkyMedium air_;  // the medium, in which no Mie layer scatters
    SkyMedium mie_;  // the medium, in which only Mie layers scatter
    SkyIntegrator all_;
    SkyIntegrator air_alone_;
    SkyIntegrator mie_alone_;
};

// Returns the exact channels of a texel, for a nu that directions can have.
using ExactTexel =
    std::function<Texel(const ScatteringView& view, double sun_cos_zenith, double nu)>;

// Makes that function, of the references of all packets. They and `content` must outlive it.
ExactTexel exact_texel(const TableContent& content,
                       std::vector<const ScatteringReference*> references);

// Returns the largest value of each channel of a table. Where there is hardly any light, errors are
// relative to a share of it.
std::vector<double> largest_values(const VoxelArray& table);

// Returns the number of points of a certificate.
int scattering_points(Certification certification);

// Returns exact channels too, from a row of suns that share the work along their view ray:
// values[i] for each sun_cos_zenith[i] and nu[i]. It approximates what ExactTexel returns.
using TexelRow = std::function<std::vector<Texel>(
    const ScatteringView& view, const std::vector<double>& suns, const std::vector<double>& nu)>;

// Makes that function of the rows, one per packet, that texels are made of. They and `content` must
// outlive it.
TexelRow texel_row(const TableContent& content, std::vector<const ScatteringRows*> rows);

// Searches the errors of lookups (error_search.h) over the same measure as measure_scattering, in
// place of its lookups. `row` is the estimate that is searched.
void search_scattering(const VoxelArray& table, const ScatteringMapping& mapping,
                       const ExactTexel& exact, const TexelRow& row,
                       const std::vector<double>& largest, PixelType type,
                       const BakeOptions& options, Certificate& certificate);

// Measures at points spread evenly over x_mu_s, x_mu of both halves and x_r, and over the nu that
// directions can have. The texels that are measured are those next to the points whose own nu is
// possible.
Certificate measure_scattering(const VoxelArray& table, const ScatteringMapping& mapping,
                               const ExactTexel& exact, const std::vector<double>& largest,
                               PixelType type, int points, const BakeOptions& options);

}  // namespace skybake
