// Measures the time, error and bytes of each variant of a volume.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/report/report.h"
#include "bakers/report/sweeps/table_sweeps.h"
#include "bakers/report/sweeps/volume_sweep.h"

namespace skybake {

struct Baked;

struct VolumeRepetitions {
    int voxels = 1;  // each time is the median of this many
    int writes = 1;
};

// Returns the reference for a volume of the given size.
using ReferenceOfSize = std::function<VolumeReference(const std::array<int, 3>& size)>;

// Returns how the errors of such a volume are measured. Empty: as shares of the channels' value
// ranges.
using ComparisonOfSize = std::function<VolumeComparison(const std::array<int, 3>& size)>;

// A memo of a reference, for places at which many variants are compared: each value is calculated
// once. Any thread may call it.
class RememberedReference {
  public:
    explicit RememberedReference(VolumeReference definition);
    std::vector<double> operator()(const std::array<double, 3>& place);

  private:
    VolumeReference definition_;
    std::mutex mutex_;
    std::map<std::array<double, 3>, std::vector<double>> values_;
};

// Measures a sweep and returns its rows, with marked fronts, and notes on variants that were left
// out. `baked` is the volume that the sweep is about: all files have its metadata, and all errors
// are shares of the value ranges of its channels, even if a variant has others. At most `points`
// voxels and as many lookups are compared with the reference. Returns nothing if the user has
// interrupted.
std::optional<MeasuredSweep> measure_volume_sweep(const VolumeSweep& sweep, const Baked& baked,
                                                  const ReferenceOfSize& reference, int points,
                                                  const VolumeRepetitions& repetitions,
                                                  const ReportOptions& options,
                                                  const ComparisonOfSize& comparison = {});

}  // namespace skybake
