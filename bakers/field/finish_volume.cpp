#include "bakers/field/finish_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/held_voxels.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/survey_volume.h"
#include "bakers/field/voxel_array.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/quadrature.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

std::string place_text(const std::array<double, 3>& uvw) {
    return fmt::format("u {:.6g}, v {:.6g}, w {:.6g}", uvw[0], uvw[1], uvw[2]);
}

SearchCounts search_counts(const VolumeFinish& finish, Certification certification) {
    // Rows, one point in each, rows through peaks, climbs, and points of an expensive reference.
    if (certification == Certification::full) return {8192, 1, 2048, 64, finish.estimate ? 512 : 0};
    if (finish.estimate) return {384, 1, 64, 6, 32};
    if (finish.expensive) return {40, 1, 8, 1, 0};
    return {640, 1, 96, 12, 0};
}

void certify(const VolumeFinish& finish, const BakeOptions& options, Baked& volume) {
    constexpr int kFullPoints = 16384;
    const Level& level = volume.levels.front();
    const int quick_points = quick_lookup_points(finish.expensive);
    const int points = options.certification == Certification::full ? kFullPoints : quick_points;
    Level sampled = finish.sampled.value_or(level);
    sampled.statistics = level.statistics;
    VolumeComparison of_voxels = finish.comparison;
    if (!finish.sampled) of_voxels.lookup_place = nullptr;
    const auto voxels =
        static_cast<int>(std::min<std::int64_t>(points, VoxelBox{{}, sampled.size}.count()));
    const VolumeErrors texel =
        measure_voxels(sampled, finish.sampled ? PixelType::float32 : volume.pixel_type,
                       finish.reference, voxels, options, of_voxels);
    // Volumes that repeat look alike wherever they are not empty.
    const VolumeErrors lookup =
        level.repeats[0]
            ? measure_lookups(level, volume.pixel_type, finish.reference, points, options,
                              finish.comparison)
            : search_volume(level, volume.pixel_type, finish.reference, finish.estimate,
                            search_counts(finish, options.certification), options,
                            finish.comparison);
    if (options.cancelled()) return;
    Certificate& certificate = volume.certificate;
    certificate.texel = texel.figures;
    certificate.texel_points = texel.points;
    certificate.lookup = lookup.figures;
    certificate.lookup_points = lookup.points;
    certificate.reference = finish.reference_name;
    certificate.scale = finish.comparison.scale.empty()
                            ? "share of the channel's value range, max - min"
                            : finish.comparison.scale;
    certificate.worst = place_text(lookup.worst);
    volume.certified = true;
}

using NextSize = std::array<int, 3> (*)(const std::array<int, 3>& size);

void add_levels(int count, NextSize next_size, const BakeOptions& options, Baked& volume) {
    // Levels with at most this many floats are kept in memory, so that coarser levels need not make
    // them again.
    constexpr std::int64_t kKeptFloats = 1 << 23;
    const auto channels = static_cast<int>(volume.channel_names.size());
    while (static_cast<int>(volume.levels.size()) < count && !options.cancelled()) {
        const Level& finer = volume.levels.back();
        Level level;
        level.size = next_size(finer.size);
        level.repeats = finer.repeats;
        level.voxels = std::make_shared<MipSource>(finer.voxels, finer.size, level.size);
        const std::int64_t floats = VoxelBox{{}, level.size}.count() * channels;
        if (floats <= kKeptFloats) {
            level.voxels = std::make_shared<VoxelArray>(
                read_voxels(*level.voxels, level.size, channels, options, "mips"));
        }
        volume.levels.push_back(std::move(level));
    }
}

std::optional<Diagnostic> add_level_probes(int number, const VolumeFinish& finish,
                                           const BakeOptions& options, Baked& volume) {
    ProbePlaces place;
    if (finish.probe_place) {
        place = [&finish, number](const std::array<double, 3>& uvw) {
            return finish.probe_place(uvw, number);
        };
    }
    Level& level = volume.levels[static_cast<std::size_t>(number)];
    level.nearest = is_looked_up_nearest(volume.axes);
    return add_volume_probes(volume.name, static_cast<int>(volume.axes.size()), place,
                             volume.pixel_type, options, level);
}

using UnitPlace = std::array<double, 3>;  // texture coordinates

constexpr int kVolumeProbes = 24;

// Adds places within half a voxel of either end of each axis, where repeating lookups and clamped
// lookups differ.
void add_seams(const Level& level, std::vector<UnitPlace>& places) {
    constexpr int kEach = 4;
    int index = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {0.25, -0.25}) {
            for (int i = 0; i < kEach; ++i) {
                UnitPlace place = low_discrepancy_point(index++);
                place[axis] = side / level.size[axis] + (side < 0 ? 1 : 0);
                places.push_back(place);
            }
        }
    }
}

void add_even_places(std::vector<UnitPlace>& places) {
    constexpr int kPlaces = 96;
    for (int i = 0; i < kPlaces; ++i) places.push_back(low_discrepancy_point(i));
}

// Returns at most kMostPeaks of the larger peaks, from all over the volume.
std::vector<VoxelPeak> chosen_peaks(const Level& level) {
    constexpr std::size_t kMostPeaks = 24;
    std::vector<float> largest(level.statistics.size());
    for (const VoxelPeak& peak : level.peaks) {
        float& of_channel = largest[static_cast<std::size_t>(peak.channel)];
        of_channel = std::max(of_channel, peak.value);
    }
    std::vector<VoxelPeak> high;
    for (const VoxelPeak& peak : level.peaks) {
        if (peak.value * 4 >= largest[static_cast<std::size_t>(peak.channel)]) high.push_back(peak);
    }
    std::vector<VoxelPeak> chosen;
    const std::size_t count = std::min(kMostPeaks, high.size());
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(high[i * high.size() / count]);
    return chosen;
}

// The slope from a peak along an axis, to one side. The value falls below half of the peak there.
class Slope {
  public:
    Slope(const Level& level, const StoredVoxels& voxels, const VoxelPeak& peak, std::size_t axis,
          int side)
        : level_(level), voxels_(voxels), peak_(peak), axis_(axis), side_(side) {}

    // Returns a place between the two voxels where the value falls below half, or nothing if it
    // stays above half up to the edge.
    std::optional<UnitPlace> place() const {
        int high = 0;
        int low = 1;
        while (is_high(low)) {
            high = low;
            low *= 2;
            if (low >= level_.size[axis_]) return std::nullopt;
        }
        while (low - high > 1) {
            const int middle = (low + high) / 2;
            (is_high(middle) ? high : low) = middle;
        }
        UnitPlace place;
        for (std::size_t i = 0; i < 3; ++i) {
            const double voxel = peak_.voxel[i] + 0.5 + (i == axis_ ? side_ * (high + 0.5) : 0.0);
            const double coordinate = voxel / level_.size[i];
            place[i] = coordinate - std::floor(coordinate);
        }
        return place;
    }

  private:
    bool is_high(int distance) const {
        std::array<VoxelTap, 8> taps;
        taps.fill({peak_.voxel, 0});
        const int size = level_.size[axis_];
        int index = peak_.voxel[axis_] + side_ * distance;
        if (!level_.repeats[axis_] && (index < 0 || index >= size)) return false;
        index = (index % size + size) % size;
        for (VoxelTap& tap : taps) tap.voxel[axis_] = index;
        return voxels_.at(taps)[static_cast<std::size_t>(peak_.channel)] * 2 >= peak_.value;
    }

    const Level& level_;
    const StoredVoxels& voxels_;
    const VoxelPeak& peak_;
    const std::size_t axis_;
    const int side_;
};

// Adds the peaks, places a little beside them, and the slopes around some of them.
void add_peaks(const Level& level, PixelType type, std::vector<UnitPlace>& places) {
    constexpr std::size_t kWithSlopes = 8;
    const StoredVoxels voxels(level, type);
    const std::vector<VoxelPeak> peaks = chosen_peaks(level);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        const UnitPlace within = low_discrepancy_point(static_cast<int>(i));
        UnitPlace place;
        for (std::size_t a = 0; a < 3; ++a) {
            place[a] = (peaks[i].voxel[a] + within[a]) / level.size[a];
        }
        places.push_back(place);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            UnitPlace at_seam = place;
            at_seam[axis] = 0.25 / level.size[axis];
            places.push_back(at_seam);
        }
    }
    // The peaks whose slopes are added are spread evenly over all chosen peaks.
    const std::size_t steep = std::min(kWithSlopes, peaks.size());
    for (std::size_t i = 0; i < steep; ++i) {
        const VoxelPeak& peak = peaks[i * peaks.size() / steep];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {-1, 1}) {
                const auto place = Slope(level, voxels, peak, axis, side).place();
                if (place) places.push_back(*place);
            }
        }
    }
}

// Holds the voxels of a small level in memory, because making all of them once is cheaper than
// making eight for every lookup.
Level in_memory_if_small(const Level& level, const BakeOptions& options) {
    constexpr std::int64_t kSmall = 1 << 18;
    Level held = level;
    const auto channels = static_cast<int>(level.statistics.size());
    if (VoxelBox{{}, level.size}.count() <= kSmall) {
        held.voxels = std::make_shared<VoxelArray>(
            read_voxels(*level.voxels, level.size, channels, options, "probes"));
    }
    return held;
}

ProbePlace texture_place(const UnitPlace& uvw) {
    return {{{"u", uvw[0]}, {"v", uvw[1]}, {"w", uvw[2]}}, {{uvw}}};
}

}  // namespace

void hold_voxels(const BakeOptions& options, Baked& volume, bool as_stored) {
    Level& level = volume.levels.front();
    const bool as_half = as_stored && volume.pixel_type == PixelType::half;
    level.voxels = held_voxels(std::move(level.voxels), level.size,
                               static_cast<int>(volume.channel_names.size()), options,
                               as_half ? PixelType::half : PixelType::float32);
}

void add_voxels(const std::array<int, 3>& size, std::shared_ptr<const VoxelSource> voxels,
                Baked& volume) {
    Level level;
    level.size = size;
    level.repeats = repeating_axes(volume.axes);
    level.voxels = std::move(voxels);
    volume.levels.push_back(std::move(level));
}

void add_mip_levels(int count, const BakeOptions& options, Baked& volume) {
    add_levels(count, next_mip_size, options, volume);
}

void add_slice_levels(int count, const BakeOptions& options, Baked& volume) {
    add_levels(count, next_slice_size, options, volume);
}

int quick_lookup_points(bool is_expensive) { return is_expensive ? 64 : 1024; }

double seam_error(const VoxelSource& voxels, const std::array<int, 3>& size, std::size_t channels,
                  std::size_t axes, const FillBeyond& beyond) {
    constexpr int kPoints = 32;
    std::vector<float> here(channels), there(channels);
    const auto address = [](float& value) { return &value; };
    const auto near = mapped<float*>(here, address);
    const auto far = mapped<float*>(there, address);
    double largest = 0;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        for (int i = 0; i < kPoints; ++i) {
            const std::array<double, 3> point = low_discrepancy_point(i);
            VoxelBox voxel{{}, {1, 1, 1}};
            for (std::size_t k = 0; k < 3; ++k) {
                voxel.origin[k] = static_cast<int>(std::floor(point[k] * size[k]));
            }
            voxel.origin[axis] = 0;
            voxels.fill(voxel, near);
            beyond(axis, voxel, far);
            for (std::size_t c = 0; c < channels; ++c) {
                largest = std::max(largest, std::fabs(double{here[c]} - double{there[c]}));
            }
        }
    }
    return largest;
}

Outcome<Baked> finish_volume(Baked volume, const VolumeFinish& finish, const BakeOptions& options) {
    Outcome<Baked> outcome;
    code_levels(volume);
    for (std::size_t i = 0; i < volume.levels.size(); ++i) {
        if (options.cancelled()) return outcome;
        ColumnCount count{finish.covered_above.value_or(0)};
        const bool counts = i == 0 && finish.covered_above;
        outcome.diagnostics = survey_level(volume, static_cast<int>(i), finish.histogram_ranges,
                                           options, counts ? &count : nullptr);
        if (counts) volume.details.emplace_back(covered_columns, count.share);
        if (!outcome.diagnostics.empty() || options.cancelled()) return outcome;
        if (const auto problem = add_level_probes(static_cast<int>(i), finish, options, volume)) {
            outcome.diagnostics.push_back(*problem);
            return outcome;
        }
    }
    if (options.certification != Certification::off) {
        const BakeTime time(BakePart::certificate);
        if (finish.measure) {
            volume.certificate = finish.measure(volume, options);
            volume.certified = true;
        } else if (finish.reference) {
            certify(finish, options, volume);
        }
    }
    if (options.cancelled()) return outcome;
    outcome.value = std::move(volume);
    return outcome;
}

std::optional<Diagnostic> add_volume_probes(const std::string& asset, int dimensions,
                                            const ProbePlaces& place, PixelType type,
                                            const BakeOptions& options, Level& level) {
    ProbeSpace space{place ? place : texture_place, {}};
    const Level readable = in_memory_if_small(level, options);
    add_seams(readable, space.wanted);
    add_even_places(space.wanted);
    add_peaks(readable, type, space.wanted);
    return set_probes(asset, probed_texture(readable, dimensions, type), {space}, kVolumeProbes,
                      options, level);
}

}  // namespace skybake
