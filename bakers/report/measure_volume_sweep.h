// Time, error and bytes of each variant of a noise volume.
#pragma once

#include <optional>

#include "bakers/core/volume.h"
#include "bakers/report/measure_sweep.h"
#include "bakers/report/noise_volume_sweep.h"
#include "bakers/report/report.h"

namespace skybake {

struct VolumeRepetitions {
    int voxels = 1;  // times are medians of so many
    int writes = 1;
};

// The rows of a sweep, fronts marked, and notes on variants that were left out. `baked` is the
// volume that the sweep is about: the files have its metadata, and errors are shares of the value
// ranges of its channels, whatever those of a variant are. `points` voxels, at most, and as many
// lookups are compared with the definition of `noise`. None: the user has interrupted.
std::optional<MeasuredSweep> measure_volume_sweep(const VolumeSweep& sweep,
                                                  const BakedVolume& baked,
                                                  const config::Noise& noise, int points,
                                                  const VolumeRepetitions& repetitions,
                                                  const ReportOptions& options);

}  // namespace skybake
