#include "config/assets/noise_volume_decoder.h"

#include "config/assets/octave_checks.h"
#include "config/assets/volume_files_decoder.h"
#include "config/fields/named_reference.h"

namespace skybake::config {
namespace {

// What the size was said by: the bake, or the noise that it names.
Place size_place(const DecodedSection& bake) {
    for (const std::string_view key : {"size", "noise"}) {
        if (bake.at(key).source) return bake.at(key).source->place;
    }
    return bake.place;
}

void resolve_size(DecodedSection& bake, const Noise& noise) {
    DecodedField& size = bake.at("size");
    if (size.source || noise.size[0] == 0) return;
    size.value = noise.size;
    size.derived = true;
}

}  // namespace

void resolve_noise_volume(DecodedSection& bake, std::span<const Noise> noises, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    const Noise* noise = find_named(bake, "noise", noises, noise_reference, decoder);
    if (noise) resolve_size(bake, *noise);
    if (!bake.at("size").value) return;
    const auto size = std::get<VoxelCounts>(*bake.at("size").value);
    resolve_volume_files(bake, size, Halving::down, decoder);
    if (!noise) return;
    const std::size_t channels = noise->pack == NoisePacking::none ? noise->channels.size() : 1;
    const Place place = size_place(bake);
    check_voxel_count(bake, size, channels, place, decoder);
    OctaveChecks checks(size);
    checks.add(*noise, noise->channels, {.sampling = noise->sampling});
    checks.report(place, decoder);
}

}  // namespace skybake::config
