#include "config/sections/targets.h"

#include <algorithm>
#include <cassert>

namespace skybake::config {
namespace {

using Words = std::vector<std::string_view>;

Words all_of(std::initializer_list<Words> groups) {
    Words all;
    for (const Words& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
}

bool has_word(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr PixelTypes filtered_types(PixelType::half, PixelType::float32, PixelType::unorm8);
constexpr PixelTypes volume_types(PixelType::half, PixelType::unorm8, PixelType::bc4);
constexpr PixelTypes only_half(PixelType::half);
constexpr PixelTypes only_unorm8(PixelType::unorm8);
constexpr PixelTypes only_float32(PixelType::float32);

// Rows of keys ask for this before the variables of this file would have their values.
std::vector<TargetFacts> make_targets() {
    // The groups of assets that programs treat alike: pictures of numbers, pictures of the sky, textures
    // of two or three axes, and volumes with a place in space.
    const Words tables = {"transmittance", "multiple_scattering", "sky_view", "irradiance",
                          "phase",         "weather_map"};
    const Words environments = {"environment"};
    constexpr std::string_view panorama = "longitude_latitude";
    constexpr std::string_view cube = "cube";
    const Words textures = {"aerial_perspective", "bruneton", "optical_depth", "noise_volume",
                            "cloud_light"};
    const Words clouds = {"cloud_volume"};
    const Words densities = {"cloud_volume", "noise_volume"};
    const Words occupancies = {"occupancy", "cloud_distance", "blue_noise"};
    const Words sky = all_of({tables, textures});
    const Words most = all_of({tables, textures, clouds, occupancies});
    Words all_but_phase = most;
    std::erase(all_but_phase, "phase");
    return {
        {Target::three,
         "three",
         "three.js: KTX2 and EXR files, each with a module that loads it",
         {{.assets = most,
           .formats = {FileFormat::ktx2},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.three.js"}},
          {.assets = environments,
           .formats = {FileFormat::exr},
           .pixel_types = floating_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.three.js"},
           .keys = {{"flip", "false"}},
           .mappings = {panorama}},
          {.assets = environments,
           .formats = {FileFormat::ktx2},
           .pixel_types = floating_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.three.js"},
           .mappings = {cube}}}},
        {Target::babylon,
         "babylon",
         "Babylon.js: bare texels, each with a module that makes a texture of them",
         {{.assets = most,
           .formats = {FileFormat::bin},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.babylon.js"}},
          {.assets = environments,
           .formats = {FileFormat::bin},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.babylon.js"},
           .mappings = {panorama, cube}}}},
        {Target::takram,
         "takram",
         "@takram/three-atmosphere and three-clouds: bare texels and pictures, with modules",
         {{.assets = {"bruneton"},
           .formats = {FileFormat::bin, FileFormat::exr},
           .pixel_types = only_half,
           .pixel_type = PixelType::half,
           .sidecars = {"*.takram.js"},
           .keys = {{"convention", "takram"}, {"layout", "stack"}, {"flip", "true"}}},
          {.assets = {"noise_volume"},
           .formats = {FileFormat::bin, FileFormat::png},
           .pixel_types = only_unorm8,
           .pixel_type = PixelType::unorm8,
           .sidecars = {"*.takram.js"}},
          {.assets = {"weather_map"},
           .formats = {FileFormat::png},
           .pixel_types = only_unorm8,
           .pixel_type = PixelType::unorm8,
           .sidecars = {"*.takram.js"},
           .keys = {{"flip", "true"}}},
          {.assets = {"blue_noise"},
           .formats = {FileFormat::bin},
           .pixel_types = only_unorm8,
           .pixel_type = PixelType::unorm8,
           .sidecars = {"*.takram.js"}}}},
        {Target::godot,
         "godot",
         "Godot 4.4 and later: DDS textures, with shader includes and scenes of fog",
         {{.assets = all_of({sky, occupancies}),
           .formats = {FileFormat::dds},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.gdshaderinc"}},
          {.assets = clouds,
           .formats = {FileFormat::dds},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.gdshaderinc", "*.tscn"}},
          {.assets = environments,
           .formats = {FileFormat::dds},
           .pixel_types = floating_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.tres"},
           .mappings = {panorama, cube}}},
         true},
        {Target::unity,
         "unity",
         "Unity: bare texels, with editor scripts that make textures of them",
         {{.assets = most,
           .formats = {FileFormat::bin},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.unity.cs", "*.unity.cs.meta", "*.bin.meta"}},
          {.assets = environments,
           .formats = {FileFormat::bin},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.unity.cs", "*.unity.cs.meta", "*.bin.meta"},
           .mappings = {panorama, cube}}}},
        {Target::unreal,
         "unreal",
         "Unreal 5.3 and later: DDS textures and VDB volumes, with Python scripts that import them",
         {{.assets = all_of({sky, occupancies}),
           .formats = {FileFormat::dds},
           .pixel_types = volume_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.unreal.py"}},
          {.assets = clouds,
           .formats = {FileFormat::vdb, FileFormat::dds},
           .pixel_types = floating_types,
           .sidecars = {"*.unreal.py"}}}},
        {Target::bevy,
         "bevy",
         "Bevy: KTX2 textures, with Rust modules that load them",
         {{.assets = all_but_phase,
           .formats = {FileFormat::ktx2},
           .pixel_types = filtered_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.bevy.rs"},
           .keys = {{"ktx2_compression", "none", false}}},
          // Bevy reads the texels of phase functions itself, and only those of this type.
          {.assets = {"phase"},
           .formats = {FileFormat::ktx2},
           .pixel_types = only_float32,
           .pixel_type = PixelType::float32,
           .sidecars = {"*.bevy.rs"},
           .keys = {{"content", "phase"},
                    {"spacing", "cosine_from_back"},
                    {"ktx2_compression", "none", false}},
           .light_channels = 3},
          {.assets = environments,
           .formats = {FileFormat::ktx2},
           .pixel_types = floating_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.bevy.rs"},
           .keys = {{"ktx2_compression", "none", false}},
           .mappings = {cube}}}},
        {Target::blender,
         "blender",
         "Blender: VDB volumes and EXR environments, with scripts that build volumes and worlds",
         {{.assets = densities,
           .formats = {FileFormat::vdb},
           .pixel_types = floating_types,
           .sidecars = {"*.blender.py"}},
          {.assets = environments,
           .formats = {FileFormat::exr},
           .pixel_types = floating_types,
           .sidecars = {"*.blender.py"},
           .keys = {{"flip", "false"}},
           .mappings = {panorama}}}},
        {Target::houdini,
         "houdini",
         "Houdini: VDB volumes and EXR environments, with Python scripts that build nodes",
         {{.assets = densities,
           .formats = {FileFormat::vdb},
           .pixel_types = floating_types,
           .sidecars = {"*.houdini.py"}},
          {.assets = environments,
           .formats = {FileFormat::exr},
           .pixel_types = floating_types,
           .sidecars = {"*.houdini.py"},
           .keys = {{"flip", "false"}},
           .mappings = {panorama}}}},
        {Target::omniverse,
         "omniverse",
         "Omniverse and other USD programs: VDB volumes and EXR environments, with USD stages",
         {{.assets = densities,
           .formats = {FileFormat::vdb, FileFormat::usda},
           .pixel_types = floating_types,
           .written = 2},
          {.assets = environments,
           .formats = {FileFormat::exr},
           .pixel_types = floating_types,
           .sidecars = {"*.usda"},
           .keys = {{"flip", "false"}},
           .mappings = {panorama}}}},
        {Target::mitsuba,
         "mitsuba",
         "Mitsuba 3: vol grids and EXR environments, with parts of scenes",
         {{.assets = densities,
           .formats = {FileFormat::vol},
           .pixel_types = floating_types,
           .sidecars = {"*.mitsuba.xml"}},
          {.assets = environments,
           .formats = {FileFormat::exr},
           .pixel_types = floating_types,
           .sidecars = {"*.mitsuba.xml"},
           .keys = {{"flip", "false"}},
           .mappings = {panorama}}}},
        {Target::pbrt,
         "pbrt",
         "pbrt-v4: NanoVDB grids, with parts of scenes",
         {{.assets = densities,
           .formats = {FileFormat::nvdb},
           .pixel_types = floating_types,
           .sidecars = {"*.pbrt"}}}},
        {Target::cosmoscout,
         "cosmoscout",
         "CosmoScout VR: TIFF textures for Bruneton's model of csp-atmospheres, with its metadata",
         {{.assets = {"bruneton"},
           .formats = {FileFormat::tif},
           .pixel_types = only_float32,
           .pixel_type = PixelType::float32,
           .sidecars = {"*.cosmoscout.json"},
           .keys = {{"convention", "bruneton"}, {"combined", "false"}},
           .light_channels = 3},
          {.assets = {"phase"},
           .formats = {FileFormat::tif},
           .pixel_types = only_float32,
           .pixel_type = PixelType::float32,
           .sidecars = {"*.cosmoscout.json"},
           .keys = {{"content", "phase"}, {"spacing", "angle"}},
           .light_channels = 3}}},
        {Target::stellarium,
         "stellarium",
         "Stellarium: textures of CalcMySky, with scripts that put them into its folder",
         {{.assets = {"bruneton"},
           .formats = {FileFormat::f32},
           .pixel_types = only_float32,
           .pixel_type = PixelType::float32,
           .sidecars = {"*.stellarium.py"},
           .keys = {{"convention", "calcmysky"}, {"combined", "false"}},
           .light_channels = 4}}},
    };
}

}  // namespace

std::span<const TargetFacts> targets() {
    static const std::vector<TargetFacts> all = make_targets();
    return all;
}

const TargetFacts& facts_of(Target target) {
    const auto all = targets();
    const auto found = std::find_if(all.begin(), all.end(), [target](const TargetFacts& facts) {
        return facts.target == target;
    });
    assert(found != all.end());
    return *found;
}

const TargetUse* find_use(const TargetFacts& target, std::string_view asset,
                          std::string_view mapping) {
    const TargetUse* first = nullptr;
    for (const TargetUse& use : target.uses) {
        if (!has_word(use.assets, asset)) continue;
        if (has_word(use.mappings, mapping)) return &use;
        if (first == nullptr) first = &use;
    }
    return first;
}

std::span<const Choice> target_choices() {
    static const std::vector<Choice> choices = [] {
        std::vector<Choice> all;
        for (const TargetFacts& facts : targets()) {
            all.emplace_back(facts.target, facts.name, facts.documentation);
        }
        return all;
    }();
    return choices;
}

std::vector<std::string> sidecar_names(const AssetFiles& files, std::string_view asset,
                                       const std::string& name) {
    std::vector<std::string> names;
    if (files.target == Target::none) return names;
    const TargetUse* use = find_use(facts_of(files.target), asset);
    if (use == nullptr) return names;
    for (const std::string_view pattern : use->sidecars) {
        names.push_back(name + std::string(pattern.substr(1)));
    }
    return names;
}

}  // namespace skybake::config
