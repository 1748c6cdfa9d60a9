#include "config/sections/targets.h"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <utility>

#include "config/sections/files.h"
#include "config/sections/frames.h"

namespace skybake::config {
namespace {

bool has_word(const std::vector<std::string_view>& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

using Words = std::vector<std::string_view>;

Words all_of(std::initializer_list<Words> groups) {
    Words all;
    for (const Words& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
}

constexpr PixelTypes filtered_types(PixelType::half, PixelType::float32, PixelType::unorm8);
constexpr PixelTypes volume_types(PixelType::half, PixelType::unorm8, PixelType::bc4);
constexpr PixelTypes only_half(PixelType::half);
constexpr PixelTypes only_unorm8(PixelType::unorm8);
constexpr PixelTypes only_float32(PixelType::float32);

constexpr std::string_view panorama = "longitude_latitude";
constexpr std::string_view cube = "cube";
constexpr TargetKey bare = {"ktx2_compression", "none", false};
constexpr TargetKey lights = {"lights", "true", false};  // scripts make a lamp of them
constexpr TargetKey upright = {"flip", "false"};

using Keys = std::vector<TargetKey>;

// Assets as textures that GPUs filter.
TargetUse textures_of(Words assets, FileFormat format, Words sidecars, Keys keys = {}) {
    return {.assets = std::move(assets),
            .formats = {format},
            .pixel_types = filtered_types,
            .pixel_type = PixelType::half,
            .sidecars = std::move(sidecars),
            .keys = std::move(keys)};
}

// A flipbook as a texture of three axes.
TargetUse flipbook_of(FileFormat format, Words sidecars, Keys keys = {}) {
    TargetUse use = textures_of({"flipbook"}, format, std::move(sidecars), std::move(keys));
    use.mappings = {"frames"};
    return use;
}

// The sky as a texture.
TargetUse sky_of(FileFormat format, Words sidecars, Words mappings, Keys keys = {lights}) {
    TargetUse use = textures_of({"environment"}, format, std::move(sidecars), std::move(keys));
    if (format != FileFormat::bin) use.pixel_types = floating_types;
    use.mappings = std::move(mappings);
    return use;
}

// Assets that have the one type of texel which the program reads.
TargetUse texels_of(std::string_view asset, std::vector<FileFormat> formats, PixelTypes types,
                    PixelType type, Words sidecars, Keys keys = {},
                    std::size_t light_channels = 0) {
    return {.assets = {asset},
            .formats = std::move(formats),
            .pixel_types = types,
            .pixel_type = type,
            .sidecars = std::move(sidecars),
            .keys = std::move(keys),
            .light_channels = light_channels};
}

// Densities with a place in space, as renderers load them.
TargetUse volumes_of(std::vector<FileFormat> formats, Words sidecars) {
    return {.assets = {"cloud_volume", "noise_volume"},
            .formats = std::move(formats),
            .pixel_types = floating_types,
            .sidecars = std::move(sidecars)};
}

// The sky as a panorama of renderers.
TargetUse panorama_of(Words sidecars, std::string_view mapping = panorama) {
    TargetUse use = sky_of(FileFormat::exr, std::move(sidecars), {mapping}, {upright, lights});
    use.pixel_type = {};
    return use;
}

// The sky as a Radiance panorama, which is for light of three channels.
TargetUse radiance_of(Words sidecars) {
    TargetUse use = panorama_of(std::move(sidecars));
    use.formats = {FileFormat::hdr};
    use.pixel_types = PixelTypes(PixelType::rgbe);
    use.pixel_type = PixelType::rgbe;
    use.light_channels = 3;
    return use;
}

// Rows of keys ask for this before the variables of this file would have their values.
std::vector<TargetFacts> make_targets() {
    // The groups of assets that programs treat alike: pictures of numbers, and textures of two or three axes.
    const Words tables = {"transmittance", "multiple_scattering", "sky_view",          "irradiance",
                          "phase",         "weather_map",         "forward_scattering"};
    const Words textures = {"aerial_perspective", "bruneton",  "optical_depth",  "noise_volume",
                            "cloud_light",        "occupancy", "cloud_distance", "blue_noise"};
    const Words clouds = {"cloud_volume"};
    const Words most = all_of({tables, textures, clouds});
    Words all_but_phase = most;
    std::erase(all_but_phase, "phase");
    const Words unity = {"*.unity.cs", "*.unity.cs.meta", "*.bin.meta"};
    TargetUse frames = texels_of("flipbook", {FileFormat::png, FileFormat::dds}, only_unorm8,
                                 PixelType::unorm8, {"*.unreal.py"});
    frames.mappings = {"frames"};  // SubUV materials play sheets
    TargetUse stages = volumes_of({FileFormat::vdb, FileFormat::usda}, {});
    stages.written = 2;
    TargetUse equal_areas = panorama_of({"*.pbrt"}, "equal_area");
    equal_areas.light_channels = 3;
    return {
        {Target::three,
         "three",
         "three.js: KTX2 and EXR files, each with a module that loads it",
         {textures_of(most, FileFormat::ktx2, {"*.three.js"}),
          flipbook_of(FileFormat::ktx2, {"*.three.js"}),
          sky_of(FileFormat::exr, {"*.three.js"}, {panorama}, {upright, lights}),
          sky_of(FileFormat::ktx2, {"*.three.js"}, {cube})}},
        {Target::babylon,
         "babylon",
         "Babylon.js: bare texels, each with a module that makes a texture of them",
         {textures_of(most, FileFormat::bin, {"*.babylon.js"}),
          flipbook_of(FileFormat::bin, {"*.babylon.js"}),
          sky_of(FileFormat::bin, {"*.babylon.js"}, {panorama, cube})}},
        {Target::playcanvas,
         "playcanvas",
         "PlayCanvas: HDR panoramas and DDS cubes, each with a module that loads it",
         {radiance_of({"*.playcanvas.js"}), sky_of(FileFormat::dds, {"*.playcanvas.js"}, {cube})}},
        {Target::takram,
         "takram",
         "@takram/three-atmosphere and three-clouds: bare texels and pictures, with modules",
         {texels_of("bruneton", {FileFormat::bin, FileFormat::exr}, only_half, PixelType::half,
                    {"*.takram.js"},
                    {{"convention", "takram"}, {"layout", "stack"}, {"flip", "true"}}),
          texels_of("noise_volume", {FileFormat::bin, FileFormat::png}, only_unorm8,
                    PixelType::unorm8, {"*.takram.js"}),
          texels_of("weather_map", {FileFormat::png}, only_unorm8, PixelType::unorm8,
                    {"*.takram.js"}, {{"flip", "true"}}),
          texels_of("blue_noise", {FileFormat::bin}, only_unorm8, PixelType::unorm8,
                    {"*.takram.js"})}},
        {Target::godot,
         "godot",
         "Godot 4.4 and later: DDS textures, with shader includes and scenes of fog and skies",
         {textures_of(all_of({tables, textures}), FileFormat::dds, {"*.gdshaderinc"}),
          flipbook_of(FileFormat::dds, {"*.gdshaderinc"}),
          textures_of(clouds, FileFormat::dds, {"*.gdshaderinc", "*.tscn"}),
          sky_of(FileFormat::dds, {"*.tres", "*.tscn"}, {panorama, cube})},
         true},
        {Target::unity,
         "unity",
         "Unity: bare texels, with editor scripts that make textures of them",
         {textures_of(most, FileFormat::bin, unity), flipbook_of(FileFormat::bin, unity),
          sky_of(FileFormat::bin, unity, {panorama, cube})}},
        {Target::unreal,
         "unreal",
         "Unreal 5.4 and later: DDS textures, VDB volumes and HDR skies, with Python scripts that "
         "import them",
         {{.assets = all_of({tables, textures}),
           .formats = {FileFormat::dds},
           .pixel_types = volume_types,
           .pixel_type = PixelType::half,
           .sidecars = {"*.unreal.py"}},
          frames,
          {.assets = clouds,
           .formats = {FileFormat::vdb, FileFormat::dds},
           .pixel_types = floating_types,
           .sidecars = {"*.unreal.py"}},
          radiance_of({"*.unreal.py"})}},
        {Target::bevy,
         "bevy",
         "Bevy 0.19 and later: KTX2 textures, with Rust modules that load them",
         {textures_of(all_but_phase, FileFormat::ktx2, {"*.bevy.rs"}, {bare}),
          flipbook_of(FileFormat::ktx2, {"*.bevy.rs"}, {bare}),
          // Bevy reads the texels of phase functions itself, and only those of this type.
          texels_of("phase", {FileFormat::ktx2}, only_float32, PixelType::float32, {"*.bevy.rs"},
                    {{"content", "phase"}, {"spacing", "cosine_from_back"}, bare}, 3),
          sky_of(FileFormat::ktx2, {"*.bevy.rs"}, {cube}, {bare, lights})}},
        {Target::blender,
         "blender",
         "Blender: VDB volumes and EXR environments, with scripts that build volumes and worlds",
         {volumes_of({FileFormat::vdb}, {"*.blender.py"}), panorama_of({"*.blender.py"})}},
        {Target::houdini,
         "houdini",
         "Houdini: VDB volumes and EXR environments, with Python scripts that build nodes",
         {volumes_of({FileFormat::vdb}, {"*.houdini.py"}),
          panorama_of({"*.usda", "*.houdini.py"})}},
        {Target::omniverse,
         "omniverse",
         "Omniverse and other USD programs: VDB volumes and EXR environments, with USD stages",
         {stages, panorama_of({"*.usda"})}},
        {Target::mitsuba,
         "mitsuba",
         "Mitsuba 3: vol grids and EXR environments, with parts of scenes",
         {volumes_of({FileFormat::vol}, {"*.mitsuba.xml"}), panorama_of({"*.mitsuba.xml"})}},
        {Target::pbrt,
         "pbrt",
         "pbrt-v4: NanoVDB grids and EXR environments, with parts of scenes",
         {volumes_of({FileFormat::nvdb}, {"*.pbrt"}), equal_areas}},
        {Target::cosmoscout,
         "cosmoscout",
         "CosmoScout VR: TIFF textures for Bruneton's model of csp-atmospheres, with its metadata",
         {texels_of("bruneton", {FileFormat::tif}, only_float32, PixelType::float32,
                    {"*.cosmoscout.json"}, {{"convention", "bruneton"}, {"combined", "false"}}, 3),
          texels_of("phase", {FileFormat::tif}, only_float32, PixelType::float32,
                    {"*.cosmoscout.json"}, {{"content", "phase"}, {"spacing", "angle"}}, 3)}},
        {Target::stellarium,
         "stellarium",
         "Stellarium: textures of CalcMySky, with scripts that put them into its folder",
         {texels_of("bruneton", {FileFormat::f32}, only_float32, PixelType::float32,
                    {"*.stellarium.py"}, {{"convention", "calcmysky"}, {"combined", "false"}}, 4)}},
    };
}

}  // namespace

const TargetFacts& facts_of(Target target) {
    const auto found = std::ranges::find(targets(), target, &TargetFacts::target);
    assert(found != targets().end());
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
        all.emplace_back(Target::none, "none", "no program: the files are the asset's usual ones");
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
    const bool plays = files.frames > 0;
    for (const std::string_view pattern : use->sidecars) {
        // One file that plays a sequence has no file of texels of its own name beside it.
        if (plays && pattern.starts_with("*.bin")) continue;
        names.push_back((plays ? sequence_name(name) : name) + std::string(pattern.substr(1)));
    }
    return names;
}

std::span<const TargetFacts> targets() {
    static const std::vector<TargetFacts> all = make_targets();
    return all;
}

}  // namespace skybake::config
