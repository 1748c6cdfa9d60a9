#include "config/recipe/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

using Names = std::vector<std::string>;

// Returns what a bake section bakes: its `asset`, else its name.
std::string asset_of(const Table& table, const std::string& name) {
    const std::string* asset = find_text(table, "asset");
    return asset ? *asset : name;
}

// Returns the section of a table at these names, or null if it has no fields or is unknown.
const Section* section_of(const Names& names, const Table& table) {
    for (const Section& section : sections()) {
        if (!names_fit(names, section)) continue;
        if (section.asset.empty()) return &section;
        const Section* asset = find_section(section.path, asset_of(table, names.back()));
        // A section with another name and no asset is the volume of a cloud, or of a noise, whose
        // keys exclude no others.
        return asset || find_text(table, "asset") ? asset
                                                  : find_section(section.path, "cloud_volume");
    }
    return nullptr;
}

// Whether `over` drops the earlier value of this field because of the keys that it names.
bool is_dropped(const Field& field, const Section& section, const Table& over) {
    if (is_excluded(field, section, over)) return true;
    const std::string* needed = field.needs.empty() ? nullptr : find_text(over, field.needs);
    if (needed && needed->empty()) return true;
    if (field.selector.empty()) return false;
    const std::string* selected = find_text(over, field.selector);
    return selected && !applies(field, *selected);
}

using Keys = std::vector<std::string_view>;

// Keys of a layer that say what it is made of, in different words.
const Keys coefficient_keys = {"scattering", "extinction", "absorption", "single_scattering_albedo",
                               "angstrom_exponent"};
const Keys gas_keys = {"gas", "pressure", "column"};
const Keys sphere_keys = {"aerosol", "components", "relative_humidity"};
const Keys amount_keys = {"optical_depth", "visibility", "number_density"};
const Keys phase_keys = {"phase", "particles", "g", "depolarization"};

bool has_any(const Table& table, const Keys& keys) {
    return std::ranges::any_of(
        keys, [&](std::string_view key) { return find_entry(table, key) != nullptr; });
}

// Returns the keys of an earlier layer that a later one contradicts by what it says it is made of.
Keys contradicted_keys(const Table& over) {
    Keys dropped;
    const auto drop = [&](const Keys& keys) {
        dropped.insert(dropped.end(), keys.begin(), keys.end());
    };
    const bool of_spheres = has_any(over, {"aerosol", "components"});
    const bool of_particles = names_particles(over);
    if (of_spheres || of_particles) {
        drop(coefficient_keys);
        drop(gas_keys);
    }
    if (of_spheres) {
        drop(phase_keys);
        drop(amount_keys);
    } else if (of_particles || has_any(over, {"scattering", "extinction", "gas", "phase"})) {
        drop(sphere_keys);
    }
    if (!of_spheres && !of_particles && find_entry(over, "phase")) drop({"number_density"});
    return dropped;
}

void drop_alternatives(Table& base, const Table& over, const Section& section) {
    const Keys contradicted =
        section.path == "atmosphere.layers.*" ? contradicted_keys(over) : Keys{};
    std::erase_if(base, [&](const Entry& entry) {
        if (std::ranges::find(contradicted, entry.key) != contradicted.end()) {
            return true;
        }
        const Field* field = find_field(section, entry.key);
        return field && is_dropped(*field, section, over);
    });
}

bool names_another_asset(const Table& base, const Table& over, const Names& names) {
    if (names.size() != 2 || names[0] != "bake") return false;
    const std::string* asset = find_text(over, "asset");
    return asset && *asset != asset_of(base, names[1]);
}

void merge_at(Table& base, const Table& over, Names& names);

void merge_entry(Table& base, std::size_t known, const Entry& entry, Names& names) {
    const auto end = base.begin() + static_cast<std::ptrdiff_t>(known);
    const auto place = std::ranges::lower_bound(base.begin(), end, entry.key, {}, &Entry::key);
    if (place == end || place->key != entry.key) {
        base.push_back(entry);
        return;
    }
    auto* below = std::get_if<Table>(&place->value.data);
    const Table* above = as_table(entry.value);
    if (below && above && !entry.value.replaces) {
        names.push_back(entry.key);
        merge_at(*below, *above, names);
        names.pop_back();
    } else {
        *place = entry;
    }
}

void merge_at(Table& base, const Table& over, Names& names) {
    if (names_another_asset(base, over, names)) base.clear();
    const Table& says_asset = find_text(over, "asset") ? over : base;
    if (const Section* section = section_of(names, says_asset)) {
        drop_alternatives(base, over, *section);
    }
    const std::size_t known = base.size();
    for (const Entry& entry : over) merge_entry(base, known, entry, names);
    std::ranges::inplace_merge(base, base.begin() + static_cast<std::ptrdiff_t>(known), {},
                               &Entry::key);
}

void report_pair(const Entry& first, const Entry& second, const std::string& path,
                 DiagnosticList& diagnostics) {
    const bool in_order = reading_order(first.key_place) < reading_order(second.key_place);
    const Entry& earlier = in_order ? first : second;
    const Entry& later = in_order ? second : first;
    const std::string said =
        later.key_place.line > 0 ? fmt::format(" (line {})", earlier.key_place.line) : "";
    diagnostics.error("E0109", later.key_place,
                      fmt::format("`{}` and `{}` exclude each other", join_path(path, later.key),
                                  join_path(path, earlier.key)),
                      fmt::format("`{}` is given already{}: keep one", earlier.key, said));
}

void check_section(const Table& table, const Section& section, const std::string& path,
                   DiagnosticList& diagnostics) {
    for (std::size_t i = 0; i < section.fields.size(); ++i) {
        const Entry* first = find_entry(table, section.fields[i].key);
        if (!first) continue;
        for (std::size_t j = i + 1; j < section.fields.size(); ++j) {
            const Entry* second = find_entry(table, section.fields[j].key);
            if (second && exclude_each_other(section.fields[i], section.fields[j])) {
                report_pair(*first, *second, path, diagnostics);
            }
        }
    }
}

void check_at(const Table& table, Names& names, const std::string& path,
              DiagnosticList& diagnostics) {
    if (const Section* section = section_of(names, table)) {
        check_section(table, *section, path, diagnostics);
    }
    constexpr std::size_t deepest_section = 4;
    if (names.size() == deepest_section) return;
    for (const Entry& entry : table) {
        const Table* below = as_table(entry.value);
        if (!below) continue;
        names.push_back(entry.key);
        check_at(*below, names, join_path(path, entry.key), diagnostics);
        names.pop_back();
    }
}

// Renames the keys of a layer of particles. Any other layer stays as it is, so that its fault is
// reported.
void name_particles(Table& layer) {
    Entry* phase = find_entry(layer, "phase");
    const Table* inner = phase ? as_table(phase->value) : nullptr;
    const bool is_mie = inner && inner->size() == 1 && inner->front().key == "mie";
    if (!is_mie || find_entry(layer, "particles")) return;
    Entry particles = inner->front();
    phase->value.data = std::string("mie");
    particles.key = "particles";
    merge(layer, {std::move(particles)});
}

}  // namespace

Table* table_at(Table& parent, std::string_view key) {
    return const_cast<Table*>(find_table(parent, key));
}

void merge(Table& base, const Table& over) {
    Names names;
    merge_at(base, over, names);
}

void check_exclusive_keys(const Table& root, DiagnosticList& diagnostics) {
    Names names;
    check_at(root, names, "", diagnostics);
}

void name_particles_of_layers(Table& root) {
    Table* atmosphere = table_at(root, "atmosphere");
    Table* layers = atmosphere ? table_at(*atmosphere, "layers") : nullptr;
    if (!layers) return;
    for (Entry& entry : *layers) {
        if (auto* layer = std::get_if<Table>(&entry.value.data)) name_particles(*layer);
    }
}

bool names_particles(const Table& layer) {
    const std::string* text = find_text(layer, "phase");
    return text && *text == "mie";
}

}  // namespace skybake::config
