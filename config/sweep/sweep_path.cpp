#include "config/sweep/sweep_path.h"

#include <fmt/format.h>

#include <vector>

#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

using Names = std::vector<std::string>;

bool is_of_sweep(const Section& section) { return section.path.starts_with("sweep"); }

// Returns the table at these names, or null if there is none.
const Table* table_at(const Table& root, const Names& names, std::size_t count) {
    const Table* table = &root;
    for (std::size_t i = 0; table && i < count; ++i) {
        table = find_table(*table, names[i]);
    }
    return table;
}

// Returns the section of the recipe's table at these names, or null if no table can be there.
const Section* section_at(const Table& root, const Names& names) {
    for (const Section& section : sections()) {
        if (is_of_sweep(section) || !names_fit(names, section)) continue;
        if (section.asset.empty()) return &section;
        const Table* table = table_at(root, names, names.size());
        const std::string* asset = table ? find_text(*table, "asset") : nullptr;
        return find_section(section.path, asset ? *asset : names.back());
    }
    return nullptr;
}

struct PathReader {
    const Table& root;
    const std::string& path;
    const Place& place;
    Decoder& decoder;

    std::nullopt_t error(std::string message, std::string label) const {
        decoder.diagnostics.error("E0102", place, std::move(message), std::move(label));
        return std::nullopt;
    }

    // Returns where a table of the recipe has the key, or one whose last words are these.
    std::string path_meant(const std::string& key) const {
        for (const Section& other : sections()) {
            if (is_of_sweep(other) || other.path.empty() || !other.asset.empty()) continue;
            for (const std::string_view known : field_keys(other)) {
                if (known == key || known.ends_with("_" + key)) {
                    return fmt::format("did you mean `{}.{}`?", other.path, known);
                }
            }
        }
        return "";
    }

    std::nullopt_t report_no_key(const Section& section, const std::string& table,
                                 const std::string& key) const {
        std::string label = did_you_mean(key, field_keys(section));
        if (label.empty()) label = path_meant(key);
        if (label.empty()) {
            label =
                "write the path of a key, atmosphere.ground_albedo for example; `skybake show` "
                "lists those of the recipe";
        }
        const std::string where =
            table.empty() ? "at the top level" : fmt::format("in [{}]", shorten(table));
        return error(fmt::format("unknown key `{}` {}", shorten(key), where), std::move(label));
    }

    // Whether each table that the user names is one of the recipe's.
    bool has_named_tables(const Names& names, const Section& section) const {
        const std::vector<std::string_view> pattern = path_names(section);
        std::string known;
        for (std::size_t i = 0; i < pattern.size(); ++i) {
            const Table* parent = table_at(root, names, i);
            const bool is_missing = !parent || !find_entry(*parent, names[i]);
            known = join_path(known, names[i]);
            if (pattern[i] != "*" || !is_missing || !decoder.complete) continue;
            report_no_table(known, names[i], parent);
            return false;
        }
        return true;
    }

    void report_no_table(const std::string& missing, const std::string& name,
                         const Table* parent) const {
        std::vector<std::string_view> others;
        if (parent) {
            for (const Entry& entry : *parent) others.push_back(entry.key);
        }
        std::string label = did_you_mean(name, others);
        if (label.empty()) label = "`skybake show` lists what the recipe has";
        error(fmt::format("the recipe has no [{}] to vary", shorten(missing)), std::move(label));
    }
};

}  // namespace

std::optional<SweptKey> find_swept_key(const Table& root, const std::string& path,
                                       const Place& place, Decoder& decoder) {
    const PathReader reader{root, path, place, decoder};
    auto names = split_path(path);
    if (!names) {
        return reader.error(fmt::format("`{}` in [sweep] is not the path of a key", shorten(path)),
                            "for example \"clouds.cumulus.coverage\", in quotes");
    }
    const std::string key = names->back();
    names->pop_back();
    SweptKey result;
    for (const std::string& name : *names) result.table = join_path(result.table, name);
    result.path = join_path(result.table, key);
    result.section = section_at(root, *names);
    if (!result.section) {
        return reader.error(fmt::format("no table of a recipe has a key `{}`", shorten(path)),
                            "`skybake explain` lists all keys");
    }
    if (result.section->path.starts_with("preview")) {
        return reader.error(
            fmt::format("`{}` changes pictures alone", shorten(path)),
            "a sweep varies what is baked; `skybake preview` takes this as an option");
    }
    if (!reader.has_named_tables(*names, *result.section)) return std::nullopt;
    result.field = find_field(*result.section, key);
    if (!result.field) return reader.report_no_key(*result.section, result.table, key);
    return result;
}

}  // namespace skybake::config
