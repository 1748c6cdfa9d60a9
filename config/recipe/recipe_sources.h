// All the texts that make up one recipe, in the order in which they override each other: the
// preset, the included files (each after its own preset and includes), the file itself, each --set.
#pragma once

#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

struct SourceTree {
    const Source* source = nullptr;
    Table root;
};

struct RecipeSources {
    std::deque<Source> sources;     // owns what the places point to
    std::vector<SourceTree> trees;  // later ones override earlier ones
    std::vector<std::filesystem::path> inputs;
    bool complete = true;  // false: one could not be read, so keys may be missing for that reason
};

// A recipe file and the --set texts laid over it, and over these the values of a sweep's variant,
// texts of the same form that diagnostics name --vary. What cannot be read is reported and left
// out. The diagnostics point into the sources: take them while these are there.
RecipeSources read_sources(const std::filesystem::path& path, std::span<const std::string> settings,
                           DiagnosticList& diagnostics, std::span<const std::string> varied = {});

// The same for a text in memory.
RecipeSources text_sources(std::string text, const std::string& name,
                           const std::filesystem::path& folder,
                           std::span<const std::string> settings, DiagnosticList& diagnostics);

// A source for words of the command line, which has no lines; it overrides all that are there.
Source& add_setting(RecipeSources& sources, const std::string& name);

// Lays a tree that was made from such a source over all others: every place in it is the source.
void add_setting_tree(RecipeSources& sources, const Source& source, Table root);

}  // namespace skybake::config
