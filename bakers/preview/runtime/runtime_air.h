// The air of a recipe as GLSL: its layers, and functions that march rays through them by the baked tables
// (air_library.glsl). The text is in the GLSL that shading/ translates.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// An atmosphere with the two tables that rays are marched by.
struct RuntimeAir {
    const config::Recipe* recipe = nullptr;
    const PreviewAsset* transmittance = nullptr;
    const PreviewAsset* multiple_scattering = nullptr;
    SkyMedium medium;
    SkyTables tables;
};

// The textures that functions of the air take. Each is called NAME_table.
struct AirTextures {
    std::vector<std::string> names;  // those of the two tables, and of tables of phase functions
    // GLSL of the phase function of each layer for `ray` and `sun`, in the channels of the tables; empty
    // for those that have a closed form.
    std::vector<std::string> phases;
};

// Returns "vec3" or "vec4": the light of all channels of the tables.
std::string light_type(const RuntimeAir& air);

// Returns numbers and functions of the air, with the lookups of both tables. The functions are those of
// air_library.glsl and what it calls.
std::string air_glsl(const RuntimeAir& air, const AirTextures& textures);

// Returns a text with `Light` as the type of light, and with the textures in the place of TABLES, where
// arguments are declared, and of GIVEN, where they are handed on.
std::string with_textures(std::string_view text, const RuntimeAir& air,
                          const std::vector<std::string>& names);

// "my_table" of the asset `my`: as functions are called baked_my.
std::string table_name(std::string_view asset);

// A function without arguments, which all languages have, below a comment.
std::string number_function(std::string_view type, std::string_view name, std::string_view value,
                            std::string_view comment);

}  // namespace skybake
