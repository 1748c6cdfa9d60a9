#include "config/recipe.h"

#include <algorithm>
#include <utility>

#include "config/diagnostic_list.h"
#include "config/merge.h"
#include "config/recipe_decoder.h"
#include "config/recipe_sources.h"
#include "config/section_preset_merge.h"

namespace skybake::config {
namespace {

// The pictures of the clouds that are baked: a change of theirs is one of the recipe.
void append_maps(const Parameters& parameters, std::vector<std::filesystem::path>& inputs) {
    for (const Cloud& cloud : parameters.clouds) {
        const auto bakes_it = [&](const Bake& bake) {
            const auto* volume = std::get_if<CloudVolumeBake>(&bake.asset);
            return volume && volume->cloud == cloud.name;
        };
        if (std::none_of(parameters.bakes.begin(), parameters.bakes.end(), bakes_it)) continue;
        for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (!map->path.empty()) inputs.push_back(map->path);
        }
    }
}

Outcome<Recipe> decode_sources(RecipeSources sources, DiagnosticList diagnostics) {
    Outcome<Recipe> outcome;
    Recipe recipe;
    Table root;
    const Source* file = nullptr;
    for (const SourceTree& tree : sources.trees) {
        merge(root, tree.root);
        if (tree.source->kind == Source::Kind::file) file = tree.source;  // the recipe is the last
    }
    if (file) {
        const bool laid = lay_sections_over_presets(root, sources.sources, diagnostics);
        Decoder decoder{diagnostics, recipe.values, sources.complete && laid, std::nullopt};
        recipe.parameters = decode_recipe(root, *file, decoder);
        recipe.inputs = std::move(sources.inputs);
        append_maps(recipe.parameters, recipe.inputs);
    }
    const bool whole = file && !diagnostics.has_errors();
    outcome.diagnostics = diagnostics.take();
    if (whole) outcome.value = std::move(recipe);
    return outcome;
}

}  // namespace

Outcome<Recipe> load_recipe(const std::filesystem::path& path,
                            std::span<const std::string> settings) {
    DiagnosticList diagnostics;
    RecipeSources sources = read_sources(path, settings, diagnostics);
    return decode_sources(std::move(sources), std::move(diagnostics));
}

Outcome<Recipe> parse_recipe(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder,
                             std::span<const std::string> settings) {
    DiagnosticList diagnostics;
    RecipeSources sources = text_sources(std::string(text), name, folder, settings, diagnostics);
    return decode_sources(std::move(sources), std::move(diagnostics));
}

}  // namespace skybake::config
