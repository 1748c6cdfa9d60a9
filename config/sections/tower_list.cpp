#include "config/sections/tower_list.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace skybake::config {
namespace {

Table named_by_index(Array items) {
    Table table;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Place place = items[i].place;
        table.push_back({std::to_string(i), place, std::move(items[i])});
    }
    std::sort(table.begin(), table.end(),
              [](const Entry& a, const Entry& b) { return a.key < b.key; });
    return table;
}

// Digits compare as numbers by their count and then as text, however many there are.
auto order_of(const std::string& name) {
    const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
    const std::string digits =
        is_number ? name.substr(std::min(name.find_first_not_of('0'), name.size())) : "";
    return std::make_tuple(!is_number, digits.size(), digits, name);
}

}  // namespace

void name_listed_towers_of_cloud(Table& cloud) {
    Entry* towers = find_entry(cloud, "towers");
    auto* items = towers ? std::get_if<Array>(&towers->value.data) : nullptr;
    if (!items) return;
    Table named = named_by_index(std::move(*items));
    towers->value.data = std::move(named);
    towers->value.replaces = true;
}

void name_listed_towers(Table& root) {
    Entry* clouds = find_entry(root, "clouds");
    auto* named = clouds ? std::get_if<Table>(&clouds->value.data) : nullptr;
    if (!named) return;
    for (Entry& entry : *named) {
        if (auto* cloud = std::get_if<Table>(&entry.value.data)) {
            name_listed_towers_of_cloud(*cloud);
        }
    }
}

std::vector<const Entry*> towers_in_order(const Table& towers) {
    std::vector<const Entry*> entries;
    for (const Entry& entry : towers) entries.push_back(&entry);
    std::sort(entries.begin(), entries.end(),
              [](const Entry* a, const Entry* b) { return order_of(a->key) < order_of(b->key); });
    return entries;
}

}  // namespace skybake::config
