// The channels of a cloud_light volume of radiance, and the light that they are measured against.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/field/certify.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/facts.h"
#include "bakers/math/intermediates.h"
#include "config/assets/cloud_light.h"

namespace skybake::cloud_light {

// How the cloud of a recipe scatters light, and without its forward peak.
CloudScattering scattering_of(const CloudLayer& layer, const CloudLightBake& bake);
ScaledScattering scaled_scattering_of(const CloudLayer& layer, const CloudLightBake& bake);

// Returns coefficient 0 of the source's own light at a point that no cloud shades: F / (2 sqrt(pi)) of
// light of the fluence F, which is 1 of the sun and 2 pi of the sky and of the ground.
double unshaded_coefficient(const CloudLightBake& bake);

// The voxels of a cloud volume: what they need, and to what they are rounded.
struct SourceOfLayer {
    NeedKey voxels;
    std::array<int, 3> size{};
    PixelType pixel_type{};
};

// Returns the solution that the parts of one set of harmonics share. There is none of the light of a
// clear sky, which each part solves for by itself.
std::optional<Need> solution_need(const SourceOfLayer& of, const CloudLightBake& bake);

// Returns the channels at all places, x fastest: one vector for each channel. Adds how far the solution
// has converged to `details`. The result does not depend on the number of threads; it is incomplete once
// options.progress is cancelled.
std::vector<std::vector<float>> radiance_values(const CloudLayer& layer, const PlaceGrid& places,
                                                const CloudLightBake& bake,
                                                const BakeOptions& options, Facts& details);

// Paths of light from each place. Deep in a thick cloud, where paths have hundreds of collisions and there
// is little light, they are as many as have about kReferenceCollisions together, but no fewer than
// kFewestReferencePaths.
inline constexpr int kReferencePaths = 2048;
inline constexpr int kFewestReferencePaths = 128;
inline constexpr int kReferenceCollisions = 1 << 17;

// A quick certificate waits for paths of so many collisions on average, and no longer.
inline constexpr std::int64_t kMostCollisionsOfPath = 2048;

// Whether paths from places where lookups are compared have more collisions.
bool has_long_paths(const CloudLayer& layer, const CloudLightBake& bake,
                    const VolumeComparison& comparison, int threads);

// Returns the channels at a place from paths of light in all directions: with a the coefficients of all
// light there, sunlight included that was not scattered, and tau the optical depth to the sun,
//
//   J_lm = w' chi'_l (a_lm - E exp(-s tau) Y_lm(-sun))
//
// The scaled cloud and the cloud itself have the same a (cloud_scattering.h), of which the second
// term is the scaled cloud's own sunlight, whose scattering is not J's. Behind the channels are their
// standard errors. `layer` must outlive it.
VolumeReference radiance_reference(const CloudLayer& layer, const CloudLightBake& bake,
                                   int threads);

}  // namespace skybake::cloud_light
