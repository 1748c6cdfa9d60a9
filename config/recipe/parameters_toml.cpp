// parameters_toml of recipe.h.
#include <algorithm>
#include <string>

#include "config/recipe/recipe.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

bool is_wanted(const ResolvedValue& value, std::span<const std::string> patterns) {
    if (value.only_shown) return false;
    return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
        return path_matches(value.path, pattern);
    });
}

// The path of the table that holds a key, and the key itself.
struct SplitPath {
    std::string table;
    std::string key;
};

SplitPath split_last(const std::string& path) {
    SplitPath result;
    for (const std::string& name : split_path(path).value_or(std::vector<std::string>{})) {
        if (!result.key.empty()) {
            result.table = result.table.empty() ? result.key : result.table + '.' + result.key;
        }
        result.key = spell_key(name);
    }
    return result;
}

}  // namespace

std::string parameters_toml(const Recipe& recipe, std::span<const std::string> patterns) {
    std::string text;
    std::string table;
    for (const ResolvedValue& value : recipe.values) {
        if (!is_wanted(value, patterns)) continue;
        const SplitPath path = split_last(value.path);
        if (path.table != table) {
            table = path.table;
            text += (text.empty() ? "[" : "\n[") + table + "]\n";
        }
        text += path.key + " = " + value.canonical + '\n';
    }
    return text;
}

}  // namespace skybake::config
