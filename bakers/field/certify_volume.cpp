#include "bakers/field/certify_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/field/error_statistics.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/trilinear.h"
#include "bakers/math/low_discrepancy.h"
#include "bakers/math/tiles.h"

namespace skybake {

namespace {

using Coordinates = std::array<double, 3>;

std::vector<double> look_up(const StoredVoxels& voxels, const Level& level,
                            const Coordinates& uvw) {
    const std::array<VoxelTap, 8> taps = trilinear_taps(level.size, uvw, level.repeats);
    const std::vector<float> values = voxels.at(taps);
    std::vector<double> result(voxels.channels(), 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t c = 0; c < result.size(); ++c) {
            result[c] += taps[i].weight * double{values[i * result.size() + c]};
        }
    }
    return result;
}

std::vector<double> shares_of_range(const Level& level, const std::vector<double>& found,
                                    const std::vector<double>& wanted) {
    std::vector<double> errors;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const double range = level.statistics[c].max - level.statistics[c].min;
        // A channel that has one value everywhere is compared as it is.
        errors.push_back((found[c] - wanted[c]) / (range > 0 ? range : 1));
    }
    return errors;
}

// Compares lookups with the reference at places, in tiles.
VolumeErrors measure(const Level& level, config::PixelType type, const VolumeReference& reference,
                     const std::vector<Coordinates>& places, const VolumeComparison& comparison,
                     const BakeOptions& options) {
    const StoredVoxels voxels(level, type);
    std::vector<std::vector<double>> errors(places.size());
    constexpr int kTile = 32;
    const auto count = static_cast<int>(places.size());
    for_each_tile((count + kTile - 1) / kTile, options, "certify", [&](int tile) {
        for (int i = tile * kTile; i < std::min(count, (tile + 1) * kTile); ++i) {
            if (options.cancelled()) return;
            const auto at = static_cast<std::size_t>(i);
            const std::vector<double> found = look_up(voxels, level, places[at]);
            const std::vector<double> wanted = reference(places[at]);
            errors[at] = comparison.errors ? comparison.errors(places[at], found, wanted)
                                           : shares_of_range(level, found, wanted);
        }
    });
    VolumeErrors result;
    result.points = count;
    ErrorStatistics statistics;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        for (const double error : errors[i]) {
            if (std::fabs(error) > statistics.max()) result.worst = places[i];
            statistics.add(error);
        }
    }
    result.figures = statistics.figures();
    return result;
}

}  // namespace

std::vector<double> look_up(const Level& level, config::PixelType type,
                            const std::array<double, 3>& uvw) {
    return look_up(StoredVoxels(level, type), level, uvw);
}

VolumeErrors measure_lookups(const Level& level, config::PixelType type,
                             const VolumeReference& reference, int count,
                             const BakeOptions& options, const VolumeComparison& comparison) {
    std::vector<Coordinates> places;
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Along an axis of one voxel there is nothing to look up between.
            if (level.size[axis] == 1) place[axis] = 0.5;
        }
        places.push_back(comparison.lookup_place ? comparison.lookup_place(place) : place);
    }
    return measure(level, type, reference, places, comparison, options);
}

VolumeErrors measure_voxels(const Level& level, config::PixelType type,
                            const VolumeReference& reference, int count, const BakeOptions& options,
                            const VolumeComparison& comparison) {
    std::vector<Coordinates> places;
    for (int i = 0; i < count; ++i) {
        Coordinates place = low_discrepancy_point(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] = (std::floor(place[axis] * level.size[axis]) + 0.5) / level.size[axis];
        }
        places.push_back(place);
    }
    return measure(level, type, reference, places, comparison, options);
}

}  // namespace skybake
