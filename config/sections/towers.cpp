#include "config/sections/towers.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

// Returns a key for sorting. It compares digits of any count as numbers, by their count and then as
// text.
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

double narrowest_sigma(const Tower& tower, const std::array<int, 3>& size) {
    const double c = std::cos(tower.rotation.radians);
    const double s = std::sin(tower.rotation.radians);
    const double a = tower.sigma[0] * tower.sigma[0];
    const double b = tower.sigma[1] * tower.sigma[1];
    const double ab = tower.correlation * tower.sigma[0] * tower.sigma[1];
    const double xx = (c * c * a - 2 * c * s * ab + s * s * b) * size[0] * size[0];
    const double yy = (s * s * a + 2 * c * s * ab + c * c * b) * size[1] * size[1];
    const double xy = (c * s * (a - b) + (c * c - s * s) * ab) * size[0] * size[1];
    if (size[0] == 1 && size[1] == 1) return std::numeric_limits<double>::infinity();
    if (size[0] == 1) return std::sqrt(yy);
    if (size[1] == 1) return std::sqrt(xx);
    const double half_sum = 0.5 * (xx + yy);
    const double lesser = half_sum - std::hypot(0.5 * (xx - yy), xy);
    return std::sqrt(std::max(0.0, lesser));  // rounding may take it below 0
}

double narrowest_sigma(const TowerScatter& scatter, const std::array<int, 3>& size) {
    double voxels = std::numeric_limits<double>::infinity();
    for (const std::size_t axis : {0u, 1u}) {
        if (size[axis] > 1) voxels = std::min(voxels, scatter.sigma[0] * size[axis]);
    }
    return voxels;
}

}  // namespace skybake::config
