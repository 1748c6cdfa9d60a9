#include "config/recipe/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/diagnostics/diagnostic_codes.h"
#include "config/fields/fields.h"
#include "config/presets/presets.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

constexpr std::size_t explanation_width = 88;

using Names = std::vector<std::string>;

// Returns "bake.transmittance" for the section of that asset, else the section's path pattern.
std::string section_path(const Section& section) {
    return section.asset.empty() ? std::string(section.path) : "bake." + std::string(section.asset);
}

std::string field_path(const Section& section, const Field& field) {
    return join_path(section_path(section), field.key);
}

Names names_of(std::string_view path) {
    return path.empty() ? Names{} : split_path(path).value_or(Names{});
}

bool is_free(const std::string& name) { return name == "*"; }

bool name_fits(const std::string& asked, const std::string& pattern, const Section& section) {
    if (asked == pattern || is_free(asked)) return true;
    if (!is_free(pattern)) return false;
    // In [bake.NAME] the name of another asset means that asset's section.
    const std::vector<std::string_view> assets = asset_names();
    const bool other_asset = !section.asset.empty() && asked != section.asset &&
                             std::ranges::find(assets, asked) != assets.end();
    return !other_asset;
}

// Whether `asked` is the pattern or its tail.
bool tail_fits(const Names& asked, const Names& pattern, const Section& section) {
    if (asked.empty() || asked.size() > pattern.size()) return false;
    const std::size_t skipped = pattern.size() - asked.size();
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (!name_fits(asked[i], pattern[skipped + i], section)) return false;
    }
    return true;
}

// A table of named tables, such as "noise" or "atmosphere.layers", stands for the tables in it.
bool holds_section(Names asked, const Names& pattern, const Section& section) {
    asked.emplace_back("*");
    return !pattern.empty() && is_free(pattern.back()) && tail_fits(asked, pattern, section);
}

// A single name would fit any pattern that ends in `*`, so it only fits the section of an asset
// with that name.
bool section_fits(const Names& asked, const Section& section) {
    const Names pattern = names_of(section.path);
    if (holds_section(asked, pattern, section)) return true;
    if (asked.size() == 1 && !section.asset.empty()) return asked[0] == section.asset;
    if (asked.size() == 1 && !pattern.empty() && is_free(pattern.back())) return false;
    return tail_fits(asked, pattern, section);
}

std::string line(std::string_view title, std::string_view text) {
    constexpr std::size_t indent = 12;
    std::string wrapped = wrap(text, std::string(indent, ' '), explanation_width);
    wrapped.replace(2, title.size(), title);
    return wrapped;
}

std::string describe_default(const Field& field) {
    if (!field.fallback.empty()) return std::string(field.fallback);
    if (field.key == "asset") return "the section's name";
    return field.required ? "none: it must be given" : "none";
}

std::string others_of_group(const Section& section, const Field& field) {
    std::vector<std::string_view> keys;
    for (const Field& other : section.fields) {
        if (exclude_each_other(field, other)) keys.push_back(other.key);
    }
    return fmt::format("not together with {}", fmt::join(keys, ", "));
}

std::string with_hint(std::string text, std::string_view hint) {
    if (hint.empty()) return text;
    return text.empty() ? std::string(hint) : text + "; " + std::string(hint);
}

std::string explain_choices(const Field& field) {
    std::string text;
    for (const Choice& choice : field.choices) {
        text += fmt::format("{}\"{}\": {}", text.empty() ? "" : "\n", choice.name,
                            choice.documentation);
    }
    return text;
}

std::string explain_field(const Section& section, const Field& field) {
    std::string text = field_path(section, field) + '\n';
    text += wrap(field.documentation, "  ", explanation_width) + '\n';
    if (field.choices.empty() || field.kind.scale) text += line("takes", field.kind.words);
    if (!field.choices.empty()) text += line("choices", explain_choices(field));
    const std::string range = describe_range(field);
    const std::string bounds = with_hint(range, field.hint);
    if (!bounds.empty()) text += line(range.empty() ? "note" : "range", bounds);
    text += line("default", describe_default(field));
    if (!field.selector.empty()) {
        text += line("only with", fmt::format("{} = \"{}\"", field.selector,
                                              fmt::join(field.selected_by, "\" or \"")));
    }
    if (!field.needs.empty()) text += line("only with", field.needs);
    if (!field.exclusive_group.empty()) text += line("choose", others_of_group(section, field));
    if (!field.citation.empty()) text += line("source", field.citation);
    return text;
}

bool is_within(std::string_view path, const Section& outer) {
    return !outer.path.empty() && path.size() > outer.path.size() && path.starts_with(outer.path);
}

std::string explain_section(const Section& section) {
    std::string text = section.path.empty() ? "top level of a recipe: "
                                            : fmt::format("[{}]  ", section_path(section));
    text += std::string(section.documentation) + '\n';
    std::size_t widest = 0;
    for (const Field& field : section.fields) widest = std::max(widest, field.key.size());
    for (const Field& field : section.fields) {
        text += fmt::format("  {:<{}}  {}\n", field.key, widest, field.documentation);
    }
    for (const Section& inner : sections()) {
        if (!inner.asset.empty() || !is_within(inner.path, section)) continue;
        text += fmt::format("  [{}]  {}\n", section_path(inner), inner.documentation);
    }
    return text;
}

std::string indented(std::string_view text) { return wrap(text, "    ", std::string::npos); }

std::string explain_code(const DiagnosticCode& code) {
    std::string text = fmt::format("{}: {}\n\n", code.code, code.title);
    text += wrap(code.explanation, "", explanation_width);
    if (!code.wrong.empty()) {
        text += "\nwrong:\n" + indented(code.wrong) + "right:\n" + indented(code.right);
    }
    text += code.exit_code == 0 ? "\nA warning: it does not change the exit code.\n"
                                : fmt::format("\nExit code {}.\n", code.exit_code);
    return text;
}

void append_block(std::string& text, const std::string& block) {
    if (!text.empty()) text += '\n';
    text += block;
}

// Returns what the presets of that name say of themselves.
std::string explain_presets(std::string_view name) {
    std::string text;
    const auto append = [&](const Preset* preset) {
        if (preset) append_block(text, preset_comment(*preset));
    };
    append(find_preset(name));
    for (const SectionPresets& kind : section_presets()) append(find_preset(kind.all(), name));
    return text;
}

}  // namespace

std::optional<std::string> explain(std::string_view what) {
    if (const DiagnosticCode* code = find_diagnostic_code(what)) return explain_code(*code);
    const Names asked = names_of(what);
    if (asked.empty() || is_free(asked.front())) return std::nullopt;
    std::string text = explain_presets(what);
    for (const Section& section : sections()) {
        if (section_fits(asked, section)) append_block(text, explain_section(section));
    }
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            Names pattern = names_of(section.path);
            pattern.emplace_back(field.key);
            const bool fits = !is_free(asked.back()) && tail_fits(asked, pattern, section);
            if (fits) append_block(text, explain_field(section, field));
        }
    }
    if (text.empty()) return std::nullopt;
    return text;
}

std::string explain_all_keys() {
    std::string text;
    for (const Section& section : sections()) append_block(text, explain_section(section));
    return text;
}

std::vector<std::string> explained_names() {
    std::vector<std::string> names;
    for (const Section& section : sections()) {
        if (!section.path.empty()) names.push_back(section_path(section));
        for (const Field& field : section.fields) {
            names.push_back(field_path(section, field));
            names.emplace_back(field.key);
        }
    }
    for (const DiagnosticCode& code : diagnostic_codes()) names.emplace_back(code.code);
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace skybake::config
