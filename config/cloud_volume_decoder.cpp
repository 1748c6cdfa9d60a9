#include "config/cloud_volume_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/cloud_channels.h"
#include "config/key_path.h"
#include "config/named_reference.h"
#include "config/octave_checks.h"
#include "config/tower_width.h"
#include "config/units.h"
#include "config/volume_files_decoder.h"

namespace skybake::config {
namespace {

// One section while it is resolved.
struct CloudVolumeResolver {
    DecodedSection& bake;
    Decoder& decoder;

    Place size_place() const {
        for (const std::string_view key : {"size", "voxel_size"}) {
            if (bake.at(key).source) return bake.at(key).source->place;
        }
        return bake.place;
    }

    void report_missing_size() const {
        if (!decoder.complete) return;
        decoder.diagnostics.error("E0105", bake.place,
                                  fmt::format("`{}` is missing", join_path(bake.path, "size")),
                                  "give size = [512, 512, 128], or voxel_size = \"12 m\"");
    }

    // max(1, round(extent / voxel_size)); none if that is out of the range of a size.
    std::optional<VoxelCounts> size_of(const Cloud& cloud, double voxel_size) const {
        VoxelCounts size{};
        const double most = bake.at("size").field->range.maximum;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double voxels = std::round(cloud.extent[axis].meters / voxel_size);
            if (voxels > most) {
                decoder.diagnostics.error(
                    "E0110", size_place(),
                    fmt::format("`{}` makes {} voxels along {}", join_path(bake.path, "voxel_size"),
                                spell_number(voxels), "xyz"[axis]),
                    fmt::format("at most {} of {}", most, spell_length(cloud.extent[axis].meters)));
                return std::nullopt;
            }
            size[axis] = std::max(1, static_cast<int>(voxels));
        }
        return size;
    }

    void resolve_size(const Cloud* cloud) const {
        DecodedField& size = bake.at("size");
        const DecodedField& voxel_size = bake.at("voxel_size");
        if (!size.source && !voxel_size.source) report_missing_size();
        const bool known = cloud && cloud->extent[0].meters > 0 && voxel_size.value;
        if (!known) return;
        size.value.reset();
        if (const auto voxels = size_of(*cloud, std::get<double>(*voxel_size.value))) {
            size.value = *voxels;
            size.derived = true;
        }
    }

    void check_noises(const Cloud& cloud, std::span<const Noise> noises,
                      const VoxelCounts& size) const {
        OctaveChecks checks(size);
        for (const Noise& noise : noises) {
            if (noise.name == cloud.noise) {
                checks.add(noise, used_channels(noise, cloud.channels),
                           {.scale = cloud.noise_scale});
            }
            if (noise.name == cloud.detail) {
                checks.add(noise, used_channels(noise, CloudChannels::density),
                           {.scale = cloud.detail_scale});
            }
        }
        checks.report(size_place(), decoder);
    }

    std::size_t channels_of(const Cloud& cloud, std::span<const Noise> noises) const {
        for (const Noise& noise : noises) {
            if (noise.name == cloud.noise) return cloud_channel_names(noise, cloud.channels).size();
        }
        return 1;
    }

    // One warning, of the first tower.
    void warn_of_narrow_towers(const Cloud& cloud, const VoxelCounts& size) const {
        std::vector<std::string> narrow;
        for (const Tower& tower : cloud.towers) {
            if (narrowest_sigma(tower, size) < 1) narrow.push_back("tower " + tower.name);
        }
        if (cloud.scatter.count > 0 && narrowest_sigma(cloud.scatter, size) < 1) {
            narrow.emplace_back("scatter");
        }
        if (narrow.empty()) return;
        const std::string others =
            narrow.size() > 1 ? fmt::format(", like {} more,", narrow.size() - 1) : "";
        decoder.diagnostics.warning(
            "W0204", size_place(),
            fmt::format("{} of cloud `{}`{} is narrower than a voxel at size {}", narrow.front(),
                        cloud.name, others, spell_voxels(size)),
            "it falls between voxels; use a larger size or a wider sigma");
    }
};

}  // namespace

void resolve_cloud_volume(DecodedSection& bake, std::span<const Cloud> clouds,
                          std::span<const Noise> noises, Decoder& decoder) {
    const CloudVolumeResolver resolver{bake, decoder};
    check_pixel_type(bake, decoder);
    const Cloud* cloud = find_named(bake, "cloud", clouds, cloud_reference, decoder);
    resolver.resolve_size(cloud);
    if (!bake.at("size").value) return;
    const auto size = std::get<VoxelCounts>(*bake.at("size").value);
    resolve_volume_files(bake, size, Halving::down, decoder);
    if (!cloud) return;
    check_voxel_count(bake, size, resolver.channels_of(*cloud, noises), resolver.size_place(),
                      decoder);
    resolver.check_noises(*cloud, noises, size);
    resolver.warn_of_narrow_towers(*cloud, size);
}

}  // namespace skybake::config
