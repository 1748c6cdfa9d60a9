#include "bakers/preview/live/live_glsl.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/assets/registry/registry.h"
#include "bakers/march/cloud_light.h"
#include "bakers/render/sky_view.h"
#include "bakers/render/sun_disc.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

std::string light_of(const Spectrum& value, int channels) {
    std::string text = "Light(";
    for (int c = 0; c < channels; ++c) {
        text += (c > 0 ? ", " : "") + glsl_number(value[static_cast<std::size_t>(c)]);
    }
    return text + ")";
}

// Returns "const Light NAME[n] = Light[n](...);" with `of_each` values for each layer.
template <class Values>
std::string layer_values(const std::string& name, const SkyMedium& medium, std::size_t of_each,
                         const Values& values_of) {
    std::vector<std::string> values;
    for (const SkyLayer& layer : medium.layers) {
        for (const Spectrum& value : values_of(layer)) {
            values.push_back(light_of(value, medium.air.channels));
        }
    }
    if (values.empty()) values.resize(of_each, "Light(0.0)");
    return fmt::format("const Light {}[{}] = Light[{}](\n    {});\n", name, values.size(),
                       values.size(), fmt::join(values, ",\n    "));
}

// Returns the coefficient of scattering times the phase function's moments up to a degree.
std::vector<Spectrum> scattering_of(const SkyLayer& layer, int degree) {
    std::vector<Spectrum> moments = scattered_moments(layer, degree);
    for (Spectrum& moment : moments) moment *= full_coefficients(layer).scattering_per_km;
    return moments;
}

std::vector<Spectrum> extinction_of(const SkyLayer& layer) {
    return {full_coefficients(layer).extinction_per_km};
}

// Returns density_at, and the pieces of layers that are linear piece by piece.
std::string densities(const SkyMedium& medium) {
    std::string pieces;
    std::string cases;
    std::size_t count = 0;
    for (std::size_t i = 0; i < medium.layers.size(); ++i) {
        const Medium& alone = medium.layers[i].alone;
        if (!alone.exponential_layers.empty()) {
            cases += fmt::format("    if (layer == {}) return exp(h * {});\n", i,
                                 glsl_number(-1 / alone.exponential_layers[0].scale_height_km));
            continue;
        }
        const std::vector<LinearPiece>& own = alone.piecewise_layers.front().pieces;
        for (const LinearPiece& piece : own) {
            pieces += fmt::format("{}vec4({}, {}, {}, {})", pieces.empty() ? "" : ",\n    ",
                                  glsl_number(piece.bottom_km), glsl_number(piece.top_km),
                                  glsl_number(piece.density_at_bottom),
                                  glsl_number(piece.density_per_km));
        }
        cases += fmt::format("    if (layer == {}) return density_of_pieces({}, {}, h);\n", i,
                             count, count + own.size());
        count += own.size();
    }
    if (count == 0)
        return "float density_at(int layer, float h) {\n" + cases + "    return 0.0;\n}\n";
    return fmt::format(
        "// Altitudes of bottom and top in km, the density at the bottom, and its slope.\n"
        "const vec4 PIECES[{0}] = vec4[{0}](\n    {1});\n"
        "float density_of_pieces(int first, int end, float h) {{\n"
        "    for (int i = first; i < end; ++i) {{\n"
        "        if (h >= PIECES[i].x && h < PIECES[i].y) return PIECES[i].z + PIECES[i].w * (h - "
        "PIECES[i].x);\n"
        "    }}\n    return 0.0;\n}}\n"
        "float density_at(int layer, float h) {{\n{2}    return 0.0;\n}}\n",
        count, pieces, cases);
}

// Returns the lookup of a table under that name.
std::string lookup_of(const config::Recipe& recipe, const PreviewAsset& asset,
                      const std::string& name) {
    const config::Bake& bake = config::bake_named(recipe.parameters, asset.entry.name);
    return lookup_glsl(
        baker_of(bake).lookup(recipe.parameters, bake,
                              {asset.entry.mapping, asset.entry.size, asset.entry.channels.size()}),
        name);
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

// Returns the exponents of the sun's darkening towards its limb.
std::string limb_glsl(const SkyTables& tables, int channels) {
    Spectrum exponents{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        exponents[c] = limb_exponent(wavelength_nm_of(tables, c));
    }
    return fmt::format("const Light LIMB = {};\n", light_of(exponents, channels));
}

}  // namespace

std::string live_air_glsl(const LiveLight& light) {
    const Medium& air = light.medium.air;
    const Shell shell = shell_of(air);
    const int degree = light.tables.degree;
    return fmt::format("#define Light vec{}\n", air.channels) +
           fmt::format("const float R = {}, D = {};\n", glsl_number(shell.ground_radius_km),
                       glsl_number(shell.thickness_km)) +
           fmt::format("const int LAYERS = {}, DEGREE = {};\n",
                       std::max<std::size_t>(light.medium.layers.size(), 1), degree) +
           fmt::format("const Light ALBEDO = {};\n", light_of(air.ground_albedo, air.channels)) +
           limb_glsl(light.tables, air.channels) +
           layer_values("SCATTERING", light.medium, static_cast<std::size_t>(degree) + 1,
                        [&](const SkyLayer& layer) { return scattering_of(layer, degree); }) +
           layer_values("EXTINCTION_OF_AIR", light.medium, 1, extinction_of) +
           densities(light.medium) +
           lookup_of(*light.recipe, *light.transmittance, "baked_transmittance") + "\n" +
           lookup_of(*light.recipe, *light.multiple_scattering, "baked_multiple_scattering") +
           "\n" + std::string(published_lookup("phase")) +
           fmt::format(
               "uniform highp sampler2D transmittance_table, scattering_table;\n"
               "Light sun_through(float h, float mu) {{ return {}; }}\n"
               "Light light_moment(float h, float mu, int part) {{\n"
               "    return baked_multiple_scattering(scattering_table, h, mu{});\n}}\n",
               light.tables.holds_optical_depth
                   ? "exp(-baked_transmittance(transmittance_table, h, mu))"
                   : "baked_transmittance(transmittance_table, h, mu)",
               degree > 0 ? ", part" : "") +
           fmt::format("vec3 shown(Light light) {{ return {}; }}\n",
                       screen_glsl(light.tables.screen, air.channels));
}

std::string film_glsl(const LiveLight& light) {
    const int channels = light.medium.air.channels;
    return std::string(published_lookup("film")) + "\n" +
           glsl_comment(fmt::format(
               "Returns what a screen shows, sRGB, of the light that this air sends, as previews "
               "do: "
               "`light`, in the tables' channels, is multiplied by the exposure before; {}.",
               light.tables.screen.words())) +
           fmt::format(
               "vec3 shown_by_film(vec{} light) {{\n    return srgb_of(film(in_gamut({})));\n}}\n",
               channels, screen_glsl(light.tables.screen, channels));
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
    const DropletPhase drops = droplet_phase(kDropletDiameter_um);
    return cloud_values("vec3", "TILE", clouds,
                        [](const CloudMedium& medium) { return glsl_vector(medium.extent_m); }) +
           cloud_values("vec3", "VOXELS", clouds,
                        [](const CloudMedium& medium) {
                            const std::array<int, 3>& size = medium.volume.size;
                            return glsl_vector({double(size[0]), double(size[1]), double(size[2])});
                        }) +
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
           fmt::format("const vec4 DROPLETS = vec4({}, {}, {}, {});\n", glsl_number(drops.hg_g),
                       glsl_number(drops.draine_g), glsl_number(drops.draine_alpha),
                       glsl_number(drops.draine_share));
}

}  // namespace

std::string live_cloud_glsl(const std::vector<LiveCloud>& clouds) {
    std::string text = fmt::format("const int CLOUDS = {};\n", clouds.size());
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        text += fmt::format("uniform highp sampler3D cloud_table_{0}, cells_table_{0};\n", i);
    }
    return text + cloud_constants(clouds) + std::string(published_lookup("clouds")) +
           function_of_layers("float value_at(int layer, vec3 p)", clouds,
                              [](std::size_t i) {
                                  return fmt::format("cloud_density(cloud_table_{0}, p, TILE[{0}])",
                                                     i);
                              }) +
           function_of_layers("float leap_at(int layer, vec3 p, vec3 ray)", clouds,
                              [](std::size_t i) {
                                  return fmt::format(
                                      "cloud_leap(cloud_table_{0}, cells_table_{0}, CELL[{0}], "
                                      "vec4(255.0, 0.0, 0.0, 0.0), p, ray, TILE[{0}])",
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
