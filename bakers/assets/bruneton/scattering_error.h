// The error of a table of scattering, measured: its texels, and the lookups that a runtime makes.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/field/baked.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/bake_options.h"

namespace skybake {

// What tables of scattering are measured against: each value by direct integration along its view
// ray (sky_radiance.h), each group of layers on its own.
class ScatteringReference {
  public:
    // All must outlive it; without `higher` there are no higher orders.
    ScatteringReference(const SkyMedium& medium, const ScatteringContent& content,
                        const HigherOrders* higher);

    // Of directions that there are.
    ScatteringParts parts(const ScatteringView& view, double sun_cos_zenith, double nu) const;

  private:
    const ScatteringContent& content_;
    SkyMedium air_;  // the medium, where no Mie layer scatters
    SkyMedium mie_;  // where none but they do
    SkyIntegrator all_;
    SkyIntegrator air_alone_;
    SkyIntegrator mie_alone_;
};

// The channels of a texel as they are exactly, of directions that there are.
using ExactTexel =
    std::function<Texel(const ScatteringView& view, double sun_cos_zenith, double nu)>;

// Both must outlive it.
ExactTexel exact_texel(const ScatteringContent& content, const ScatteringReference& reference);

// Of each channel of a table: what its errors are shares of where there is next to no light.
std::vector<double> largest_values(const DenseVolume& table);

// How many points a certificate takes.
int scattering_points(Certification certification);

// At points spread evenly over x_mu_s, x_mu of both halves and x_r, and over the nu that there are.
// Texels are those next to the points whose own nu there is.
Certificate measure_scattering(const DenseVolume& table, const ScatteringMapping& mapping,
                               const ExactTexel& exact, const std::vector<double>& largest,
                               config::PixelType type, int points, const BakeOptions& options);

}  // namespace skybake
