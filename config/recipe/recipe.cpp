#include "config/recipe/recipe.h"

#include <algorithm>
#include <utility>

#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic_list.h"
#include "config/recipe/merge.h"
#include "config/recipe/recipe_decoder.h"
#include "config/recipe/recipe_sources.h"
#include "config/recipe/section_preset_merge.h"
#include "config/sweep/sweep_decoder.h"

namespace skybake::config {
namespace {

// The pictures of the clouds that are baked: a change of theirs is one of the recipe.
void append_maps(const Parameters& parameters, std::vector<std::filesystem::path>& inputs) {
    for (const Cloud& cloud : parameters.clouds) {
        const auto bakes_it = [&](const Bake& bake) {
            const auto* volume = bake.find<CloudVolumeBake>();
            return volume && volume->cloud == cloud.name;
        };
        if (std::none_of(parameters.bakes.begin(), parameters.bakes.end(), bakes_it)) continue;
        for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (!map->path.empty()) inputs.push_back(map->path);
        }
    }
}

// All sources of a recipe as one tree.
struct MergedSources {
    Table root;
    const Source* file = nullptr;  // the recipe itself; null if it could not be read
    bool complete = true;          // false: keys may be missing since a source is
};

MergedSources merge_sources(RecipeSources& sources, DiagnosticList& diagnostics) {
    MergedSources merged;
    for (const SourceTree& tree : sources.trees) {
        merge(merged.root, tree.root);
        if (tree.source->kind == Source::Kind::file) merged.file = tree.source;  // is the last
    }
    if (!merged.file) return merged;
    const bool laid = lay_sections_over_presets(merged.root, sources.sources, diagnostics);
    merged.complete = sources.complete && laid;
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
        if (sweep == SweepTable::read) {
            Decoder of_sweep{diagnostics, recipe.sweep_values, merged.complete, decoder.channels};
            recipe.sweep = decode_sweep(merged.root, of_sweep);
        }
        recipe.inputs = std::move(sources.inputs);
        append_maps(recipe.parameters, recipe.inputs);
    }
    const bool whole = merged.file && !diagnostics.has_errors();
    outcome.diagnostics = diagnostics.take();
    if (whole) outcome.value = std::move(recipe);
    return outcome;
}

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

}  // namespace skybake::config
