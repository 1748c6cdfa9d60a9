#include "bakers/preview/runtime/runtime_air.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <regex>
#include <span>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/preview/page_text.h"
#include "bakers/render/sky_view.h"
#include "bakers/render/sun_disc.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

// Light in all channels of the tables, as GLSL.
std::string light_glsl(const Spectrum& value, int channels) {
    std::vector<std::string> values;
    for (int c = 0; c < channels; ++c) {
        values.push_back(glsl_number(value[static_cast<std::size_t>(c)]));
    }
    return fmt::format("Light({})", fmt::join(values, ", "));
}

// --- Layers --------------------------------------------------------------------------------------

// Returns nested conditions that find the piece at an altitude h.
std::string pieces_glsl(std::span<const LinearPiece> pieces, int depth) {
    const std::string indent(static_cast<std::size_t>(4 * depth), ' ');
    if (pieces.size() > 1) {
        const std::size_t half = pieces.size() / 2;
        return fmt::format("{0}if (h < {1}) {{\n{2}{0}}} else {{\n{3}{0}}}\n", indent,
                           glsl_number(pieces[half].bottom_km),
                           pieces_glsl(pieces.first(half), depth + 1),
                           pieces_glsl(pieces.subspan(half), depth + 1));
    }
    const LinearPiece& only = pieces[0];
    return fmt::format("{}if (h >= {} && h < {}) density = {} + {} * (h - {});\n", indent,
                       glsl_number(only.bottom_km), glsl_number(only.top_km),
                       glsl_number(only.density_at_bottom), glsl_number(only.density_per_km),
                       glsl_number(only.bottom_km));
}

std::string density_function(const SkyLayer& layer, std::size_t i) {
    const Medium& alone = layer.alone;
    std::string body;
    if (!alone.exponential_layers.empty()) {
        body = fmt::format("    return exp(h * {});\n",
                           glsl_number(-1 / alone.exponential_layers.front().scale_height_km));
    } else {
        body = fmt::format("    float density = 0.0;\n{}    return density;\n",
                           pieces_glsl(alone.piecewise_layers.front().pieces, 1));
    }
    return fmt::format(
        "{}float air_density_{}(float h) {{\n{}}}\n\n",
        glsl_comment(fmt::format("The density of the layer `{}` at h km.", layer.name)), i, body);
}

// Returns the sum over layers of density times a value, which is empty where it is 0.
template <class Values>
std::string sum_over_layers(const SkyMedium& medium, const Values& value_of) {
    std::vector<std::string> terms;
    for (std::size_t i = 0; i < medium.layers.size(); ++i) {
        if (const std::string value = value_of(medium.layers[i], i); !value.empty()) {
            terms.push_back(fmt::format("d{} * {}", i, value));
        }
    }
    if (terms.empty()) terms.emplace_back("Light(0.0)");
    return fmt::format("{}", fmt::join(terms, " +\n        "));
}

// The coefficient of scattering times the phase function's moment of a degree, per km.
std::string scattering_glsl(const SkyLayer& layer, int degree, int channels) {
    if (!layer.scatters) return "";
    const Spectrum moment = scattered_moments(layer, degree)[static_cast<std::size_t>(degree)];
    if (moment == Spectrum{}) return "";
    return light_glsl(moment * full_coefficients(layer).scattering_per_km, channels);
}

std::string closed_phase(const PhaseFunction& phase) {
    return fmt::format("air_phase({}, {}, {}, ahead, back)", glsl_number(phase.constant),
                       glsl_number(phase.quadratic), glsl_number(phase.g));
}

bool is_closed(const AirTextures& textures, std::size_t layer) {
    return textures.phases[layer].empty();
}

// The phase functions of all layers, which are the same all along a ray.
std::string phases_glsl(const SkyMedium& medium, const AirTextures& textures) {
    std::string members;
    std::string values;
    for (std::size_t i = 0; i < medium.layers.size(); ++i) {
        const SkyLayer& layer = medium.layers[i];
        if (!layer.scatters) continue;
        members += fmt::format("    {} of_{};\n", is_closed(textures, i) ? "float" : "Light", i);
        values += fmt::format(
            "    phases.of_{} = {};\n", i,
            is_closed(textures, i) ? closed_phase(layer.phase.of(0)) : textures.phases[i]);
    }
    if (members.empty()) {
        members = "    float of_none;\n";
        values = "    phases.of_none = 0.0;\n";
    }
    const bool needs_cosines = values.find("air_phase(") != std::string::npos;
    return fmt::format(
        "// The phase functions of the air's layers between a ray and the sun, in 1/sr.\n"
        "struct AirPhases {{\n{}}};\n\n"
        "AirPhases air_phases(PHASE_TABLES vec3 ray, vec3 sun) {{\n{}"
        "    AirPhases phases;\n{}    return phases;\n}}\n\n",
        members,
        needs_cosines ? "    float ahead = 0.5 * dot(ray - sun, ray - sun), back = 0.5 * dot(ray "
                        "+ sun, ray + sun);\n"
                      : "",
        values);
}

std::string point_glsl(const RuntimeAir& air) {
    const SkyMedium& medium = air.medium;
    const int channels = medium.air.channels;
    std::string members;
    std::string values;
    for (int l = 0; l <= air.tables.degree; ++l) {
        members += fmt::format("    Light scattering_{};\n", l);
        values += fmt::format("    here.scattering_{} = {};\n", l,
                              sum_over_layers(medium, [&](const SkyLayer& layer, std::size_t) {
                                  return scattering_glsl(layer, l, channels);
                              }));
    }
    std::string densities;
    for (std::size_t i = 0; i < medium.layers.size(); ++i) {
        densities += fmt::format("    float d{0} = air_density_{0}(h);\n", i);
    }
    const std::string extinction = sum_over_layers(medium, [&](const SkyLayer& layer, std::size_t) {
        return light_glsl(full_coefficients(layer).extinction_per_km, channels);
    });
    const std::string to_eye = sum_over_layers(medium, [&](const SkyLayer& layer, std::size_t i) {
        if (!layer.scatters) return std::string();
        return fmt::format("phases.of_{} * {}", i, scattering_glsl(layer, 0, channels));
    });
    const std::string extinction_function = fmt::format(
        "Light air_extinction(float h) {{\n{}    return {};\n}}\n\n", densities, extinction);
    return fmt::format(
        "// The air at a place, per km: its extinction, what it scatters to the eye of sunlight, "
        "and its\n"
        "// scattering times the moments of the phase functions.\n"
        "struct AirPoint {{\n    Light extinction;\n    Light to_eye;\n{}}};\n\n"
        "AirPoint air_at(float h, AirPhases phases) {{\n{}    AirPoint here;\n"
        "    here.extinction = {};\n    here.to_eye = {};\n{}    return here;\n}}\n\n{}",
        members, densities, extinction, to_eye, values, extinction_function);
}

// --- Tables --------------------------------------------------------------------------------------

// Returns the published lookup of a table, as functions baked_NAME.
std::string table_lookup(const RuntimeAir& air, const PreviewAsset& asset) {
    const config::Bake& bake = config::bake_named(air.recipe->parameters, asset.entry.name);
    return lookup_glsl(
        baker_of(bake).lookup(air.recipe->parameters, bake,
                              {asset.entry.mapping, asset.entry.size, asset.entry.channels.size()}),
        glsl_name(asset.entry.name));
}

std::string sun_through_glsl(const RuntimeAir& air) {
    const std::string call = fmt::format("{}({}, h, mu)", glsl_name(air.transmittance->entry.name),
                                         table_name(air.transmittance->entry.name));
    return fmt::format(
        "Light air_sun_through(sampler2D SUN_TABLE, float h, float mu) {{ return {}; }}\n\n",
        air.tables.holds_optical_depth ? "exp(-" + call + ")" : call);
}

// The light that is scattered again, as a call of the table's lookup.
std::string light_call(const RuntimeAir& air, int part) {
    const std::string& asset = air.multiple_scattering->entry.name;
    return fmt::format("{}({}, h, sun_mu{})", glsl_name(asset), table_name(asset),
                       air.tables.degree > 0 ? fmt::format(", {}", part) : "");
}

// Returns statements that add, for each moment of order m, the scattering of its degree times the
// associated Legendre function times cos(m phi) (sky_march.h). `sectoral` is P_m^m.
std::string order_glsl(const RuntimeAir& air, int m) {
    const int degree = air.tables.degree;
    std::string text;
    if (m > 0) {
        text += fmt::format("    sectoral *= sine * {}.0;\n", 2 * m - 1);
        text += m == 1
                    ? "    float cosine_1 = azimuth_cosine;\n"
                    : fmt::format("    float cosine_{} = 2.0 * azimuth_cosine * cosine_{} - {};\n",
                                  m, m - 1, m == 2 ? "1.0" : fmt::format("cosine_{}", m - 2));
    }
    for (int l = m; l <= degree; ++l) {
        const std::string name = fmt::format("p_{}_{}", l, m);
        std::string value = "sectoral";
        if (l > m) {
            value = fmt::format(
                "({}.0 * mu * p_{}_{}{}) / {}.0", 2 * l - 1, l - 1, m,
                l > m + 1 ? fmt::format(" - {}.0 * p_{}_{}", l - 1 + m, l - 2, m) : "", l - m);
        }
        text += fmt::format("    float {} = {};\n", name, value);
        text += fmt::format("    sum += here.scattering_{} * ({}{}) * {};\n", l, name,
                            m > 0 ? fmt::format(" * cosine_{}", m) : "",
                            light_call(air, l * (l + 1) / 2 + m));
    }
    return text;
}

std::string scattered_again_glsl(const RuntimeAir& air) {
    std::string sum = fmt::format("    return here.scattering_0 * {};\n", light_call(air, 0));
    if (air.tables.degree > 0) {
        sum =
            "    float view_mu = clamp(mu, -1.0, 1.0), sine = sqrt((1.0 - view_mu) * (1.0 + "
            "view_mu));\n"
            "    float sines = sine * sqrt((1.0 - sun_mu) * (1.0 + sun_mu)), along = nu - view_mu "
            "* sun_mu;\n"
            "    float azimuth_cosine = abs(along) < sines ? along / sines : along < 0.0 ? -1.0 : "
            "1.0;\n"
            "    float sectoral = 1.0;\n    Light sum = Light(0.0);\n";
        for (int m = 0; m <= air.tables.degree; ++m) sum += order_glsl(air, m);
        sum += "    return sum;\n";
    }
    return fmt::format(
        "// The mean of the light that is scattered again, over all directions.\n"
        "Light air_mean_light(sampler2D LIGHT_TABLE, float h, float sun_mu) {{ return {}; }}\n\n"
        "// What a km of air scatters again into a ray{}.\n"
        "Light air_scattered_again(sampler2D LIGHT_TABLE, AirPoint here, float h, float sun_s{}) "
        "{{\n"
        "    float sun_mu = clamp(sun_s / (baked_ground_radius_km() + h), -1.0, 1.0);\n{}}}\n\n",
        light_call(air, 0),
        air.tables.degree > 0 ? ", whose direction has the cosine mu of its zenith angle\n"
                                "// and nu of its angle to the sun"
                              : "",
        air.tables.degree > 0 ? ", float mu, float nu" : "", sum);
}

std::string mean_through_glsl(int channels) {
    std::vector<std::string> values;
    for (int c = 0; c < channels; ++c) {
        values.push_back(fmt::format("air_mean_through_of(x.{0}, through.{0})", "xyzw"[c]));
    }
    return fmt::format(
        "Light air_mean_through(Light x, Light through) {{\n    return Light({});\n}}\n\n",
        fmt::join(values, ",\n        "));
}

// --- Numbers -------------------------------------------------------------------------------------

std::string numbers_glsl(const RuntimeAir& air) {
    const Shell shell = shell_of(air.medium.air);
    const int channels = air.medium.air.channels;
    Spectrum limb{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        limb[c] = limb_exponent(wavelength_nm_of(air.tables, c));
    }
    return number_function("float", "baked_ground_radius_km", glsl_number(shell.ground_radius_km),
                           "The radius of the ground.") +
           number_function("float", "baked_air_thickness_km", glsl_number(shell.thickness_km),
                           "The altitude at which the air ends.") +
           number_function("Light", "air_ground_albedo",
                           light_glsl(air.medium.air.ground_albedo, channels),
                           "The share of light that the ground reflects.") +
           number_function("Light", "air_sun_limb", light_glsl(limb, channels),
                           "The exponents by which the sun's disc darkens towards its limb.");
}

}  // namespace

std::string light_type(const RuntimeAir& air) {
    return fmt::format("vec{}", air.medium.air.channels);
}

std::string table_name(std::string_view asset) {
    return glsl_name(asset).substr(std::string_view("baked_").size()) + "_table";
}

std::string number_function(std::string_view type, std::string_view name, std::string_view value,
                            std::string_view comment) {
    return fmt::format("// {}\n{} {}() {{ return {}; }}\n\n", comment, type, name, value);
}

std::string with_textures(std::string_view text, const RuntimeAir& air,
                          const std::vector<std::string>& names) {
    std::vector<std::string> declared;
    for (const std::string& name : names) declared.push_back("sampler2D " + name);
    std::string phases_declared;
    std::string phases_given;
    for (std::size_t i = 2; i < names.size(); ++i) {
        phases_declared += declared[i] + ", ";
        phases_given += names[i] + ", ";
    }
    const std::string angles = air.tables.degree > 0 ? ", (s + t) / (radius + altitude), nu" : "";
    std::string result(text);
    for (const auto& [pattern, by] :
         {std::pair{"\\bLight\\b", light_type(air)},
          std::pair{"\\bTABLES\\b", fmt::format("{}", fmt::join(declared, ", "))},
          std::pair{"\\bGIVEN\\b", fmt::format("{}", fmt::join(names, ", "))},
          std::pair{"\\bSUN_TABLE\\b", names[0]}, std::pair{"\\bLIGHT_TABLE\\b", names[1]},
          std::pair{"\\bPHASE_TABLES ", phases_declared},
          std::pair{"\\bPHASES_GIVEN ", phases_given}, std::pair{" ANGLES\\b", angles}}) {
        result = std::regex_replace(result, std::regex(pattern), by);
    }
    return result;
}

std::string air_glsl(const RuntimeAir& air, const AirTextures& textures) {
    std::string text = numbers_glsl(air);
    for (std::size_t i = 0; i < air.medium.layers.size(); ++i) {
        text += density_function(air.medium.layers[i], i);
    }
    text += phases_glsl(air.medium, textures) + point_glsl(air) + sun_through_glsl(air) +
            scattered_again_glsl(air) + mean_through_glsl(air.medium.air.channels);
    std::string library(embedded_text("air_library.glsl"));
    constexpr std::string_view kPlace = "AIR_OF_RECIPE\n\n";
    library.replace(library.find(kPlace), kPlace.size(), text);
    return table_lookup(air, *air.transmittance) + "\n" +
           table_lookup(air, *air.multiple_scattering) + "\n" +
           with_textures(library, air, textures.names);
}

}  // namespace skybake
