// This header gathers all the texts that make up one recipe. Later texts override earlier ones:
// first the preset, then the included files (each after its own preset and includes), then the file
// itself, then each --set.
#pragma once

#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

struct SweepOptions;

struct SourceTree {
    const Source* source = nullptr;
    Table root;
};

struct RecipeSources {
    std::deque<Source> sources;     // owns what the places point to
    std::vector<SourceTree> trees;  // later trees override earlier ones
    std::vector<std::filesystem::path> inputs;
    bool complete = true;  // false: a source could not be read, so keys may be missing
};

// Reads a recipe file, lays the --set texts over it, and lays the values of a sweep's variant
// (`varied`) over both. Those are texts of the same form, which diagnostics call --vary. What
// cannot be read is reported and left out. The diagnostics point into the sources, so take the
// diagnostics while the sources exist.
RecipeSources read_sources(const std::filesystem::path& path, std::span<const std::string> settings,
                           DiagnosticList& diagnostics, std::span<const std::string> varied = {});

// Does the same for a text in memory.
RecipeSources text_sources(std::string text, const std::string& name,
                           const std::filesystem::path& folder,
                           std::span<const std::string> settings, DiagnosticList& diagnostics);

// Adds a source for words of the command line, which have no lines. It overrides all sources that
// are there.
Source& add_setting(RecipeSources& sources, const std::string& name);

// Lays a tree that was made from such a source over all others. Every place in the tree becomes
// that source.
void add_setting_tree(RecipeSources& sources, const Source& source, Table root);

// Replaces the `table` of each layer of the tree that names a file by the file's pairs, which stand
// at the place of the name. Appends the files to `inputs`. Reports E0300 for a file that cannot be
// read, and E0114 for one that holds no such table.
void read_table_files(Table& root, const std::filesystem::path& folder,
                      std::vector<std::filesystem::path>& inputs, DiagnosticList& diagnostics);

// Lays the options over a recipe's own [sweep], each option as a separate source. An entry replaces
// the one of the same path. Malformed options are reported (E0122).
void add_sweep_options(const SweepOptions& options, RecipeSources& sources,
                       DiagnosticList& diagnostics);

}  // namespace skybake::config
