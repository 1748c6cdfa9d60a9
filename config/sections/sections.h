// This header gives the rows of all keys of a recipe except those of its assets and its sweep, and
// the functions that decode the sections with names.
#pragma once

#include <optional>
#include <span>
#include <string>

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
using RootField = Row<Parameters>;
using AtmosphereField = Row<Atmosphere>;
using LayerField = Row<Layer>;
using ColorField = Row<Color>;
using SceneField = Row<Scene>;
using PreviewField = Row<Preview>;
using PreviewCameraField = Row<PreviewCamera>;
using ParticlesField = Row<Particles>;
using NoiseField = Row<Noise>;
using NoiseChannelField = Row<NoiseChannel>;
using VolumeField = Row<VolumeFile>;
using CloudField = Row<Cloud>;
using HeightProfileField = Row<HeightProfile>;
using CloudMapField = Row<CloudMap>;
using ConvectionField = Row<Convection>;
using TowerField = Row<Tower>;

std::span<const RootField> root_fields();
std::span<const AtmosphereField> atmosphere_fields();
std::span<const LayerField> layer_fields();
std::span<const ColorField> color_fields();
std::span<const SceneField> scene_fields();
std::span<const PreviewField> preview_fields();
std::span<const PreviewCameraField> preview_camera_fields();
std::span<const ParticlesField> particles_fields();
std::span<const NoiseField> noise_fields();
std::span<const NoiseChannelField> noise_channel_fields();
std::span<const VolumeField> volume_fields();
// Clouds have them, and tables of the light within clouds.
inline constexpr Choice cloud_particles_choices[] = {
    {CloudParticles::droplets, "droplets", "droplets of water"},
    {CloudParticles::ice, "ice", "rough crystals of ice, which show neither bow nor halo"},
};

std::span<const CloudField> cloud_fields();
std::span<const HeightProfileField> height_profile_fields();
std::span<const CloudMapField> coverage_map_fields();
std::span<const CloudMapField> type_map_fields();
std::span<const ConvectionField> convection_fields();
std::span<const TowerField> tower_fields();

// Decodes one [volumes.NAME] and sets `file_place` to the place of its `file`. The volume is complete
// only if no error was reported; its name is right in any case.
VolumeFile decode_volume(const std::string& name, const Place& place, const Table& table,
                         Place& file_place, Decoder& decoder);

// These are the sections that a cloud may be made of.
struct CloudSources {
    std::span<const Noise> noises;
    std::span<const VolumeFile> volumes;
    std::span<const Place> volume_files;  // the place of `file` of each
};

// Decodes one [clouds.NAME] with its height profile, maps and towers. `sources` are those of the
// recipe. It reports names of noises and volumes that do not exist (E0130, E0170), scaled frequencies
// that are too high (E0128), a map of types where the profile blends none, and keys that shape noise
// beside a volume (E0111).
Cloud decode_cloud(const std::string& name, const Place& place, const Table& table,
                   const CloudSources& sources, Decoder& decoder);

// Completes the keys of a cloud whose values follow from what it is made of, a volume or noise: the
// extent and the softness of edges. It reports a volume that does not exist (E0170) or whose file
// cannot be read (E0300, E0304), an extent that nothing gives (E0105), and keys and tables that shape
// noise beside a volume (E0111).
void resolve_cloud_source(DecodedSection& section, const Table& table, const CloudSources& sources,
                          Decoder& decoder);

// Decodes the fields of one [atmosphere.layers.NAME] and resolves its coefficients to scattering
// and extinction. It takes particles and wavelengths from the recipe. It returns none if the layer
// is switched off or has no usable coefficients; errors are reported.
std::optional<Layer> decode_layer(const std::string& name, const Place& place, const Table& table,
                                  const Parameters& recipe, Decoder& decoder);

// Warns (W0202) of a layer that is unreasonably opaque. The cause is most often a wrong unit.
void check_optical_depth(const Layer& layer, const Atmosphere& atmosphere, const Table& table,
                         Decoder& decoder);

// Decodes one [noise.NAME] and its channels. The noise is complete only if no error was reported;
// its name is right in any case.
Noise decode_noise(const std::string& name, const Place& place, const Table& table,
                   Decoder& decoder);

// Decodes one [particles.NAME]. The particles are complete only if no error was reported; their
// name is right in any case. E0144 is reported for spheres of air in air, and for water at
// wavelengths where its refractive index is not known.
Particles decode_particles(const std::string& name, const Place& place, const Table& table,
                           std::span<const Length> wavelengths, Decoder& decoder);

}  // namespace skybake::config
