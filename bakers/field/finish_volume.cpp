#include "bakers/field/finish_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "bakers/field/make_volume_probes.h"
#include "bakers/field/mip_source.h"
#include "bakers/field/stored_source.h"
#include "bakers/field/survey_volume.h"

namespace skybake {

namespace {

std::string place_text(const std::array<double, 3>& uvw) {
    return fmt::format("u {:.6g}, v {:.6g}, w {:.6g}", uvw[0], uvw[1], uvw[2]);
}

void certify(const VolumeFinish& finish, const BakeOptions& options, Baked& volume) {
    constexpr int kDearPoints = 64;
    constexpr int kQuickPoints = 1024;
    constexpr int kFullPoints = 16384;
    const Level& level = volume.levels.front();
    const int quick_points = finish.dear ? kDearPoints : kQuickPoints;
    const int points = options.certification == Certification::full ? kFullPoints : quick_points;
    const auto voxels =
        static_cast<int>(std::min<std::int64_t>(points, VoxelBox{{}, level.size}.count()));
    const VolumeErrors texel = measure_voxels(level, volume.pixel_type, finish.reference, voxels,
                                              options, finish.comparison);
    const VolumeErrors lookup = measure_lookups(level, volume.pixel_type, finish.reference, points,
                                                options, finish.comparison);
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

}  // namespace

void add_mip_levels(int count, const BakeOptions& options, Baked& volume) {
    // Levels of no more floats than this are kept, so that those below need not make them again.
    constexpr std::int64_t kKeptFloats = 1 << 23;
    const auto channels = static_cast<int>(volume.channel_names.size());
    while (static_cast<int>(volume.levels.size()) < count && !options.cancelled()) {
        const Level& finer = volume.levels.back();
        Level level;
        level.size = next_mip_size(finer.size);
        level.repeats = finer.repeats;
        level.voxels = std::make_shared<MipSource>(finer.voxels, finer.size);
        const std::int64_t floats = VoxelBox{{}, level.size}.count() * channels;
        if (floats <= kKeptFloats) {
            level.voxels = std::make_shared<StoredSource>(*level.voxels, level.size, channels,
                                                          options, "mips");
        }
        volume.levels.push_back(std::move(level));
    }
}

namespace {

std::optional<config::Diagnostic> add_level_probes(int number, const VolumeFinish& finish,
                                                   const BakeOptions& options, Baked& volume) {
    ProbePlaces place;
    if (finish.probe_place) {
        place = [&finish, number](const std::array<double, 3>& uvw) {
            return finish.probe_place(uvw, number);
        };
    }
    Level& level = volume.levels[static_cast<std::size_t>(number)];
    level.nearest = is_looked_up_nearest(volume.axes);
    return add_volume_probes(volume.name, place, volume.pixel_type, options, level);
}

}  // namespace

config::Outcome<Baked> finish_volume(Baked volume, const VolumeFinish& finish,
                                     const BakeOptions& options) {
    config::Outcome<Baked> outcome;
    for (std::size_t i = 0; i < volume.levels.size(); ++i) {
        if (options.cancelled()) return outcome;
        const auto start = std::chrono::steady_clock::now();
        outcome.diagnostics =
            survey_level(volume, static_cast<int>(i), finish.histogram_ranges, options);
        volume.bake_seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (!outcome.diagnostics.empty() || options.cancelled()) return outcome;
        if (const auto problem = add_level_probes(static_cast<int>(i), finish, options, volume)) {
            outcome.diagnostics.push_back(*problem);
            return outcome;
        }
    }
    if (options.certification != Certification::off) {
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

}  // namespace skybake
