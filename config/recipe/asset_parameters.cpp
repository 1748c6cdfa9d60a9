#include "config/recipe/asset_parameters.h"

#include <algorithm>
#include <vector>

namespace skybake::config {

Outcome<Recipe> parse_asset_parameters(std::string_view text, const std::string& name) {
    const auto has_line = [text](std::string_view begin) {
        return text.starts_with(begin) || text.find("\n" + std::string(begin)) != text.npos;
    };
    std::vector<std::string> settings;
    if (has_line("[atmosphere]") && !has_line("ground_albedo = ")) {
        settings.emplace_back("atmosphere.ground_albedo=0");
    }
    return parse_recipe(text, name, {}, settings);
}

const Bake* own_bake(const Parameters& parameters, std::string_view name) {
    const std::vector<Bake>& bakes = parameters.bakes;
    const auto own = std::find_if(bakes.begin(), bakes.end(), [&](const Bake& bake) {
        return bakes.size() == 1 || bake.name == name;
    });
    return own != bakes.end() ? &*own : nullptr;
}

}  // namespace skybake::config
