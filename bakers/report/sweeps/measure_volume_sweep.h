// Time, error and bytes of each variant of a volume.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/report/report.h"
#include "bakers/report/sweeps/table_sweeps.h"
#include "bakers/report/sweeps/volume_sweep.h"

namespace skybake {

struct VolumeRepetitions {
    int voxels = 1;  // times are medians of so many
    int writes = 1;
};

// The reference of a volume of some size.
using ReferenceOfSize = std::function<VolumeReference(const std::array<int, 3>& size)>;

// How its errors are measured; empty: in shares of value ranges.
using ComparisonOfSize = std::function<VolumeComparison(const std::array<int, 3>& size)>;

// A definition at places that many variants are compared at: computed once. Any thread may ask.
class RememberedReference {
  public:
    explicit RememberedReference(VolumeReference definition);
    std::vector<double> operator()(const std::array<double, 3>& place);

  private:
    VolumeReference definition_;
    std::mutex mutex_;
    std::map<std::array<double, 3>, std::vector<double>> values_;
};

// The rows of a sweep, fronts marked, and notes on variants that were left out. `baked` is the
// volume that the sweep is about: the files have its metadata, and errors are shares of the value
// ranges of its channels, whatever those of a variant are. `points` voxels, at most, and as many
// lookups are compared with the reference. None: the user has interrupted.
std::optional<MeasuredSweep> measure_volume_sweep(const VolumeSweep& sweep, const Baked& baked,
                                                  const ReferenceOfSize& reference, int points,
                                                  const VolumeRepetitions& repetitions,
                                                  const ReportOptions& options,
                                                  const ComparisonOfSize& comparison = {});

}  // namespace skybake
