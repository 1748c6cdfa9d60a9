#include "config/recipe/asset_parameters.h"

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
    // Those of assets that it is made from lack their formats, of which the default may not hold theirs.
    for (std::size_t at = 0; (at = text.find("[bake.", at)) != text.npos; ++at) {
        const std::string_view section = text.substr(at, text.find("\n\n", at) - at);
        if (section.find("\nformats = ") != section.npos) continue;
        settings.push_back(std::string(section.substr(1, section.find(']') - 1)) + ".formats=bin");
    }
    return parse_recipe(text, name, {}, settings);
}

}  // namespace skybake::config
