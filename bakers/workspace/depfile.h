// Depfiles, which tell Make and Ninja when files are stale.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace skybake {

// Returns one rule in Make's syntax: all targets depend on all inputs and on this program with its
// modules, which hold the presets and the bakers. Names may contain spaces, `#`, `$`, `:` and `\`;
// they are escaped so that Make and Ninja read them back. (No escape keeps GNU Make from reading
// `=`, `;` and `|` as its own syntax, or Ninja from ending a name at `'`, `&`, `*`, `;` or `|`.)
// Each input is also the target of a rule without a recipe, so that Make does not fail when an
// input is removed.
std::string depfile_text(std::span<const std::filesystem::path> targets,
                         std::span<const std::filesystem::path> inputs);

// Whether a file holds what depfile_text returns for a bake, or nothing.
bool is_depfile(std::string_view text);

}  // namespace skybake
