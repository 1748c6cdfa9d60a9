#include "config/assets/cloud_volume.h"

#include <fmt/format.h>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/assets/octave_checks.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/parameters.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

const Row<CloudVolumeBake> cloud_volume_table[] = {
    {"cloud", Kind::text, &CloudVolumeBake::cloud, "NAME of the [clouds.NAME] to bake",
     KeyFlag::required},
    {"size", Kind::voxels, &CloudVolumeBake::size, "voxels along x, y and z, which is up",
     texel_range, Hint{"for example [512, 512, 128]"}, Exclusive{"size", "counted"}},
    {"extent", Kind::lengths, &CloudVolumeBake::extent,
     "what the voxels span, to which the cloud is stretched; by default the cloud's extent",
     Range{1e-3, 1e8}, Hint{"voxel_size sets it where it does not divide the cloud's extent"},
     Exclusive{"size", "counted"}},
    {"voxel_size", Kind::length, nullptr,
     "edge of a cubic voxel, in place of size; the cloud's extent is rounded up to whole voxels",
     Range{1e-3, 1e8}, Hint{"for example \"12 m\""}, Exclusive{"size", "measured"},
     KeyFlag::only_shown},
    {"cover", Kind::fraction, &CloudVolumeBake::cover,
     "share of the columns of voxels that hold cloud, met exactly, in place of the cloud's "
     "coverage; by default the cloud's",
     unit_range, Hint{"the bake finds the coverage that gives it"}},
};

// Whether cubes of this edge fill the extent exactly.
bool divides(const Cloud& cloud, Length edge) {
    return std::ranges::none_of(
        cloud.extent, [edge](Length extent) { return whole_voxels(extent, edge).longer; });
}

// Returns the smallest round edge of cubes that gives at most 640 voxels along each axis and
// divides the extent, or none if no round number divides it.
std::optional<Length> usual_voxel_size(const Cloud& cloud) {
    constexpr double most_voxels = 640;
    double longest = 0;
    for (const Length& extent : cloud.extent) longest = std::max(longest, extent.meters);
    if (longest <= 0) return std::nullopt;
    double decade = 1;
    while (decade > longest / most_voxels) decade /= 10;
    while (decade * 10 <= longest / most_voxels) decade *= 10;
    for (const double digits : {1.0, 1.25, 2.0, 2.5, 5.0, 10.0, 12.5, 20.0, 25.0, 50.0}) {
        const Length edge{digits * decade};
        if (edge.meters >= longest / most_voxels && divides(cloud, edge)) return edge;
    }
    return std::nullopt;
}

// This is one section while it is resolved.
struct CloudVolumeResolver {
    DecodedSection& bake;
    Decoder& decoder;

    const Place& size_place() const { return bake.place_of("size", "voxel_size"); }

    void report_missing_size(const Cloud* cloud) const {
        if (!decoder.complete) return;
        const auto usual = cloud ? usual_voxel_size(*cloud) : std::nullopt;
        decoder.report(
            "E0105", bake, "size", "is missing",
            usual
                ? fmt::format("give voxel_size = \"{}\", or size", length_to_string(usual->meters))
                : "give size, the voxels along each axis, or voxel_size, the edge of cubes");
    }

    void report_too_many(double voxels, std::size_t axis, const Cloud& cloud) const {
        decoder.diagnostics.error(
            "E0110", size_place(),
            fmt::format("`{}` makes {} voxels along {}", join_path(bake.path, "voxel_size"),
                        number_to_string(voxels), "xyz"[axis]),
            fmt::format("at most {} of {} are allowed", bake.at("size").field->range.maximum,
                        length_to_string(cloud.extent[axis].meters)));
    }

    // Sets the size for voxels of exactly this edge. If the extent is not a whole number of voxels,
    // it is made longer. If a size is out of range, the size is not set.
    void resolve_voxels(const Cloud& cloud, Length edge) const {
        VoxelCounts size{};
        std::array<double, 3> extent{};
        bool longer = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const WholeVoxels voxels = whole_voxels(cloud.extent[axis], edge);
            if (voxels.count > bake.at("size").field->range.maximum) {
                return report_too_many(voxels.count, axis, cloud);
            }
            size[axis] = static_cast<int>(voxels.count);
            extent[axis] = voxels.longer ? voxels.count * edge.meters : cloud.extent[axis].meters;
            longer = longer || voxels.longer;
        }
        replace(bake.at("size"), size);
        if (!longer) return;
        replace(bake.at("extent"), extent);
        warn_of_longer_extent(cloud, extent);
    }

    void warn_of_longer_extent(const Cloud& cloud, const std::array<double, 3>& extent) const {
        decoder.diagnostics.warning(
            "W0210", size_place(),
            fmt::format(
                "`{}` does not divide the extent of cloud `{}`: {} x {} x {} becomes {} x {} x {}",
                join_path(bake.path, "voxel_size"), cloud.name,
                length_to_string(cloud.extent[0].meters), length_to_string(cloud.extent[1].meters),
                length_to_string(cloud.extent[2].meters), length_to_string(extent[0]),
                length_to_string(extent[1]), length_to_string(extent[2])),
            "voxels have exactly this size, and the cloud is stretched to a whole number of them");
    }

    void resolve_size(const Cloud* cloud) const {
        if (!bake.gives("size") && !bake.gives("voxel_size")) report_missing_size(cloud);
        const std::optional<double> edge_m = bake.number("voxel_size");
        if (!cloud || cloud->extent[0].meters <= 0 || !edge_m) return;
        bake.at("size").value.reset();
        resolve_voxels(*cloud, Length{*edge_m});
    }

    void check_voxels(const Cloud& cloud, const VoxelCounts& size) const {
        if (cloud.extent[0].meters <= 0 || bake.gives("voxel_size")) return;
        CloudVolumeBake voxels;
        voxels.size = size;
        const DecodedField& extent = bake.at("extent");
        if (extent.value) assign(*extent.field, *extent.value, voxels.extent);
        check_cubes(bake, voxel_edges(cloud, voxels), size_place(), decoder);
    }

    void check_noises(const Cloud& cloud, std::span<const Noise> noises,
                      const VoxelCounts& size) const {
        OctaveChecks checks(size);
        std::vector<Motion> motions = {motion_of(cloud)};
        for (const Noise& noise : noises) {
            if (noise.name == cloud.noise) {
                motions.push_back(motion_of(noise));
                checks.add(noise, used_channels(noise, cloud.channels),
                           {.scale = cloud.noise_scale});
            }
            if (noise.name == cloud.detail) {
                if (cloud.detail != cloud.noise) motions.push_back(motion_of(noise));
                if (cloud.erosion == std::array{0.0, 0.0}) continue;  // relief drops fine octaves
                checks.add(noise, used_channels(noise, CloudChannels::density),
                           {.scale = cloud.detail_scale});
            }
        }
        checks.report(size_place(), decoder);
        check_frames(bake, motions, decoder);
    }

    static std::size_t channels_of(const Cloud& cloud, std::span<const Noise> noises) {
        const auto noise = std::ranges::find(noises, cloud.noise, &Noise::name);
        return cloud_channel_names(noise == noises.end() ? nullptr : &*noise, cloud.channels)
            .size();
    }

    // Velocities are below 0 too, and above 1.
    void check_velocity(const Cloud& cloud) const {
        const auto type = choice_of<PixelType>(bake.at("pixel_type"));
        if (cloud.channels != CloudChannels::velocity || !type) return;
        if (*type == PixelType::half || *type == PixelType::float32) return;
        decoder.report(
            "E0131", bake, "pixel_type", "cannot hold velocities",
            fmt::format("give half or float, or cloud `{}` other channels", shorten(cloud.name)));
    }

    // Gives one warning for all narrow towers, which names the first of them.
    void warn_of_narrow_towers(const Cloud& cloud, const VoxelCounts& size) const {
        std::vector<std::string> narrow;
        for (const Tower& tower : cloud.towers) {
            if (narrowest_sigma(tower, size) < 1) narrow.push_back("tower " + tower.name);
        }
        if (narrow.empty()) return;
        const std::string others =
            narrow.size() > 1 ? fmt::format(", like {} more,", narrow.size() - 1) : "";
        decoder.diagnostics.warning(
            "W0204", size_place(),
            fmt::format("{} of cloud `{}`{} is narrower than a voxel at size {}", narrow.front(),
                        cloud.name, others, voxels_to_string(size)),
            "it falls between voxels; use a larger size or a wider tower");
    }
};

// Fills in `size` from the cloud's extent and `voxel_size`, and the number of `mips`. If extent and
// voxel size do not give a whole number of voxels, it also sets `extent` (W0210). It reports a
// cloud that does not exist (E0132), a size that is not given (E0105) or out of range (E0110), and
// faults of the files of any volume (file_decoder.h), and frames of what stands still (E0174). It
// warns of octaves that add nothing at that size (W0208) or are too fine for it (W0203), of towers
// narrower than a voxel (W0204), and of voxels that are not cubes (W0211).
void resolve_cloud_volume(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::span<const Cloud> clouds = recipe.parameters.clouds;
    const std::span<const Noise> noises = recipe.parameters.noises;
    const CloudVolumeResolver resolver{bake, decoder};
    check_pixel_type(bake, decoder);
    const Cloud* cloud = find_named(bake, "cloud", clouds, cloud_reference, decoder);
    resolver.resolve_size(cloud);
    const auto* size = bake.value<VoxelCounts>("size");
    if (!size) return;
    resolve_files(bake, *size, Halving::down, decoder);
    if (!cloud) return;
    resolver.check_velocity(*cloud);
    check_voxel_count(bake, *size, resolver.channels_of(*cloud, noises), resolver.size_place(),
                      decoder);
    resolver.check_noises(*cloud, noises, *size);
    resolver.warn_of_narrow_towers(*cloud, *size);
    resolver.check_voxels(*cloud, *size);
}

std::vector<Read> reads_of(const Parameters& parameters, const CloudVolumeBake& bake) {
    return reads_of_cloud(parameters, bake.cloud);
}

}  // namespace

AssetKind asset_kind(Tag<CloudVolumeBake>) {
    return make_asset_kind<CloudVolumeBake>(
        {.name = "cloud_volume", .documentation = "the voxels of a cloud"},
        with_file_fields(cloud_volume_table, {.formats = R"(["vdb"])"}), reads_of,
        resolve_cloud_volume);
}

}  // namespace skybake::config
