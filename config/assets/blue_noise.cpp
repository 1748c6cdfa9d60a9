#include "config/assets/blue_noise.h"

#include <fmt/format.h>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"

namespace skybake::config {
namespace {

constexpr Range mask_sigma_range{0.5, 8};

// The mask is made in memory, with 22 bytes for each voxel.
constexpr std::int64_t most_mask_voxels = std::int64_t{1} << 26;

constexpr std::string_view wolfe_2022 =
    "Wolfe, Morrical, Akenine-Möller and Ramamoorthi 2022, Spatiotemporal Blue Noise Masks";

const Row<BlueNoiseBake> blue_noise_table[] = {
    {"size", Kind::size, &BlueNoiseBake::size, "pixels along x and y", Range{2, 4096},
     Default{"[128, 128]"},
     Hint{"if both are multiples of 16, each value of unorm8 is equally frequent"},
     Cited{wolfe_2022}},
    {"frames", Kind::integer, &BlueNoiseBake::frames,
     "number of frames, along z; 1 gives a mask without time", Range{1, 1024}, Default{"64"},
     Cited{wolfe_2022}},
    {"seed", Kind::seed, &BlueNoiseBake::seed, "another seed gives another mask of the same kind",
     Default{"0"}},
    {"spatial_sigma", Kind::number, &BlueNoiseBake::spatial_sigma,
     "standard deviation of the energy within a frame, in pixels", mask_sigma_range, Default{"1.9"},
     Hint{"larger values leave less power at low frequencies"}, Cited{wolfe_2022}},
    {"temporal_sigma", Kind::number, &BlueNoiseBake::temporal_sigma,
     "standard deviation of the energy of a pixel over time, in frames", mask_sigma_range,
     Default{"1.9"}, Cited{wolfe_2022}},
};

void check_mask_size(const DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    const std::int64_t voxels = std::int64_t{size[0]} * size[1] * size[2];
    if (voxels <= most_mask_voxels) return;
    decoder.diagnostics.error(
        "E0126", bake.at("size").source->place,
        fmt::format("[{}] has {} voxels ({}), which are made in memory", bake.path, voxels,
                    voxels_to_string(size)),
        fmt::format("at most {} (2^26) voxels are allowed", most_mask_voxels));
}

// Means of neighbours are all near 1/2 and no blue noise.
void check_one_level(const DecodedSection& bake, Decoder& decoder) {
    if (bake.whole("mips").value_or(1) == 1) return;
    decoder.report("E0110", bake, "mips", "is out of range: blue noise has one level",
                   "a mean of several pixels is about 1/2 everywhere");
}

// The module beside the file loads masks of any size, the package's own loader only one.
void warn_of_takram(const DecodedSection& bake, const VoxelCounts& voxels, Decoder& decoder) {
    constexpr VoxelCounts loaded = {128, 128, 64};
    if (choice_of<Target>(bake.at("target")) != Target::takram || voxels == loaded) return;
    const bool is_wide = voxels[0] != loaded[0] || voxels[1] != loaded[1];
    const std::string_view unusual = is_wide ? "size" : "frames";
    decoder.report("W0205", bake, unusual, "is not what @takram/three-geospatial loads",
                   "its STBNLoader takes 128 x 128 pixels and 64 frames");
}

// Reports pixel types that a format does not have (E0131), a mask that is too large (E0126) and
// levels of detail, which a mask does not have (E0110). It warns of a size that takram's loader does
// not take (W0205).
void resolve_blue_noise(DecodedSection& bake, const RecipeSoFar&, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    refuse_blocks(bake, "blue noise, whose values must stay apart", decoder);
    check_one_level(bake, decoder);
    const auto* size = bake.value<std::array<int, 2>>("size");
    const std::optional<int> frames = bake.whole("frames");
    if (!size || !frames) return;
    const VoxelCounts voxels = {(*size)[0], (*size)[1], *frames};
    resolve_files(bake, voxels, Halving::down, decoder);
    check_mask_size(bake, voxels, decoder);
    warn_of_takram(bake, voxels, decoder);
}

}  // namespace

AssetKind asset_kind(Tag<BlueNoiseBake>) {
    return make_asset_kind<BlueNoiseBake>(
        {.name = "blue_noise",
         .documentation = "a mask of blue noise, also over time, for jitter and dithering"},
        with_file_fields(blue_noise_table, {.formats = R"(["bin"])",
                                            .mips = "always 1: means of pixels are no blue noise",
                                            .pixel_type = R"("unorm8")"}),
        nullptr, resolve_blue_noise);
}

}  // namespace skybake::config
