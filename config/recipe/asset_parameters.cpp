#include "config/recipe/asset_parameters.h"

#include <algorithm>
#include <vector>

namespace skybake::config {

Outcome<Recipe> parse_asset_parameters(std::string_view text, const std::string& name) {
    const std::string all = "\n" + std::string(text);
    std::vector<std::string> settings;
    if (all.find("\n[atmosphere]") != all.npos && all.find("\nground_albedo = ") == all.npos) {
        settings.emplace_back("atmosphere.ground_albedo=0");
    }
    // Sections of assets that it is made from name no formats, and the default may not hold their type.
    for (std::size_t at = 0; (at = text.find("[bake.", at)) != text.npos; ++at) {
        const std::string_view section = text.substr(at, text.find("\n\n", at) - at);
        if (section.find("\nformats = ") != section.npos) continue;
        settings.push_back(std::string(section.substr(1, section.find(']') - 1)) + ".formats=bin");
    }
    return parse_recipe(text, name, {}, settings);
}

const Bake* own_bake(const Parameters& parameters, std::string_view name) {
    const std::vector<Bake>& bakes = parameters.bakes;
    const std::string_view asset = name.substr(0, name.find('.'));  // "cells" of "cells.mip1"
    const auto own = std::ranges::find_if(
        bakes, [&](const Bake& bake) { return bakes.size() == 1 || bake.name == asset; });
    return own != bakes.end() ? &*own : nullptr;
}

}  // namespace skybake::config
