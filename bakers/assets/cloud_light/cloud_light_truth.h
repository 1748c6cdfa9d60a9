// The light that lookups of a cloud_light volume are measured against.
//
// `max_error` in place of `cell`: the fewest texels of which lookups are near enough to the truth.
#pragma once

#include <string>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/field/certify.h"
#include "bakers/math/bake_options.h"
#include "config/assets/cloud_light.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Points are as dense as the cloud is, those of a map anywhere. Errors are shares of the light that nothing
// shades, of which a depth leaves exp(-depth); those of harmonics of depths are shares of each channel's
// range. `layer` outlives it.
struct CloudLightTruth {
    VolumeReference reference;
    VolumeComparison comparison;
    std::string name;
};
CloudLightTruth cloud_light_truth(const cloud_light::CloudLayer& layer, const CloudLightBake& bake,
                                  int threads);

// Returns the largest cell, from 64 down but leaving two texels along each axis, of which the RMS
// error of lookups is at most *bake.max_error. The error is that of the certificate
// (cloud_light_truth), over all channels, of the stored texels. It is measured at the points of the
// quick certificate, and where those are few, at more of them too; so the choice does not depend on how
// the asset is certified.
//
// E0403 if no cell is near enough, with the best and its error; E0401 and E0402 as for volumes. After
// an interruption there is neither a value nor a diagnostic.
Outcome<int> largest_cell(const cloud_light::CloudLayer& layer, const CloudLightBake& bake,
                          const std::string& name, const BakeOptions& options);

}  // namespace skybake
