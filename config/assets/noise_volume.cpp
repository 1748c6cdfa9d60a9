#include "config/assets/noise_volume.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/file_decoder.h"
#include "config/assets/octave_checks.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/parameters.h"

namespace skybake::config {
namespace {

const Row<NoiseVolumeBake> noise_volume_table[] = {
    {"noise", Kind::text, &NoiseVolumeBake::noise, "NAME of the [noise.NAME] to bake",
     KeyFlag::required},
    {"size", Kind::voxels, &NoiseVolumeBake::size,
     "voxels along x, y and z; by default the noise's size", texel_range,
     Hint{"1 along z gives a picture"}},
};

// Fills in `size` from the noise, and the number of `mips`. It reports a noise that does not exist
// (E0130), pixel types that a format does not have (E0131), too many voxels (E0126), and columns
// and levels beyond what the size has (E0110), and frames of a noise that stands still (E0174). It
// warns of octaves that add nothing at that size (W0208) or are too fine for it (W0203).
void resolve_noise_volume(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::span<const Noise> noises = recipe.parameters.noises;
    check_pixel_type(bake, decoder);
    const Noise* noise = find_named(bake, "noise", noises, noise_reference, decoder);
    if (noise && noise->size[0] > 0) derive(bake.at("size"), noise->size);
    const auto* size = bake.value<VoxelCounts>("size");
    if (!size) return;
    resolve_files(bake, *size, Halving::down, decoder);
    if (!noise) return;
    check_frames(bake, std::array{motion_of(*noise)}, decoder);
    const std::size_t channels = noise->pack == NoisePacking::none ? noise->channels.size() : 1;
    const Place& place = bake.place_of("size", "noise");
    check_voxel_count(bake, *size, channels, place, decoder);
    OctaveChecks checks(*size);
    checks.add(*noise, noise->channels, {.sampling = noise->sampling});
    checks.report(place, decoder);
}

std::vector<Read> reads_of(const Parameters& parameters, const NoiseVolumeBake& bake) {
    const Noise& noise = noise_named(parameters, bake.noise);
    return reads_of_noise(noise, noise.channels);
}

}  // namespace

AssetKind asset_kind(Tag<NoiseVolumeBake>) {
    return make_asset_kind<NoiseVolumeBake>(
        {.name = "noise_volume", .documentation = "the voxels of a noise"},
        with_file_fields(noise_volume_table, {}), reads_of, resolve_noise_volume);
}

}  // namespace skybake::config
