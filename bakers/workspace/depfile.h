// What Make and Ninja read to know when files are stale.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace skybake {

// One rule in Make's syntax: all targets depend on all inputs and on this program with its modules,
// which hold the presets and the bakers. Names are written so that Make and Ninja read them back,
// with spaces, `#`, `$`, `:` and `\` in them. (No spelling keeps GNU Make from reading `=` as an
// assignment and `;` and `|` as marks of its own, nor Ninja from ending a name at `'`, `&`, `*`,
// `;` or `|`.) Each input is a target of a rule without a recipe as well, so that Make goes on when
// one is removed.
std::string depfile_text(std::span<const std::filesystem::path> targets,
                         std::span<const std::filesystem::path> inputs);

}  // namespace skybake
