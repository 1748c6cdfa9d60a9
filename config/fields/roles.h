// This header says what the values of a recipe are about, so that an asset can say which of them it
// is made from.
#pragma once

#include <initializer_list>
#include <span>
#include <string>

namespace skybake::config {

// Each field has one role. The role `content` is the default: everything that is made from the
// section is made from this value.
enum class Role {
    content,
    geometry,    // radii, and how densities change with altitude
    extinction,  // coefficients per unit of density
    scattering,
    phase,      // the phase function
    particles,  // the particles that a layer is made of
    ground,     // what the ground reflects
    files,      // what files are like, apart from the values of the texels
    usual,      // a default of other keys, whose values count, or for warnings only
};

class Roles {
  public:
    constexpr Roles(std::initializer_list<Role> roles) {
        for (const Role role : roles) bits_ |= bit(role);
    }
    static constexpr Roles all() {
        Roles roles{};
        roles.bits_ = ~0u;
        return roles;
    }
    constexpr bool has(Role role) const { return (bits_ & bit(role)) != 0; }

  private:
    static constexpr unsigned bit(Role role) { return 1u << static_cast<unsigned>(role); }
    unsigned bits_ = 0;
};

// These are values that an asset is made from: the values with these roles in the sections at a
// path whose names may be `*`.
struct Read {
    std::string section;  // "atmosphere.layers.*"
    Roles roles = {Role::content};
};

// This is one resolved value of a recipe, for `show` and for the parameters that files carry.
struct ResolvedValue {
    std::string path;       // "atmosphere.layers.mie.scattering"
    std::string written;    // TOML as its source spells it: ["5.802e-6 /m", ...]
    std::string canonical;  // TOML in base units, equal for equal values: "8000 m"
    std::string origin;  // "earth.toml:14", "preset earth", "--set `a.b=c`", "default", "derived"
    std::string section = {};  // "atmosphere.layers.mie"
    Role role = Role::content;
    bool only_shown =
        false;  // says where others come from (`preset`, `absorption`); files do not carry it
};

// Returns the last name of a value's path, which its section has as a key.
std::string key_of(const ResolvedValue& value);

// Whether an asset that reads `reads` is made from the value.
bool is_read(const ResolvedValue& value, std::span<const Read> reads);

}  // namespace skybake::config
