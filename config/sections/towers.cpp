#include "config/sections/towers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "config/text/key_path.h"

namespace skybake::config {
namespace {

Table named_by_index(Array items) {
    Table table;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Place place = items[i].place;
        table.push_back({std::to_string(i), place, std::move(items[i])});
    }
    std::ranges::sort(table, [](const Entry& a, const Entry& b) { return a.key < b.key; });
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

// Returns what is wrong with a life in a loop, or nothing.
std::string fault_of_life(const TowerLife& tower, const Cloud& cloud) {
    const auto [grows, stays, dissolves] = tower.life;
    if (cloud.period == 0) return "the cloud has no loop: give it a `period`";
    if (grows <= 0 || dissolves <= 0) return "a tower that appears or disappears at once jumps";
    constexpr double rounding = 1e-12;  // of the sum of three decimal numbers
    if (grows + stays + dissolves > 1 + rounding) {
        return fmt::format("they add up to {:g}, and the tower is born again after 1",
                           grows + stays + dissolves);
    }
    return "";
}

bool is_whole(double tiles) { return tiles == std::floor(tiles); }

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
    std::ranges::sort(entries, [](const Entry* a, const Entry* b) {
        return order_of(a->key) < order_of(b->key);
    });
    return entries;
}

bool towers_move(const Cloud& cloud) {
    if (cloud.period == 0) return false;
    const bool drifts = cloud.drift != std::array<double, 2>{};
    const auto lives = [&](const TowerLife& tower) { return drifts || tower.lives(); };
    return std::ranges::any_of(cloud.towers, lives);
}

void check_life(const DecodedSection& section, const TowerLife& tower, const Cloud& cloud,
                Decoder& decoder) {
    const DecodedField& life = section.at("life");
    if (life.source && life.value) {
        const std::string fault = fault_of_life(tower, cloud);
        if (fault.empty()) return;
        decoder.report("E0182", section, "life", "is no life within a loop",
                       fault + "; [0.4, 0.3, 0.3] is one");
        return;
    }
    if (cloud.period == 0 || (is_whole(cloud.drift[0]) && is_whole(cloud.drift[1]))) return;
    decoder.diagnostics.error(
        "E0182", section.place,
        fmt::format("the tower [{}] does not return to its start: `drift` is [{:g}, {:g}] tiles",
                    section.path, cloud.drift[0], cloud.drift[1]),
        "give whole tiles as `drift` of the cloud, or give the tower a `life`");
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

}  // namespace skybake::config
