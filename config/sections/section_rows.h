// The rows of all sections but those of [bake.NAME] (config/assets) and [sweep] (config/sweep).
// Whoever adds a key adds its row, and a member of the same name to the section's struct;
// everything else follows.
#pragma once

#include <span>

#include "config/fields/row.h"
#include "config/sections/atmosphere.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "config/sections/parameters.h"
#include "config/sections/particles.h"
#include "config/sections/scene.h"

namespace skybake::config {

using RootField = Row<Parameters>;
using AtmosphereField = Row<Atmosphere>;
using LayerField = Row<Layer>;
using SceneField = Row<Scene>;
using ParticlesField = Row<Particles>;
using NoiseField = Row<Noise>;
using NoiseChannelField = Row<NoiseChannel>;
using CloudField = Row<Cloud>;
using HeightProfileField = Row<HeightProfile>;
using CloudMapField = Row<CloudMap>;
using TowerField = Row<Tower>;
using TowerScatterField = Row<TowerScatter>;

std::span<const RootField> root_fields();
std::span<const AtmosphereField> atmosphere_fields();
std::span<const LayerField> layer_fields();
std::span<const SceneField> scene_fields();
std::span<const ParticlesField> particles_fields();
std::span<const NoiseField> noise_fields();
std::span<const NoiseChannelField> noise_channel_fields();
std::span<const CloudField> cloud_fields();
std::span<const HeightProfileField> height_profile_fields();
std::span<const CloudMapField> coverage_map_fields();
std::span<const CloudMapField> type_map_fields();
std::span<const TowerField> tower_fields();
std::span<const TowerScatterField> tower_scatter_fields();

}  // namespace skybake::config
