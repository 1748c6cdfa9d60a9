// parameters_toml of recipe.h.
#include <algorithm>
#include <string>

#include "config/recipe/recipe.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

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

template <class IsWanted>
std::string toml_of(const Recipe& recipe, const IsWanted& is_wanted) {
    std::string text;
    std::string table;
    for (const ResolvedValue& value : recipe.values) {
        if (value.only_shown || !is_wanted(value)) continue;
        const SplitPath path = split_last(value.path);
        if (path.table != table) {
            table = path.table;
            text += (text.empty() ? "[" : "\n[") + table + "]\n";
        }
        text += path.key + " = " + value.canonical + '\n';
    }
    return text;
}

}  // namespace

std::string parameters_toml(const Recipe& recipe, std::span<const Read> reads) {
    return toml_of(recipe, [reads](const ResolvedValue& value) { return is_read(value, reads); });
}

std::string parameters_toml(const Recipe& recipe, std::span<const std::string> patterns) {
    return toml_of(recipe, [patterns](const ResolvedValue& value) {
        return std::any_of(patterns.begin(), patterns.end(), [&value](const std::string& pattern) {
            return path_matches(value.path, pattern);
        });
    });
}

}  // namespace skybake::config
