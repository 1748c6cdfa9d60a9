#include "bakers/core/certify_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/core/error_statistics.h"
#include "bakers/core/low_discrepancy.h"
#include "bakers/core/pixel_type.h"
#include "bakers/core/tiles.h"
#include "bakers/core/trilinear.h"

namespace skybake {

namespace {

using Coordinates = std::array<double, 3>;

// A level's voxels as a file holds them.
class StoredVoxels {
  public:
    StoredVoxels(const VolumeLevel& level, config::PixelType type) : level_(level), type_(type) {}

    std::size_t channels() const { return level_.statistics.size(); }

    // Values of the eight voxels of a lookup, [tap][channel].
    std::vector<float> at(const std::array<VoxelTap, 8>& taps) const {
        const std::array<int, 3>& first = taps[0].voxel;
        const std::array<int, 3>& last = taps[7].voxel;
        std::vector<float> values(8 * channels());
        if (last == std::array<int, 3>{first[0] + 1, first[1] + 1, first[2] + 1}) {
            fetch({first, {2, 2, 2}}, 0, values);
        } else {
            for (std::size_t i = 0; i < 8; ++i) fetch({taps[i].voxel, {1, 1, 1}}, i, values);
        }
        return values;
    }

  private:
    // The box's voxels, in the order of taps, to values from tap `from` on.
    void fetch(const VoxelBox& box, std::size_t from, std::vector<float>& values) const {
        const auto count = static_cast<std::size_t>(box.count());
        std::vector<float> planar(count * channels());
        std::vector<float*> targets;
        for (std::size_t c = 0; c < channels(); ++c) targets.push_back(planar.data() + c * count);
        level_.voxels->fill(box, targets);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < channels(); ++c) {
                values[(from + i) * channels() + c] =
                    round_to_pixel_type(planar[c * count + i], type_);
            }
        }
    }

    const VolumeLevel& level_;
    config::PixelType type_;
};

std::vector<double> look_up(const StoredVoxels& voxels, const VolumeLevel& level,
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

std::vector<double> shares_of_range(const VolumeLevel& level, const std::vector<double>& found,
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
VolumeErrors measure(const VolumeLevel& level, config::PixelType type,
                     const VolumeReference& reference, const std::vector<Coordinates>& places,
                     const VolumeComparison& comparison, const BakeOptions& options) {
    const StoredVoxels voxels(level, type);
    std::vector<std::vector<double>> errors(places.size());
    constexpr int kTile = 32;
    const auto count = static_cast<int>(places.size());
    for_each_tile((count + kTile - 1) / kTile, options, "certify", [&](int tile) {
        for (int i = tile * kTile; i < std::min(count, (tile + 1) * kTile); ++i) {
            if (options.progress != nullptr && options.progress->cancelled()) return;
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

std::vector<double> look_up(const VolumeLevel& level, config::PixelType type,
                            const std::array<double, 3>& uvw) {
    return look_up(StoredVoxels(level, type), level, uvw);
}

VolumeErrors measure_lookups(const VolumeLevel& level, config::PixelType type,
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

VolumeErrors measure_voxels(const VolumeLevel& level, config::PixelType type,
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

std::vector<VolumeProbe> make_volume_probes(const VolumeLevel& level, config::PixelType type) {
    // In voxels: centres are at halves. Negative ones count from the far end.
    static const std::vector<Coordinates> kPlaces = {
        {0.5, 0.5, 0.5},    {-0.5, 0.5, 0.5}, {0.5, -0.5, 0.5},      {0.5, 0.5, -0.5},
        {-0.5, -0.5, -0.5}, {2.5, 1.5, 0.5},  {1.5, 3.5, 2.5},       {0.25, 0.5, 0.5},
        {0.5, 0.25, 0.5},   {0.5, 0.5, 0.25}, {-0.25, -0.25, -0.25}, {0.125, -0.125, 4.375},
        {3.25, 0.0, 1.75},  {1.0, 1.0, 1.0},  {5.3125, 2.75, 7.125}, {0.0, 0.0, 0.0}};
    const StoredVoxels voxels(level, type);
    std::vector<VolumeProbe> probes;
    const auto add = [&](const Coordinates& uvw) {
        VolumeProbe probe;
        probe.uvw = uvw;
        probe.value = look_up(voxels, level, uvw);
        probe.tolerance.assign(probe.value.size(), 0);
        // Weights that are multiples of 1/256, rounded or truncated, move the lookup by less than a
        // step along each axis.
        for (int step = 0; step < 8; ++step) {
            Coordinates moved = uvw;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double sign = (step >> axis) % 2 == 0 ? -1 : 1;
                moved[axis] += sign / 256 / level.size[axis];
            }
            const std::vector<double> near = look_up(voxels, level, moved);
            for (std::size_t c = 0; c < near.size(); ++c) {
                probe.tolerance[c] =
                    std::max(probe.tolerance[c], std::fabs(near[c] - probe.value[c]));
            }
        }
        for (std::size_t c = 0; c < probe.value.size(); ++c) {
            probe.tolerance[c] +=
                4 * rounding_error(type) * std::max(1e-3, std::fabs(probe.value[c]));
        }
        probes.push_back(std::move(probe));
    };
    for (const Coordinates& place : kPlaces) {
        Coordinates uvw;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double position = place[axis] / level.size[axis];
            uvw[axis] = position - std::floor(position);
        }
        add(uvw);
    }
    for (int i = 0; i < 8; ++i) add(low_discrepancy_point(i));
    return probes;
}

}  // namespace skybake
