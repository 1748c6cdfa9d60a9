// This header gives the rows of all keys of a recipe except those of its assets and its sweep, and
// the functions that decode the sections with names.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/sections/atmosphere.h"
#include "config/sections/cloud.h"
#include "config/sections/color.h"
#include "config/sections/layer.h"
#include "config/sections/noise.h"
#include "config/sections/parameters.h"
#include "config/sections/particles.h"
#include "config/sections/preview.h"
#include "config/sections/scene.h"
#include "config/sections/volume.h"

namespace skybake::config {

// These are the rows of all sections except [bake.NAME] (config/assets) and [sweep] (config/sweep).
// To add a key, add its row, and a member of the same name to the section's struct; everything else
// follows.
std::span<const Row<Parameters>> root_fields();
std::span<const Row<Atmosphere>> atmosphere_fields();
std::span<const Row<Layer>> layer_fields();
std::span<const Row<Color>> color_fields();
std::span<const Row<Scene>> scene_fields();
std::span<const Row<Preview>> preview_fields();
std::span<const Row<PreviewCamera>> preview_camera_fields();
std::span<const Row<Particles>> particles_fields();
std::span<const Row<Noise>> noise_fields();
std::span<const Row<NoiseChannel>> noise_channel_fields();
std::span<const Row<VolumeFile>> volume_fields();
std::span<const Row<Cloud>> cloud_fields();
std::span<const Row<HeightProfile>> height_profile_fields();
std::span<const Row<CloudMap>> coverage_map_fields();
std::span<const Row<CloudMap>> type_map_fields();
std::span<const Row<Convection>> convection_fields();
std::span<const Row<Tower>> tower_fields();

// Clouds have them, and tables of the light within clouds.
inline constexpr Choice cloud_particles_choices[] = {
    {CloudParticles::droplets, "droplets", "droplets of water"},
    {CloudParticles::ice, "ice", "rough crystals of ice, which show neither bow nor halo"},
};

// The functions below decode sections that the user names. The value of an entry is a table. What they
// return is complete only if no error was reported; its name is right in any case.

// Decodes one [volumes.NAME].
VolumeFile decode_volume(const Entry& entry, Decoder& decoder);

// Returns the path of the file that the key `file` names: it is looked for where includes are, in the
// folder of the recipe that names it. Reports an empty name and returns an empty path. `what` is the
// file: "a picture".
std::filesystem::path path_of_file(const DecodedSection& section, std::string_view what,
                                   Decoder& decoder);

// These are the sections that a cloud may be made of, and the recipe that they stand in.
struct CloudSources {
    std::span<const Noise> noises;
    std::span<const VolumeFile> volumes;
    const Table& root;
};

// Decodes one [clouds.NAME] with its height profile, maps and towers. `sources` are those of the
// recipe. It reports names of noises and volumes that do not exist (E0130, E0170), scaled frequencies
// that are too high (E0128), a map of types where the profile blends none, and keys that shape noise
// beside a volume (E0111).
Cloud decode_cloud(const Entry& entry, const CloudSources& sources, Decoder& decoder);

// Completes the keys of a cloud whose values follow from what it is made of, a volume or noise: the
// extent and the softness of edges. It reports a volume that does not exist (E0170) or whose file
// cannot be read (E0300, E0304), an extent that nothing gives (E0105), and keys and tables that shape
// noise beside a volume (E0111).
void resolve_cloud_source(DecodedSection& section, const Table& table, const CloudSources& sources,
                          Decoder& decoder);

// Decodes the fields of one [atmosphere.layers.NAME] and resolves its coefficients to scattering
// and extinction. It takes particles and wavelengths from the recipe. It returns none if the layer
// is switched off or has no usable coefficients; errors are reported.
std::optional<Layer> decode_layer(const Entry& entry, const Parameters& recipe, Decoder& decoder);

// Warns (W0202) of a layer that is unreasonably opaque. The cause is most often a wrong unit.
void check_optical_depth(const Layer& layer, const Atmosphere& atmosphere, const Table& table,
                         Decoder& decoder);

// Decodes one [noise.NAME] and its channels.
Noise decode_noise(const Entry& entry, Decoder& decoder);

// Decodes one [particles.NAME]. E0144 is reported for spheres of air in air, and for water at
// wavelengths where its refractive index is not known.
Particles decode_particles(const Entry& entry, std::span<const Length> wavelengths,
                           Decoder& decoder);

}  // namespace skybake::config
