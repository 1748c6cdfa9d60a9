#include "config/recipe/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "config/assets/cloud_volume.h"
#include "config/diagnostics/toml_source.h"
#include "config/recipe/merge.h"
#include "config/recipe/preview_section.h"
#include "config/recipe/recipe_decoder.h"
#include "config/recipe/recipe_sources.h"
#include "config/sections/volume.h"
#include "config/sweep/sweep_decoder.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// Adds the pictures and volumes of the clouds that are baked, because a change of such a file is a
// change of the recipe.
void append_maps(const Parameters& parameters, std::vector<std::filesystem::path>& inputs) {
    for (const Cloud& cloud : parameters.clouds) {
        const auto bakes_it = [&](const Bake& bake) {
            const auto* volume = bake.find<CloudVolumeBake>();
            return volume && volume->cloud == cloud.name;
        };
        if (std::ranges::none_of(parameters.bakes, bakes_it)) continue;
        for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (!map->path.empty()) inputs.push_back(map->path);
        }
        if (cloud.volume.empty()) continue;
        inputs.push_back(volume_named(parameters, cloud.volume).path);
    }
}

// These are all sources of a recipe, merged into one tree.
struct MergedSources {
    Table root;
    const Source* file = nullptr;  // the recipe itself; null if it could not be read
    bool complete = true;          // false: keys may be missing because a source is
};

MergedSources merge_sources(RecipeSources& sources, DiagnosticList& diagnostics) {
    MergedSources merged;
    for (const SourceTree& tree : sources.trees) {
        merge(merged.root, tree.root);
        if (tree.source->kind == Source::Kind::file) merged.file = tree.source;  // the last one
    }
    if (!merged.file) return merged;
    const bool laid = lay_sections_over_presets(merged.root, sources.sources, diagnostics);
    merged.complete = sources.complete && laid;
    merged.complete = name_bakes_of_sections(merged.root, diagnostics) && merged.complete;
    return merged;
}

enum class SweepTable { read, left_out };

Outcome<Recipe> decode_sources(RecipeSources sources, SweepTable sweep,
                               DiagnosticList diagnostics) {
    Outcome<Recipe> outcome;
    Recipe recipe;
    const MergedSources merged = merge_sources(sources, diagnostics);
    if (merged.file) {
        Decoder decoder{diagnostics, recipe.values, merged.complete, std::nullopt};
        recipe.parameters = decode_recipe(merged.root, *merged.file, decoder);
        recipe.preview = decode_preview(merged.root, decoder);
        if (sweep == SweepTable::read) {
            Decoder of_sweep{diagnostics, recipe.sweep_values, merged.complete, decoder.channels};
            recipe.sweep = decode_sweep(merged.root, of_sweep);
        }
        recipe.inputs = std::move(sources.inputs);
        if (!diagnostics.has_errors()) append_maps(recipe.parameters, recipe.inputs);
    }
    const bool whole = merged.file && !diagnostics.has_errors();
    outcome.diagnostics = diagnostics.take();
    if (whole) outcome.value = std::move(recipe);
    return outcome;
}

// The functions below make the texts of parameters_toml (recipe.h).

template <class IsWanted>
std::string toml_of(const Recipe& recipe, const IsWanted& is_wanted) {
    std::string text;
    std::string table;
    for (const ResolvedValue& value : recipe.values) {
        if (value.only_shown || !is_wanted(value)) continue;
        if (value.section != table) {
            table = value.section;
            text += (text.empty() ? "[" : "\n[") + table + "]\n";
        }
        text += key_of(value) + " = " + value.canonical + '\n';
    }
    return text;
}

using Values = std::map<std::string, std::string>;  // TOML by path

void flatten(const Table& table, const std::string& path, Values& values) {
    for (const Entry& entry : table) {
        const std::string below = join_path(path, entry.key);
        if (const Table* inner = as_table(entry.value)) {
            flatten(*inner, below, values);
        } else {
            values[below] = value_to_string(entry.value);
        }
    }
}

Values values_of(std::string_view text) {
    Values values;
    Source source;
    source.text = text;
    DiagnosticList diagnostics;
    if (const auto root = parse_toml(source, diagnostics)) flatten(*root, "", values);
    return values;
}

std::string shown(const std::string& value) { return value.empty() ? "none" : shorten(value); }

}  // namespace

Outcome<Recipe> load_recipe(const std::filesystem::path& path,
                            std::span<const std::string> settings) {
    DiagnosticList diagnostics;
    RecipeSources sources = read_sources(path, settings, diagnostics);
    return decode_sources(std::move(sources), SweepTable::read, std::move(diagnostics));
}

Outcome<Recipe> parse_recipe(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder,
                             std::span<const std::string> settings) {
    DiagnosticList diagnostics;
    RecipeSources sources = text_sources(std::string(text), name, folder, settings, diagnostics);
    return decode_sources(std::move(sources), SweepTable::read, std::move(diagnostics));
}

Outcome<Sweep> load_sweep(const std::filesystem::path& path, std::span<const std::string> settings,
                          const SweepOptions& options) {
    DiagnosticList diagnostics;
    RecipeSources sources = read_sources(path, settings, diagnostics);
    add_sweep_options(options, sources, diagnostics);
    const MergedSources merged = merge_sources(sources, diagnostics);
    Outcome<Sweep> outcome;
    Sweep sweep;
    if (merged.file) {
        std::vector<ResolvedValue> values;
        Decoder decoder{diagnostics, values, merged.complete, std::nullopt};
        sweep = decode_sweep(merged.root, decoder);
    }
    if (merged.file && !diagnostics.has_errors()) outcome.value = std::move(sweep);
    outcome.diagnostics = diagnostics.take();
    return outcome;
}

Outcome<Recipe> load_variant(const std::filesystem::path& path,
                             std::span<const std::string> settings, const Sweep& sweep, int index) {
    const std::vector<std::string> varied = variant_settings(sweep, index);
    DiagnosticList diagnostics;
    RecipeSources sources = read_sources(path, settings, diagnostics, varied);
    return decode_sources(std::move(sources), SweepTable::left_out, std::move(diagnostics));
}

std::string parameters_toml(const Recipe& recipe, std::span<const Read> reads) {
    // Values of one section follow each other, and a sequence has as many sections as frames.
    const ResolvedValue* before = nullptr;
    std::vector<Read> of_section;
    return toml_of(recipe, [&](const ResolvedValue& value) {
        if (before == nullptr || before->section != value.section) {
            of_section.clear();
            std::ranges::copy_if(reads, std::back_inserter(of_section), [&](const Read& read) {
                const Read of_any_role{read.section, Roles::all()};
                return is_read(value, {&of_any_role, 1});
            });
        }
        before = &value;
        return std::ranges::any_of(of_section,
                                   [&](const Read& read) { return read.roles.has(value.role); });
    });
}

std::string parameters_toml(const Recipe& recipe, std::span<const std::string> patterns) {
    return toml_of(recipe, [patterns](const ResolvedValue& value) {
        return std::ranges::any_of(patterns, [&value](const std::string& pattern) {
            return path_matches(value.path, pattern);
        });
    });
}

std::vector<ParameterChange> parameter_changes(std::string_view before, std::string_view after) {
    const Values old_values = values_of(before);
    const Values new_values = values_of(after);
    std::map<std::string, ParameterChange> changes;
    for (const auto& [path, value] : old_values) changes[path] = {path, value, ""};
    for (const auto& [path, value] : new_values) {
        changes[path].path = path;
        changes[path].after = value;
    }
    std::vector<ParameterChange> result;
    for (const auto& [path, change] : changes) {
        if (change.before != change.after) result.push_back(change);
    }
    return result;
}

std::string change_text(const ParameterChange& change) {
    return fmt::format("{} {} → {}", change.path, shown(change.before), shown(change.after));
}

}  // namespace skybake::config
