#include "config/recipe/parameter_changes.h"

#include <fmt/format.h>

#include <map>

#include "config/diagnostics/diagnostic_list.h"
#include "config/diagnostics/toml_source.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

using Values = std::map<std::string, std::string>;  // TOML by path

void flatten(const Table& table, const std::string& path, Values& values) {
    for (const Entry& entry : table) {
        const std::string below = join_path(path, entry.key);
        if (const Table* inner = as_table(entry.value)) {
            flatten(*inner, below, values);
        } else {
            values[below] = spell_value(entry.value);
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
