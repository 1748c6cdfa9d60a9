#include "config/sweep/sweep_decoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/diagnostics/toml_source.h"
#include "config/fields/field_reader.h"
#include "config/sweep/sobol.h"
#include "config/sweep/sweep_path.h"
#include "config/sweep/sweep_range.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

using Groups = std::vector<std::vector<std::string>>;

constexpr std::size_t alone = static_cast<std::size_t>(-1);

// This is a key that varies.
struct Swept {
    const Entry* entry = nullptr;
    SweptKey key;
    std::vector<SweepValue> values;   // the values of a list, or of a range with a count
    std::optional<SweptRange> range;  // a range without a count
    std::size_t group = alone;        // the group of keys that vary together
};

struct SweepReader {
    const Table& root;
    const Table& table;  // [sweep]
    Decoder& decoder;
    std::vector<Swept> keys = {};
    std::optional<int> points = {};  // the number that `sobol` gives

    void error(std::string code, const Place& place, std::string message, std::string label) const {
        decoder.diagnostics.error(std::move(code), place, std::move(message), std::move(label));
    }

    const Entry* own_key(std::string_view key) const { return find_entry(table, key); }

    std::optional<FieldValue> read_own(std::string_view key) const {
        const Entry* entry = own_key(key);
        if (!entry) return std::nullopt;
        const Field& field = *find_field(*find_section("sweep"), key);
        return read_field(field, join_path("sweep", key), entry->value, std::nullopt,
                          decoder.diagnostics);
    }

    // Returns all entries except the section's own keys, in the order in which they are written.
    std::vector<const Entry*> entries() const {
        std::vector<const Entry*> result = in_reading_order(table);
        std::erase_if(result, [](const Entry* entry) {
            return find_field(*find_section("sweep"), entry->key) != nullptr;
        });
        return result;
    }

    bool read_list(const Array& list, Swept& swept) const {
        const Entry& entry = *swept.entry;
        if (list.empty() || list.size() > std::size_t{most_variants}) {
            error(list.empty() ? "E0108" : "E0137", entry.value.place,
                  fmt::format("`{}` has {} values", swept.key.path, list.size()),
                  fmt::format("give 1 to {}", most_variants));
            return false;
        }
        bool valid = true;
        for (const Value& value : list) {
            valid = check_form(*swept.key.field, swept.key.path, value, decoder) && valid;
            swept.values.push_back(sweep_value(value));
        }
        return valid;
    }

    bool read_range_of(Swept& swept) const {
        swept.range = read_range(*swept.key.field, swept.key.path, *swept.entry, decoder);
        if (!swept.range) return false;
        if (!swept.range->count) return true;
        auto values = range_values(*swept.range, swept.key.path, *swept.entry, decoder);
        if (!values) return false;
        swept.values = std::move(*values);
        swept.range.reset();
        return true;
    }

    // Returns how many values an entry asks for, as far as this can be seen without reading them.
    static std::size_t asked_values(const Value& value) {
        if (const auto* list = std::get_if<Array>(&value.data)) return list->size();
        const Table* range = as_table(value);
        const Entry* count = range ? find_entry(*range, "count") : nullptr;
        const auto* number = count ? std::get_if<std::int64_t>(&count->value.data) : nullptr;
        return number && *number > 0 && *number <= most_variants ? static_cast<std::size_t>(*number)
                                                                 : 1;
    }

    bool read_values(Swept& swept) const {
        const Value& value = swept.entry->value;
        if (const auto* list = std::get_if<Array>(&value.data)) return read_list(*list, swept);
        if (as_table(value)) return read_range_of(swept);
        error("E0103", value.place,
              fmt::format("`{}` should vary, but {} is one value", swept.key.path,
                          shorten(value_to_string(value))),
              "expected a list [...], or { from = ..., to = ..., count = ... }");
        return false;
    }

    // Reports two paths that mean the same key, and keys that exclude each other.
    bool check_against_others(const Swept& swept) const {
        for (const Swept& other : keys) {
            const bool same = other.key.path == swept.key.path;
            const bool rivals = other.key.table == swept.key.table &&
                                exclude_each_other(*swept.key.field, *other.key.field);
            if (!same && !rivals) continue;
            error("E0109", swept.entry->key_place,
                  same ? fmt::format("`{}` varies twice", swept.key.path)
                       : fmt::format("`{}` and `{}` exclude each other", swept.key.path,
                                     other.key.path),
                  "keep one");
            return false;
        }
        return true;
    }

    void read_keys() {
        constexpr std::size_t most_keys = 64;
        constexpr std::size_t most_values = 4 * most_variants;
        std::size_t listed = 0;
        for (const Entry* entry : entries()) {
            listed += asked_values(entry->value);
            if (keys.size() == most_keys || listed > most_values) {
                error("E0137", entry->key_place, "too much varies",
                      fmt::format("at most {} keys may vary, with {} values together", most_keys,
                                  most_values));
                return;
            }
            auto key = find_swept_key(root, entry->key, entry->key_place, decoder);
            if (!key) continue;
            Swept swept{entry, std::move(*key), {}, {}, alone};
            if (!check_against_others(swept)) continue;
            if (read_values(swept)) keys.push_back(std::move(swept));
        }
    }

    Swept* find_key(const std::string& path) {
        const auto names = split_path(path);
        std::string wanted;
        for (const std::string& name : names.value_or(std::vector<std::string>{})) {
            wanted = join_path(wanted, name);
        }
        for (Swept& swept : keys) {
            if (swept.key.path == wanted) return &swept;
        }
        return nullptr;
    }

    // Says what keeps a path from joining a group whose first member is given. `first` is null if
    // the path is the first.
    std::string obstacle(const Swept* swept, const Swept* first) const {
        if (!swept) return "does not vary";
        if (swept->group != alone) return "is named twice";
        if (swept->range) return "has no count, so it follows `sobol`";
        if (first && first->values.size() != swept->values.size()) {
            return fmt::format("has {} values, and `{}` has {}", swept->values.size(),
                               first->key.path, first->values.size());
        }
        return "";
    }

    void read_groups() {
        const auto read = read_own("zip");
        if (!read) return;
        const auto& groups = std::get<Groups>(*read);
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const Swept* first = nullptr;
            for (const std::string& path : groups[i]) {
                Swept* swept = find_key(path);
                const std::string fault = obstacle(swept, first);
                if (!fault.empty()) {
                    error(
                        "E0136", own_key("zip")->value.place,
                        fmt::format("`{}` cannot be zipped: it {}", shorten(path), fault),
                        "zip takes paths that vary, each once, with as many values as the others");
                    return;
                }
                swept->group = i;
                if (!first) first = swept;
            }
        }
    }

    void read_points() {
        const auto read = read_own("sobol");
        if (read) points = static_cast<int>(std::get<double>(*read));
        const auto without_count =
            std::ranges::count_if(keys, [](const Swept& swept) { return swept.range.has_value(); });
        if (own_key("sobol") && without_count == 0 && !decoder.diagnostics.has_errors()) {
            error("E0135", own_key("sobol")->key_place, "there is no range for `sobol` to cover",
                  "it covers the ranges without a count");
        }
        if (without_count > sobol_dimensions) {
            error("E0135", own_key("sobol") ? own_key("sobol")->key_place : Place{},
                  fmt::format("{} ranges are without a count", without_count),
                  fmt::format("Sobol points cover at most {}", sobol_dimensions));
        }
        for (const Swept& swept : keys) {
            if (!swept.range || own_key("sobol")) continue;
            error("E0135", swept.entry->key_place,
                  fmt::format("the range of `{}` has no count", swept.key.path),
                  "give it a `count`, or give [sweep] `sobol`, a number of points");
        }
    }

    // Returns the keys that vary together, beginning with the key at `first`, or that key alone.
    std::vector<const Swept*> members(std::size_t first) const {
        const Swept& leader = keys[first];
        std::vector<const Swept*> result;
        for (const Swept& swept : keys) {
            const bool together = leader.range
                                      ? swept.range.has_value()
                                      : leader.group != alone && swept.group == leader.group;
            if (together || &swept == &leader) result.push_back(&swept);
        }
        return result;
    }

    std::size_t row_count(const Swept& leader) const {
        return leader.range ? static_cast<std::size_t>(*points) : leader.values.size();
    }

    SweepAxis make_axis(const std::vector<const Swept*>& walkers) const {
        SweepAxis axis;
        for (const Swept* swept : walkers) axis.paths.push_back(swept->key.path);
        for (std::size_t row = 0; row < row_count(*walkers.front()); ++row) {
            std::vector<SweepValue> values;
            for (std::size_t k = 0; k < walkers.size(); ++k) {
                if (walkers[k]->range) {
                    const double share =
                        sobol_coordinate(static_cast<std::uint32_t>(row), static_cast<int>(k));
                    values.push_back(value_at_share(*walkers[k]->range, share));
                } else {
                    values.push_back(walkers[k]->values[row]);
                }
            }
            axis.rows.push_back(std::move(values));
        }
        return axis;
    }

    Sweep make_sweep() const {
        Sweep sweep;
        std::vector<std::vector<const Swept*>> axes;
        double count = 1;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            std::vector<const Swept*> walkers = members(i);
            if (walkers.front() != &keys[i]) continue;  // an earlier key leads the axis
            count *= static_cast<double>(row_count(keys[i]));
            axes.push_back(std::move(walkers));
        }
        if (count > most_variants) {
            error("E0137", keys.back().entry->key_place,
                  fmt::format("the values make {:.3g} variants", count),
                  fmt::format("at most {} are allowed", most_variants));
            return sweep;
        }
        for (const auto& walkers : axes) sweep.axes.push_back(make_axis(walkers));
        return sweep;
    }

    void append_values() const {
        for (const Entry& entry : table) {
            ResolvedValue value;
            value.path = join_path("sweep", entry.key);
            value.written = value_to_string(entry.value);
            value.canonical = value.written;
            value.origin = origin(entry.value.place);
            value.only_shown = true;
            decoder.values.push_back(std::move(value));
        }
    }
};

}  // namespace

Sweep decode_sweep(const Table& root, Decoder& decoder) {
    SweepReader reader{root, subtable(root, "sweep", "", decoder), decoder};
    reader.append_values();
    reader.read_keys();
    reader.read_groups();
    reader.read_points();
    if (decoder.diagnostics.has_errors() || reader.keys.empty()) return {};
    return reader.make_sweep();
}

}  // namespace skybake::config
