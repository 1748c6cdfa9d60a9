#include "config/fields/section_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/diagnostics/toml_source.h"
#include "config/fields/field_reader.h"
#include "config/presets/presets.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

// This is one section while it is read.
struct SectionReader {
    const Section& section;
    const Table& table;
    Absent absent;
    Decoder& decoder;
    DecodedSection result;

    // Returns the name that the field's selector has chosen, or none if the selector is missing or
    // at fault.
    std::optional<std::string_view> selected(const Field& field) const {
        const DecodedField& selector = result.at(field.selector);
        if (!selector.value) return std::nullopt;
        return selector.field->choices[std::get<ChoiceIndex>(*selector.value).index].name;
    }

    void report_misplaced(const Field& field, const Entry& entry, std::string_view found) const {
        const DecodedField& selector = result.at(field.selector);
        const std::string said =
            selector.source ? origin(selector.source->place) : std::string("the default");
        decoder.diagnostics.error(
            "E0111", entry.key_place,
            fmt::format("`{}` belongs to {} {}, but {} is {}", join_path(result.path, field.key),
                        field.selector, fmt::join(field.selected_by, " or "), field.selector,
                        found),
            fmt::format("{} = \"{}\" comes from {}", field.selector, found, said));
    }

    // Whether the field's selector is a key that does not apply here itself.
    bool selects_nothing(const Field& field) const {
        const Field& selector = *result.at(field.selector).field;
        if (selector.selector.empty()) return false;
        const std::optional<std::string_view> name = selected(selector);
        return name ? !applies(selector, *name) : selects_nothing(selector);
    }

    void report_without_selector(const Field& field, const Entry& entry) const {
        const Field& selector = *result.at(field.selector).field;
        decoder.diagnostics.error(
            "E0111", entry.key_place,
            fmt::format("`{}` belongs to {} {}, and there is no {} here",
                        join_path(result.path, field.key), field.selector,
                        fmt::join(field.selected_by, " or "), field.selector),
            fmt::format("{} goes with {} = \"{}\"", field.selector, selector.selector,
                        fmt::join(selector.selected_by, "\" or \"")));
    }

    // Whether the key that the field needs is there: a text that is not empty, or any other value.
    // A value at fault counts as there.
    bool has_needed(const Field& field) const {
        if (field.needs.empty()) return true;
        const DecodedField& needed = result.at(field.needs);
        if (!needed.value) return needed.source != nullptr;
        const auto* text = std::get_if<std::string>(&*needed.value);
        return text == nullptr || !text->empty();
    }

    void report_without_needed(const Field& field, const Entry& entry) const {
        decoder.diagnostics.error(
            "E0111", entry.key_place,
            fmt::format("`{}` belongs to {}, and there is none", join_path(result.path, field.key),
                        join_path(result.path, field.needs)),
            fmt::format("give {}, or leave {} out", field.needs, field.key));
    }

    void report_missing(const Field& field) const {
        if (!decoder.complete) return;
        Place place = result.place;
        std::string message = fmt::format("`{}` is missing", join_path(result.path, field.key));
        if (!field.selector.empty()) {
            const DecodedField& selector = result.at(field.selector);
            if (selector.source) place = selector.source->place;
            message += fmt::format(": {} {} needs it", field.selector, *selected(field));
        }
        std::string label = field.kind == Kind::choice ? "give it " + describe_choices(field)
                                                       : fmt::format("give {}", field.kind.words);
        if (!field.hint.empty()) label += "; " + std::string(field.hint);
        decoder.diagnostics.error("E0105", place, std::move(message), label);
    }

    void read(const Field& field, DecodedField& decoded) const {
        const Entry* entry = find_entry(table, field.key);
        if (!field.selector.empty()) {
            const std::optional<std::string_view> name = selected(field);
            if (name && !applies(field, *name)) {
                if (entry) report_misplaced(field, *entry, *name);
                return;
            }
            if (!name && !entry) return;
            if (!name && selects_nothing(field)) return report_without_selector(field, *entry);
        }
        if (!has_needed(field)) {
            if (entry && decoder.complete) report_without_needed(field, *entry);
            return;
        }
        if (entry) {
            decoded.source = &entry->value;
            decoded.value = read_field(field, join_path(result.path, field.key), entry->value,
                                       decoder.channels, decoder.diagnostics);
        } else if (absent == Absent::filled_in && !is_excluded(field, section, table)) {
            if (field.required) report_missing(field);
            decoded.value = default_value(field, decoder.channels);
        }
    }

    // Returns another table that has a key of this name, for a key that stands in the wrong table: the first
    // of its own tables, else the first of all.
    std::string home_of(std::string_view key) const {
        std::string home;
        for (const Section& other : sections()) {
            if (other.path == section.path && other.asset == section.asset) continue;
            const bool is_within = other.path.starts_with(fmt::format("{}.", section.path));
            const bool is_field = find_field(other, key) != nullptr;
            const std::vector<std::string_view> tables = subtables(other.path);
            if (!is_field && std::ranges::find(tables, key) == tables.end()) continue;
            if (!home.empty() && !is_within) continue;
            home = other.path.empty() ? fmt::format("`{}` belongs at the top level", key)
                   : !other.asset.empty()
                       ? fmt::format("`{}` is a key of asset {}", key, other.asset)
                       : fmt::format("`{}` belongs in [{}]", key, other.path);
            if (is_within) break;
        }
        return home;
    }

    // Returns what takes the place of a key that earlier releases had.
    std::string in_place_of(std::string_view key) const {
        const bool is_retired = section.path == "clouds.*"
                                    ? key == "scatter" || key == "shear"
                                    : section.path == "clouds.*.towers.*" && key == "shape";
        return is_retired ? "cumuli grow: give shape = \"convection\", with patches and wind_above"
                          : "";
    }

    void report_unknown(const Entry& entry) const {
        std::vector<std::string_view> known = field_keys(section);
        for (const std::string_view name : subtables(section.path)) known.push_back(name);
        const std::string where =
            result.path.empty() ? "at the top level" : fmt::format("in [{}]", result.path);
        std::string label = in_place_of(entry.key);
        if (label.empty() && as_table(entry.value)) {
            label = did_you_mean(entry.key, subtables(section.path));
            // Keys of a misspelt table are not reported as missing.
            if (!label.empty()) decoder.complete = false;
        }
        // A letter too few, too many or exchanged is a slip of the pen, whatever other sections have.
        const std::optional<std::string> near = nearest_name(entry.key, known);
        if (label.empty() && near && edit_distance(entry.key, *near) == 1) {
            label = did_you_mean(entry.key, known);
        }
        if (label.empty()) label = home_of(entry.key);
        if (label.empty()) label = did_you_mean(entry.key, known);
        if (label.empty()) label = "there is no such key";
        decoder.diagnostics.error("E0102", entry.key_place,
                                  fmt::format("unknown key `{}` {}", shorten(entry.key), where),
                                  std::move(label));
    }

    void report_unknown_keys() const {
        // More than anybody reads, and more than are shown.
        constexpr int most_explained = 1000;
        const std::vector<std::string_view> tables = subtables(section.path);
        int unknown = 0;
        for (const Entry& entry : table) {
            const bool is_table = std::ranges::find(tables, entry.key) != tables.end();
            if (is_table || find_field(section, entry.key)) continue;
            if (unknown++ < most_explained) {
                report_unknown(entry);
            } else {
                decoder.diagnostics.error("E0102", entry.key_place, "unknown key");
            }
        }
    }
};

// Returns the missing section as text if a preset can provide it, or an empty text.
std::string what_to_write(const ReferenceWords& words, const std::string& name) {
    if (words.code != noise_reference.code) return "";
    const CloudNoisePreset noise = noise_of_cloud_preset("", name);
    if (!noise.preset) return "";
    return fmt::format("add [noise.{}] with preset = \"{}\" and pack = \"{}\"", name,
                       noise.preset->name, noise.pack);
}

}  // namespace

const DecodedField* DecodedSection::find(std::string_view key) const {
    const auto key_of_field = [](const DecodedField& decoded) { return decoded.field->key; };
    const auto found = std::ranges::find(fields, key, key_of_field);
    return found == fields.end() ? nullptr : &*found;
}

const DecodedField& DecodedSection::at(std::string_view key) const {
    const DecodedField* found = find(key);
    assert(found != nullptr);
    return *found;
}

DecodedField& DecodedSection::at(std::string_view key) {
    return const_cast<DecodedField&>(std::as_const(*this).at(key));
}

std::optional<double> DecodedSection::number(std::string_view key) const {
    const auto* found = value<double>(key);
    return found ? std::optional(*found) : std::nullopt;
}

std::optional<int> DecodedSection::whole(std::string_view key) const {
    const auto* found = value<double>(key);
    return found ? std::optional(static_cast<int>(*found)) : std::nullopt;
}

const Place& DecodedSection::place_of(std::string_view key, std::string_view other) const {
    if (const Value* source = at(key).source) return source->place;
    return other.empty() ? place : place_of(other);
}

void Decoder::report(std::string_view code, const DecodedSection& section, std::string_view key,
                     std::string_view says, std::string label) const {
    std::string message = fmt::format("`{}`{}{}", join_path(section.path, key),
                                      says.starts_with(':') ? "" : " ", says);
    const bool is_error = code.starts_with('E');
    const auto add = is_error ? &DiagnosticList::error : &DiagnosticList::warning;
    (diagnostics.*add)(std::string(code), section.place_of(key), std::move(message),
                       std::move(label));
}

void check_name(const Entry& entry, const std::string& path, std::string_view what,
                Decoder& decoder) {
    if (is_bare_key(entry.key)) return;
    decoder.diagnostics.error("E0117", entry.key_place,
                              fmt::format("[{}] cannot be the name of {}", shorten(path), what),
                              "use only letters, digits, `_` and `-`");
}

DecodedSection decode_section(const Section& section, const std::string& path, const Place& place,
                              const Table& table, Absent absent, Decoder& decoder) {
    SectionReader reader{section, table, absent, decoder, {path, place, {}}};
    for (const Field& field : section.fields) reader.result.fields.push_back({&field});
    for (DecodedField& decoded : reader.result.fields) reader.read(*decoded.field, decoded);
    reader.report_unknown_keys();
    return std::move(reader.result);
}

bool is_excluded(const Field& field, const Section& section, const Table& table) {
    return std::ranges::any_of(section.fields, [&](const Field& other) {
        return exclude_each_other(field, other) && find_entry(table, other.key);
    });
}

const Table& subtable(const Table& table, std::string_view key, const std::string& path,
                      Decoder& decoder) {
    static const Table empty;
    const Entry* entry = find_entry(table, key);
    if (!entry) return empty;
    const Table* found = named_table(*entry, path, decoder);
    return found ? *found : empty;
}

const Table* named_table(const Entry& entry, const std::string& path, Decoder& decoder) {
    if (const Table* table = as_table(entry.value)) return table;
    decoder.diagnostics.error(
        "E0103", entry.value.place,
        fmt::format("`{}` must be a table, not {}", join_path(path, entry.key),
                    shorten(value_to_string(entry.value))),
        fmt::format("write [{}] and its keys below", join_path(path, entry.key)));
    return nullptr;
}

std::vector<const Entry*> in_reading_order(const Table& table) {
    auto entries = mapped<const Entry*>(table, [](const Entry& entry) { return &entry; });
    std::ranges::stable_sort(entries, {},
                             [](const Entry* entry) { return reading_order(entry->key_place); });
    return entries;
}

void append_values(const DecodedSection& section, Decoder& decoder) {
    for (const DecodedField& decoded : section.fields) {
        if (!decoded.value) continue;
        const Field& field = *decoded.field;
        const bool says_nothing = field.only_shown && !decoded.source;
        if (says_nothing) continue;
        ResolvedValue resolved;
        resolved.path = join_path(section.path, field.key);
        resolved.canonical = canonical_text(field, *decoded.value);
        resolved.section = section.path;
        resolved.role = field.role;
        resolved.only_shown = field.only_shown;
        if (decoded.source) {
            resolved.written = value_to_string(*decoded.source);
            resolved.origin = origin(decoded.source->place);
        } else {
            const bool spelled_in_table = !decoded.derived && !field.fallback.empty();
            resolved.written = spelled_in_table ? std::string(field.fallback) : resolved.canonical;
            resolved.origin = decoded.derived ? "derived" : "default";
        }
        decoder.values.push_back(std::move(resolved));
    }
}

void report_unknown_name(const DecodedSection& section, std::string_view key,
                         std::span<const std::string_view> names, const ReferenceWords& words,
                         Decoder& decoder) {
    const std::string& name = *section.value<std::string>(key);
    std::string label = did_you_mean(name, names);
    if (label.empty()) label = what_to_write(words, name);
    if (label.empty() && names.empty()) label = fmt::format("the recipe has no {}", words.section);
    if (label.empty()) label = fmt::format("this recipe has {}", fmt::join(names, ", "));
    const std::string wanted =
        is_bare_key(name)
            ? std::string(words.section).replace(words.section.find("NAME"), 4, shorten(name))
            : fmt::format("{} `{}`", words.noun, shorten(name));
    decoder.report(words.code, section, key, fmt::format(": the recipe has no {}", wanted),
                   std::move(label));
}

}  // namespace skybake::config
