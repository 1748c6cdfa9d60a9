#include "config/noise_preset_merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "config/key_path.h"
#include "config/merge.h"
#include "config/presets.h"
#include "config/suggest.h"
#include "config/toml_source.h"

namespace skybake::config {
namespace {

void report_unknown_preset(const std::string& name, const Place& place,
                           DiagnosticList& diagnostics) {
    const auto names = noise_preset_names();
    std::string label = did_you_mean(name, names);
    if (find_preset(name)) {
        label =
            fmt::format("it is a preset of an atmosphere: preset = \"{}\" at the top level", name);
    } else if (label.empty()) {
        label = fmt::format("there are: {}", fmt::join(names, ", "));
    }
    diagnostics.error("E0115", place, fmt::format("unknown noise preset `{}`", shorten(name)),
                      std::move(label));
}

// The keys of the preset that a noise names. None if it names none, or there is none of that name.
std::optional<Table> preset_of(const Value& name, std::deque<Source>& sources,
                               DiagnosticList& diagnostics) {
    const auto* text = std::get_if<std::string>(&name.data);
    if (!text) return std::nullopt;  // the decoder reports a value that is no text
    const Preset* preset = find_noise_preset(*text);
    if (!preset) {
        report_unknown_preset(*text, name.place, diagnostics);
        return std::nullopt;
    }
    sources.push_back({Source::Kind::preset, -1, fmt::format("preset {}", preset->name),
                       std::string(preset->text)});
    return parse_toml(sources.back(), diagnostics);
}

}  // namespace

bool lay_noises_over_presets(Table& root, std::deque<Source>& sources,
                             DiagnosticList& diagnostics) {
    const Entry* noises = find_entry(root, "noise");
    const Table* named = noises ? as_table(noises->value) : nullptr;
    if (!named) return true;
    bool complete = true;
    Table presets;
    for (const Entry& entry : *named) {
        const Table* table = as_table(entry.value);
        const Entry* preset = table ? find_entry(*table, "preset") : nullptr;
        if (!preset) continue;
        std::optional<Table> keys = preset_of(preset->value, sources, diagnostics);
        complete = complete && keys;
        if (!keys) continue;
        presets.push_back({entry.key, entry.key_place, {std::move(*keys), entry.value.place}});
    }
    Table base;
    base.push_back({noises->key, noises->key_place, {std::move(presets), noises->value.place}});
    merge(base, root);
    root = std::move(base);
    return complete;
}

}  // namespace skybake::config
