// One resolved value of a recipe, for `show` and for the parameters that files carry.
#pragma once

#include <span>
#include <string>

#include "config/fields/roles.h"

namespace skybake::config {

struct ResolvedValue {
    std::string path;       // "atmosphere.layers.mie.scattering"
    std::string written;    // TOML as its source spells it: ["5.802e-6 /m", ...]
    std::string canonical;  // TOML in base units, equal for equal values: "8000 m"
    std::string origin;  // "earth.toml:14", "preset earth", "--set `a.b=c`", "default", "derived"
    std::string section = {};  // "atmosphere.layers.mie"
    Role role = Role::content;
    bool only_shown =
        false;  // tells where others come from (`preset`, `absorption`); not for files
};

// Whether an asset that reads `reads` is made from the value.
bool is_read(const ResolvedValue& value, std::span<const Read> reads);

}  // namespace skybake::config
