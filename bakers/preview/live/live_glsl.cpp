#include "bakers/preview/live/live_glsl.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/march/cloud_light.h"
#include "bakers/preview/page_text.h"
#include "bakers/preview/runtime/runtime_library.h"

namespace skybake {
namespace {

// Layers whose phase function is a table read it from their row.
AirTextures live_textures(const RuntimeAir& air) {
    AirTextures textures;
    textures.names = {table_name(air.transmittance->entry.name),
                      table_name(air.multiple_scattering->entry.name)};
    if (has_phase_rows(air.medium)) textures.names.emplace_back(phase_rows_name);
    for (std::size_t i = 0; i < air.medium.layers.size(); ++i) {
        const bool has_table = air.medium.layers[i].phase.of(0).table != nullptr;
        textures.phases.push_back(
            has_table ? fmt::format("phase_in_row({}, {}, ray, sun)", phase_rows_name, i) : "");
    }
    return textures;
}

}  // namespace

bool has_phase_rows(const SkyMedium& medium) {
    return std::any_of(medium.layers.begin(), medium.layers.end(),
                       [](const SkyLayer& layer) { return layer.phase.of(0).table != nullptr; });
}

std::string live_air_glsl(const RuntimeAir& air) {
    const Shell shell = shell_of(air.medium.air);
    const AirTextures textures = live_textures(air);
    const std::string names = fmt::format("{}", fmt::join(textures.names, ", "));
    return fmt::format(
               "#define Light {}\n#define AIR_TABLES {}\n#define SUN_TABLE {}\n"
               "#define LIGHT_TABLE {}\n",
               light_type(air), names, textures.names[0], textures.names[1]) +
           fmt::format("uniform highp sampler2D {};\nconst float R = {}, D = {};\n", names,
                       glsl_number(shell.ground_radius_km), glsl_number(shell.thickness_km)) +
           std::string(published_lookup("phase.glsl")) + std::string(embedded_text("phase.glsl")) +
           air_glsl(air, textures) + linear_srgb_glsl(air);
}

namespace {

// Returns "const TYPE NAME[n] = TYPE[n](...);" with one value for each layer of clouds.
template <class Value>
std::string cloud_values(const char* type, const char* name, const std::vector<LiveCloud>& clouds,
                         const Value& value_of) {
    std::string values;
    for (const LiveCloud& cloud : clouds) {
        values += (values.empty() ? "" : ", ") + value_of(cloud.medium);
    }
    return fmt::format("const {} {}[{}] = {}[{}]({});\n", type, name, clouds.size(), type,
                       clouds.size(), values);
}

// Returns a function of a layer, which calls `call` with the layer's own textures.
template <class Call>
std::string function_of_layers(const std::string& head, const std::vector<LiveCloud>& clouds,
                               const Call& call) {
    std::string text = head + " {\n";
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        text += fmt::format("    if (layer == {}) return {};\n", i, call(i));
    }
    return text + "    return 0.0;\n}\n";
}

std::string density_glsl(const CloudOptics& optics) {
    if (!optics.has_edge) return "max(value, 0.0)";
    return fmt::format("cloud_edge(value, {}, {})", glsl_number(optics.threshold),
                       glsl_number(optics.edge_softness));
}

std::string cloud_constants(const std::vector<LiveCloud>& clouds) {
    return cloud_values("vec3", "TILE", clouds,
                        [](const CloudMedium& medium) { return glsl_vector(medium.extent_m); }) +
           cloud_values("vec3", "VOXELS", clouds,
                        [](const CloudMedium& medium) { return glsl_size(medium.volume.size); }) +
           cloud_values("vec3", "CELLS", clouds,
                        [](const CloudMedium& medium) { return glsl_size(medium.leaps.cells); }) +
           cloud_values("float", "BASE", clouds,
                        [](const CloudMedium& medium) { return glsl_number(medium.base_m); }) +
           cloud_values("float", "EXTINCTION", clouds,
                        [](const CloudMedium& medium) {
                            return glsl_number(medium.optics.extinction_per_m);
                        }) +
           cloud_values("float", "CELL", clouds,
                        [](const CloudMedium& medium) { return glsl_number(medium.leaps.cell); }) +
           cloud_values("float", "GREATEST", clouds,
                        [](const CloudMedium& medium) {
                            return glsl_number(double{medium.variation.greatest});
                        }) +
           cloud_values("vec4", "PHASE", clouds, [](const CloudMedium& medium) {
               return glsl_phase(cloud_phase(medium.optics.particles));
           });
}

}  // namespace

std::string live_cloud_glsl(const std::vector<LiveCloud>& clouds) {
    std::string text = fmt::format("const int CLOUDS = {};\n", clouds.size());
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        text += fmt::format("uniform highp sampler3D cloud_table_{0}, cells_table_{0};\n", i);
    }
    return text + cloud_constants(clouds) + std::string(published_lookup("clouds.glsl")) +
           std::string(embedded_text("cloud_library.glsl")) +
           function_of_layers("float value_at(int layer, vec3 p)", clouds,
                              [](std::size_t i) {
                                  return fmt::format("cloud_density(cloud_table_{0}, p, TILE[{0}])",
                                                     i);
                              }) +
           function_of_layers(
               "float leap_at(int layer, vec3 p, vec3 ray)", clouds,
               [](std::size_t i) {
                   return fmt::format(
                       "cloud_leap(cells_table_{0}, CELLS[{0}], CELL[{0}], vec4(255.0, "
                       "0.0, 0.0, 0.0), VOXELS[{0}], p, ray, TILE[{0}])",
                       i);
               }) +
           function_of_layers("float density_of(int layer, float value)", clouds,
                              [&](std::size_t i) { return density_glsl(clouds[i].medium.optics); });
}

Image2<float> live_phases(const SkyMedium& medium) {
    constexpr int kPlaces = 1024;
    const int rows = static_cast<int>(std::max<std::size_t>(medium.layers.size(), 1));
    Image2<float> image(kPlaces, rows, 4);
    for (int i = 0; i < kPlaces; ++i) {
        // The sine, or the cosine, of half the angle: (x / 2^(-3/4))^2 in either half of the table.
        const double x = static_cast<double>(i) / (kPlaces - 1);
        const double root = std::min(x, 1 - x) * 1.6817928305074292;  // 2^(3/4)
        const double near = 2 * std::min(root * root * root * root, 0.5);
        const double one_minus = x < 0.5 ? near : 2 - near;
        for (std::size_t layer = 0; layer < medium.layers.size(); ++layer) {
            const Spectrum values =
                phase_values(medium.layers[layer].phase, one_minus, 2 - one_minus);
            float* to = image.texel(i, static_cast<int>(layer));
            for (std::size_t c = 0; c < 4; ++c) to[c] = static_cast<float>(values[c]);
        }
    }
    return image;
}

}  // namespace skybake
