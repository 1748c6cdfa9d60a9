#include "bakers/preview/runtime/runtime_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/finish_volume.h"
#include "bakers/march/cloud_light.h"
#include "bakers/march/layer_march.h"
#include "bakers/preview/page_text.h"
#include "bakers/render/cloud_view.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "config/assets/phase.h"
#include "config/recipe/asset_parameters.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

bool has_section(const config::Recipe& recipe, const PreviewAsset& asset) {
    const auto& bakes = recipe.parameters.bakes;
    return std::ranges::find(bakes, asset.entry.name, &config::Bake::name) != bakes.end();
}

// Returns the section of the first asset that the folder holds and that `is_wanted`, or null. A recipe
// may have more assets than were baked.
template <class Section, class Condition>
const config::Bake* baked_section(const PreviewAssets& assets, const Condition& is_wanted) {
    for (const PreviewAsset& asset : assets.assets) {
        const config::Bake* bake = config::own_bake(assets.recipe->parameters, asset.entry.name);
        const auto* section = bake != nullptr ? bake->find<Section>() : nullptr;
        if (section != nullptr && is_wanted(*section)) return bake;
    }
    return nullptr;
}

// --- Phase functions -----------------------------------------------------------------------------

// Returns the bake of a table of the phase function of a layer.
const config::Bake* phase_bake(const PreviewAssets& assets, const std::string& layer) {
    return baked_section<config::PhaseBake>(assets, [&](const config::PhaseBake& phase) {
        return phase.layer == layer && phase.content == config::PhaseContent::phase;
    });
}

// Returns the textures of the air, or the name of a layer whose phase function is in no table.
struct FoundTextures {
    AirTextures textures;
    std::string missing;
};

FoundTextures air_textures(const RuntimeAir& air, const PreviewAssets& assets) {
    FoundTextures found;
    AirTextures& textures = found.textures;
    textures.names = {table_name(air.transmittance->entry.name),
                      table_name(air.multiple_scattering->entry.name)};
    for (const SkyLayer& layer : air.medium.layers) {
        textures.phases.emplace_back();
        if (!layer.scatters || layer.phase.of(0).table == nullptr) continue;
        const config::Bake* bake = phase_bake(assets, layer.name);
        if (bake == nullptr) {
            found.missing = layer.name;
            continue;
        }
        textures.names.push_back(table_name(bake->name));
        textures.phases.back() =
            fmt::format("{}({}, ray, sun)", glsl_name(bake->name), textures.names.back());
    }
    return found;
}

// --- Clouds --------------------------------------------------------------------------------------

// A layer of clouds as functions march it.
struct RuntimeCloud {
    const config::Bake* volume = nullptr;
    const config::Bake* leaps = nullptr;  // an occupancy that tells how far a ray may leap
    config::Cloud cloud;                  // as its voxels span it
    std::array<int, 3> voxels{};
    double through = 1;  // the share of diffuse light that passes the layer
};

const config::Bake* leaps_of(const PreviewAssets& assets, const std::string& volume) {
    return baked_section<config::OccupancyBake>(
        assets, [&](const config::OccupancyBake& occupancy) {
            return occupancy.of == volume &&
                   std::ranges::find(occupancy.contents, config::OccupancyContent::leap) !=
                       occupancy.contents.end();
        });
}

// Covered columns count as if they had the mean of their depths.
double share_through(const ManifestAsset& volume, const config::Cloud& cloud) {
    const double cover = number_named(volume.details, covered_columns).value_or(1);
    if (cover == 0) return 1;
    const double depth = cloud.extinction_scale.per_meter * cloud.extent[2].meters *
                         volume.levels.front().statistics.front().mean / cover;
    return 1 - cover + cover * 2 / (2 + backward_share(cloud_phase(cloud.particles)) * depth);
}

// Returns the first volume of one channel of each cloud.
std::vector<RuntimeCloud> runtime_clouds(const PreviewAssets& assets) {
    std::vector<RuntimeCloud> clouds;
    const config::Parameters& parameters = assets.recipe->parameters;
    std::set<std::string> seen;
    for (const PreviewAsset& asset : assets.assets) {
        const config::Bake* bake = config::own_bake(parameters, asset.entry.name);
        const auto* volume = bake != nullptr ? bake->find<config::CloudVolumeBake>() : nullptr;
        if (volume == nullptr || asset.entry.channels.size() != 1) continue;
        if (!seen.insert(volume->cloud).second) continue;
        const config::Cloud cloud = spanned_cloud(parameters, *volume);
        clouds.push_back({bake, leaps_of(assets, bake->name), cloud, volume->size,
                          share_through(asset.entry, cloud)});
    }
    return clouds;
}

// The names of functions that march it begin so: those of lookups begin with baked_.
std::string march_name(const RuntimeCloud& cloud) {
    return "march_" + glsl_name(cloud.volume->name).substr(std::string_view("baked_").size());
}

std::vector<std::string> textures_of(const RuntimeCloud& cloud) {
    std::vector<std::string> names = {table_name(cloud.volume->name)};
    if (cloud.leaps != nullptr) names.push_back(table_name(cloud.leaps->name));
    return names;
}

std::string declared(const std::vector<std::string>& names) {
    return fmt::format("sampler3D {}", fmt::join(names, ", sampler3D "));
}

// What a march reads of a cloud at a place p, as GLSL.
struct CloudReading {
    std::string density;
    std::string leap;  // how far a ray may go on from p without meeting cloud, in metres
    std::string
        sum;  // the body of a sum of densities times metres over samples at p + ray * stride * i
};

CloudReading reading_of(const RuntimeCloud& cloud) {
    const std::vector<std::string> textures = textures_of(cloud);
    const bool at_runtime = cloud.cloud.threshold_at == config::ThresholdAt::runtime;
    CloudReading reading;
    reading.density = fmt::format("{}{}({}, p)", glsl_name(cloud.volume->name),
                                  at_runtime ? "_density" : "", textures[0]);
    const std::string leaps = cloud.leaps != nullptr ? glsl_name(cloud.leaps->name) : "";
    const std::string given = fmt::format("{}", fmt::join(textures, ", "));
    reading.leap =
        leaps.empty() ? "0.0" : fmt::format("{}_leap({}, p, ray)", leaps, textures.back());
    if (!leaps.empty() && !at_runtime) {
        reading.sum = fmt::format("return {}_march({}, start, ray, stride, count);", leaps, given);
    } else {
        reading.sum = fmt::format(
            "float sum = 0.0, i = 0.0;\n    while (i < float(count)) {{\n"
            "        vec3 p = start + ray * (stride * i);\n        sum += {};\n        i += 1.0;\n "
            "   }}\n"
            "    return sum * stride;",
            reading.density);
    }
    return reading;
}

// The steps and the reach of previews.
MarchSteps steps_of(const RuntimeCloud& cloud) {
    CloudMedium medium;
    medium.volume.size = cloud.voxels;
    medium.extent_m = extent_m_of(cloud.cloud);
    medium.optics.extinction_per_m = cloud.cloud.extinction_scale.per_meter;
    medium.repeats = true;
    return usual_steps(medium, {});
}

std::string layer_glsl(const RuntimeCloud& cloud) {
    const MarchSteps steps = steps_of(cloud);
    const std::vector<std::string> textures = textures_of(cloud);
    const CloudReading reading = reading_of(cloud);
    const CloudPhase phase = cloud_phase(cloud.cloud.particles);
    std::string text(embedded_text("cloud_layer_library.glsl"));
    for (const auto& [word, by] :
         {std::pair{"NAME_", march_name(cloud) + "_"},
          std::pair{"BAKED_", glsl_name(cloud.volume->name) + "_"},
          std::pair{"STEP_M\\b", glsl_number(steps.step_m)},
          std::pair{"BACKWARD\\b", glsl_number(backward_share(phase))},
          std::pair{"PHASE\\b", glsl_phase(phase)},
          std::pair{"THROUGH\\b", glsl_number(cloud.through)},
          std::pair{"REACH_M\\b", glsl_number(steps.reach_m)}, std::pair{"SUM;", reading.sum},
          std::pair{"DENSITY\\b", reading.density}, std::pair{"LEAP\\b", reading.leap},
          std::pair{"LAYER\\b", declared(textures)},
          std::pair{"LAYER_GIVEN\\b", fmt::format("{}", fmt::join(textures, ", "))}}) {
        text = std::regex_replace(text, std::regex(fmt::format("\\b{}", word)), by);
    }
    return text;
}

// Returns functions that march all clouds of the recipe.
std::string clouds_glsl(const std::vector<RuntimeCloud>& clouds) {
    if (clouds.empty()) return "";
    std::string text(embedded_text("cloud_library.glsl"));
    std::vector<std::string> textures;
    std::vector<std::string> calls;
    for (const RuntimeCloud& cloud : clouds) {
        text += "\n" + layer_glsl(cloud);
        const std::vector<std::string> own = textures_of(cloud);
        textures.insert(textures.end(), own.begin(), own.end());
        calls.push_back(fmt::format("{}_seen(GIVEN, {}, camera_m, ray, sun, reach_m, pixel, noise)",
                                    march_name(cloud), fmt::join(own, ", ")));
    }
    std::string value = calls[0];
    for (std::size_t i = 1; i < calls.size(); ++i) {
        value = fmt::format("cloud_both({},\n        {})", value, calls[i]);
    }
    return text + fmt::format(
                      "\n// What a camera sees of the clouds, up to `reach_m`: light + through * "
                      "what is behind them. `noise`, in\n"
                      "// [0, 1) and another for each pixel, moves the samples of a pixel, which "
                      "is `pixel` radians wide.\n"
                      "Clouds skybake_clouds(TABLES, {0}, vec3 camera_m, vec3 ray, vec3 sun, float "
                      "reach_m,\n"
                      "        float pixel, float noise) {{\n    return {1};\n}}\n\n"
                      "// Clouds before the sky.\n"
                      "Light skybake_view(TABLES, {0}, vec3 camera_m, vec3 ray, vec3 sun, float "
                      "pixel, float noise) {{\n"
                      "    Clouds clouds = skybake_clouds(GIVEN, {2}, camera_m, ray, sun, "
                      "1000000.0, pixel, noise);\n"
                      "    if (clouds.through <= 0.001) return clouds.light;\n"
                      "    return clouds.light + clouds.through * skybake_sky(GIVEN, camera_m, "
                      "ray, sun, pixel);\n}}\n",
                      declared(textures), value, fmt::join(textures, ", "));
}

// Returns an expression for linear sRGB of the channels of `light`.
std::string screen_glsl(const ScreenColor& screen, int channels) {
    Image2<float> units(channels, 1, channels);
    for (int c = 0; c < channels; ++c) units.texel(c, 0)[c] = 1;
    const Image2<float> columns = screen.shown(units);
    std::vector<std::string> terms;
    for (int c = 0; c < channels; ++c) {
        const float* to = columns.texel(c, 0);
        terms.push_back(
            fmt::format("light.{} * {}", "xyzw"[c], glsl_vector({to[0], to[1], to[2]})));
    }
    return fmt::format("{}", fmt::join(terms, " +\n           "));
}

// Returns linear_srgb with examples/lookups/film.glsl, and a function that calls both.
std::string film_glsl(const RuntimeAir& air) {
    return linear_srgb_glsl(air) + "\n" + std::string(published_lookup("film.glsl")) +
           fmt::format(
               "\n// Returns what a screen shows, sRGB, of light that is multiplied by the "
               "exposure, as previews do.\n"
               "vec3 shown_by_film({} light) {{ return "
               "srgb_of(film(in_gamut(linear_srgb(light)))); }}\n",
               light_type(air));
}

}  // namespace

std::optional<RuntimeAir> runtime_air(const config::Recipe& recipe, const PreviewAssets& assets,
                                      int threads) {
    const PreviewAsset* transmittance = assets.of_kind("transmittance");
    const PreviewAsset* scattering = assets.of_kind("multiple_scattering");
    if (transmittance == nullptr || scattering == nullptr || !has_section(recipe, *transmittance) ||
        !has_section(recipe, *scattering)) {
        return std::nullopt;
    }
    auto tables = make_sky_tables(*transmittance, scattering);
    if (!tables.value) return std::nullopt;
    RuntimeAir air{&recipe, transmittance, scattering,
                   make_sky_medium(recipe.parameters.atmosphere), std::move(*tables.value)};
    air.tables.screen = daylight_screen({air.medium, air.tables}, threads);
    return air;
}

bool has_colours(const std::optional<RuntimeAir>& air) {
    return air && (air->medium.air.channels == 3 || air->medium.air.channels == 4);
}

std::string linear_srgb_glsl(const RuntimeAir& air) {
    return glsl_comment(fmt::format("Returns light in the tables' channels as linear sRGB; {}.",
                                    air.tables.screen.words())) +
           fmt::format("vec3 linear_srgb({} light) {{\n    return {};\n}}\n", light_type(air),
                       screen_glsl(air.tables.screen, air.medium.air.channels));
}

std::string glsl_phase(const CloudPhase& phase) {
    return fmt::format("vec4({}, {}, {}, {})", glsl_number(phase.hg_g), glsl_number(phase.draine_g),
                       glsl_number(phase.draine_alpha), glsl_number(phase.draine_share));
}

std::string runtime_library(const PreviewAssets& assets, int threads) {
    const auto air = assets.recipe ? runtime_air(*assets.recipe, assets, threads) : std::nullopt;
    if (!has_colours(air)) {
        const bool has_tables =
            assets.of_kind("transmittance") && assets.of_kind("multiple_scattering");
        return !has_tables ? ""
                           : glsl_comment(
                                 "There is no skybake_sky: it needs tables of three or four "
                                 "wavelengths which can be read and whose recipe is known.");
    }
    const FoundTextures found = air_textures(*air, assets);
    if (!found.missing.empty()) {
        return glsl_comment(
                   fmt::format("There is no skybake_sky: the phase function of the layer "
                               "`{0}` is a table. Bake it by asset = \"phase\" with layer = "
                               "\"{0}\".",
                               found.missing)) +
               "\n" + film_glsl(*air);
    }
    const std::string text = std::string(embedded_text("view_library.glsl")) + "\n" +
                             clouds_glsl(runtime_clouds(assets));
    return air_glsl(*air, found.textures) + "\n" + with_textures(text, *air, found.textures.names) +
           "\n" + film_glsl(*air);
}

}  // namespace skybake
