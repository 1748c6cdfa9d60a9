#include "bakers/assets/cloud_distance/cloud_distance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_distance/distance_check.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/math/bake_clock.h"
#include "bakers/occupancy/cloud_bits.h"
#include "bakers/occupancy/distance_volume.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using config::CloudDistanceBake;
using config::DistanceContent;
using occupancy::ChannelSource;
using occupancy::DistanceCheckResult;
using occupancy::DistanceCode;
using occupancy::DistanceSource;

std::vector<std::string> grid_names(const std::vector<DistanceContent>& contents) {
    return mapped<std::string>(contents, [&](const DistanceContent content) {
        return word_of("cloud_distance", "contents", content);
    });
}

std::string content_of(const CloudDistanceBake& bake) {
    const std::string scale =
        occupancy::is_unorm(bake.pixel_type)
            ? fmt::format(", 0 to 1 for {} m to {} m", bake.range[0].meters, bake.range[1].meters)
            : "";
    return fmt::format(
        "texels of {} voxels: {} (distance: metres to cloud, negative within it, never too far{})",
        bake.cell, fmt::join(grid_names(bake.contents), ", "), scale);
}

std::vector<std::array<double, 2>> histogram_ranges(const CloudDistanceBake& bake) {
    std::vector<std::array<double, 2>> ranges(bake.contents.size(), {0, 1});
    if (!occupancy::is_unorm(bake.pixel_type))
        ranges.front() = {bake.range[0].meters, bake.range[1].meters};
    return ranges;
}

struct PointsAndRays {
    int points = 0;
    int rays = 0;
};

PointsAndRays checked_by(Certification certification) {
    if (certification == Certification::off) return {};
    return certification == Certification::full ? PointsAndRays{65536, 10000}
                                                : PointsAndRays{4096, 1000};
}

Certificate certificate_of(const Baked& volume, const DistanceCheckResult& found,
                           const CloudDistanceBake& bake) {
    Certificate certificate;
    certificate.texel = found.texel;
    certificate.lookup = found.lookup;
    certificate.texel_points = found.points;
    certificate.lookup_points = found.points;
    certificate.reference = fmt::format(
        "exact distances to the cells of the filtered volume, of which {} of {} steps of {} rays "
        "are lost",
        found.lost_steps, found.steps, found.rays);
    certificate.scale = fmt::format("the range of {} m; values are lower bounds of the distance",
                                    bake.range[1].meters - bake.range[0].meters);
    std::vector<std::string> place;
    for (std::size_t i = 0; i < 3; ++i) {
        place.push_back(fmt::format(
            "{} {:.6g}", volume.axes[i].quantity,
            volume.axes[i].first + found.farthest_off[i] * volume.voxel_size_m[i] / bake.cell));
    }
    certificate.worst = fmt::format("{}", fmt::join(place, ", "));
    return certificate;
}

Diagnostic failed_check(const Baked& volume, const DistanceCheckResult& found) {
    return diagnosis(
        "E0405",
        fmt::format(
            "`{}`: {} of {} distances are too far and {} too near, by up to {:.3g} m, and {} of {} "
            "steps are lost",
            volume.name, found.too_far, found.points, found.too_near, found.worst_m,
            found.lost_steps, found.steps));
}

// One bake of the asset.
class DistanceBake {
  public:
    DistanceBake(const OccupiedVolume& of, const CloudDistanceBake& bake, double wisp_height,
                 const BakeOptions& options)
        : of_(of),
          bake_(bake),
          wisp_height_(wisp_height),
          options_(options),
          grid_{{of.volume.levels.front().size, bake.cell}, of.volume.voxel_size_m},
          code_(distance_code(bake, of.volume.voxel_size_m)) {}

    Outcome<Baked> run(Baked volume) {
        describe(volume);
        const ChannelSource source = channel_of(of_, bake_.channel);
        const occupancy::VoxelBits bits = voxel_bits(source, grid_.grid, of_.threshold, options_);
        if (options_.cancelled()) return {};
        occupancy::DistanceFields fields{bake_.core.meters, wisp_height_, {}};
        if (has(DistanceContent::density_scale)) {
            fields.mean_density = mean_densities(source, grid_.grid, options_);
        }
        const auto texels = std::make_shared<const DistanceSource>(
            bits, grid_, code_, bake_.contents, std::move(fields), options_);
        if (options_.cancelled()) return {};
        if (has(DistanceContent::profile)) volume.details.emplace_back("core_m", texels->core_m());
        add_voxels(texels->size(), texels, volume);
        std::optional<Diagnostic> warning;
        if (options_.certification != Certification::off) {
            warning = add_skipping_gain(gain_of(*texels, bits), volume);
        }
        Outcome<Baked> finished = finish(std::move(volume), check(*texels, bits));
        if (finished.value && warning) finished.diagnostics.push_back(*warning);
        return finished;
    }

  private:
    bool has(DistanceContent content) const {
        return std::ranges::find(bake_.contents, content) != bake_.contents.end();
    }

    void describe(Baked& volume) const {
        volume.kind = "cloud_distance";
        volume.content = content_of(bake_);
        place_blocks(of_.volume, grid_.grid, {"texel", "texel i is at (i + 1/2) / size"}, volume);
        volume.channel_names = names_of_channels(bake_.contents.size());
        volume.grid_names = grid_names(bake_.contents);
        set_files(bake_, volume);
        volume.details.insert(
            volume.details.end(),
            {{"of", bake_.of},
             {"channel", of_.volume.channel_names[channel_named(of_.volume, bake_.channel)]},
             {"cell", static_cast<double>(bake_.cell)},
             {"threshold", to_shortest(of_.threshold)},
             {"metres_at_0", code_.ends()[0]},
             {"metres_at_1", code_.ends()[1]}});
        if (has(DistanceContent::detail_type)) {
            volume.details.emplace_back("wisp_height", wisp_height_);
        }
    }

    // What the published march by distances saves.
    occupancy::SkippingGain gain_of(const DistanceSource& texels,
                                    const occupancy::VoxelBits& bits) const {
        const BakeTime time(BakePart::certificate);
        const double step_m = *std::ranges::min_element(grid_.voxel_m);
        const auto stay = [&, texture = texture_of(texels)](const occupancy::Place& from,
                                                            const occupancy::Place&) {
            return occupancy::stay_of_distance(looked_up_m(texture, code_, from) / step_m);
        };
        return skipping_gain(bits, grid_.voxel_m, config::OccupancyFilter::trilinear, stay,
                             options_);
    }

    occupancy::DistanceTexture texture_of(const DistanceSource& texels) const {
        return {texels.size(), texels.distances().data(), bake_.cell};
    }

    DistanceCheckResult check(const DistanceSource& texels,
                              const occupancy::VoxelBits& bits) const {
        const auto [points, rays] = checked_by(options_.certification);
        if (points == 0) return {};
        const BakeTime time(BakePart::certificate);
        const occupancy::NearestVoxel nearest(bits, grid_.voxel_m);
        return check_distances(texture_of(texels), code_, nearest, grid_.grid.voxels, grid_.voxel_m,
                               points, rays, options_);
    }

    Outcome<Baked> finish(Baked volume, const DistanceCheckResult& found) const {
        if (options_.cancelled()) return {};
        if (found.failed()) return failed_check(volume, found);
        VolumeFinish finish;
        finish.histogram_ranges = histogram_ranges(bake_);
        finish.measure = [&](const Baked& baked, const BakeOptions&) {
            return certificate_of(baked, found, bake_);
        };
        finish.probe_place = [axes = volume.axes](const std::array<double, 3>& uvw, int) {
            return place_on(axes, uvw);
        };
        return finish_volume(std::move(volume), finish, options_);
    }

    const OccupiedVolume& of_;
    const CloudDistanceBake& bake_;
    double wisp_height_;
    const BakeOptions& options_;
    occupancy::DistanceGrid grid_;
    DistanceCode code_;
};

}  // namespace

DistanceCode distance_code(const CloudDistanceBake& bake, const std::array<double, 3>& voxel_m) {
    std::array<double, 3> texel_m{};
    for (std::size_t i = 0; i < 3; ++i) texel_m[i] = voxel_m[i] * bake.cell;
    return {{bake.range[0].meters, bake.range[1].meters}, texel_m, bake.pixel_type};
}

Outcome<Baked> bake_cloud_distance(const OccupiedVolume& of, const CloudDistanceBake& bake,
                                   double wisp_height, const BakeOptions& options, Baked volume) {
    return DistanceBake(of, bake, wisp_height, options).run(std::move(volume));
}

}  // namespace skybake
