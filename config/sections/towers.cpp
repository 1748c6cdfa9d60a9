#include "config/sections/towers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "config/fields/fields.h"
#include "config/sections/sections.h"
#include "config/text/mapped.h"

namespace skybake::config {

namespace {

Table named_by_index(Array items) {
    Table table;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Place place = items[i].place;
        table.push_back({std::to_string(i), place, std::move(items[i])});
    }
    std::ranges::sort(table, {}, &Entry::key);
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

constexpr ValueKind life_kind = list_kind("three numbers, such as [0.4, 0.3, 0.3]", read_triple,
                                          numbers_schema, &Scales::plain, 3, 3);

const Row<Tower> tower_table[] = {
    {"center", Kind::pair, &Tower::center, "x and y of the tower's middle, in tiles",
     Range{-16, 16}, KeyFlag::required, Hint{"[0.5, 0.5] is the middle of the cloud"},
     Cited{olajos_2016}},
    {"sigma", Kind::pair, &Tower::sigma, "standard deviations along the tower's own axes, in tiles",
     Range{1e-6, 16}, KeyFlag::required, Hint{"for example [0.03, 0.06]"}, Cited{olajos_2016}},
    {"rotation", Kind::angle, &Tower::rotation,
     "angle of the tower's axes against x and y, counterclockwise", Range{-1e3, 1e3},
     Default{R"("0 deg")"}},
    {"correlation", Kind::number, &Tower::correlation,
     "correlation between the tower's own axes, before rotation", Range{-0.999999, 0.999999},
     Default{"0"}},
    {"amplitude", Kind::number, &Tower::amplitude,
     "what the tower adds to the height profile at its middle", Range{0, 1e6}, KeyFlag::required,
     Cited{olajos_2016}},
    {"life", life_kind, &Tower::life,
     "how long the tower grows, stays and dissolves, as shares of the cloud's `period`; without it "
     "the tower stands",
     unit_range,
     Hint{"after shares that add up to 1, such as [0.4, 0.3, 0.3], it is born again at once"},
     Cited{"Byers and Braham 1949, The Thunderstorm"}},
    {"grows_from", Kind::number, &Tower::grows_from,
     "width of a tower that is born, as a share of its full width; its height grows from 0",
     unit_range, Default{"0.4"}, Needs{"life"}},
    {"born", Kind::number, &Tower::born,
     "when the tower is born, as a share of the cloud's `period`", unit_range, Default{"0"},
     Needs{"life"}},
};

constexpr Range inversion_range{1e-4, 1e8};   // 0.7 times any extent lies within
constexpr Range temperature_range{240, 308};  // Bolton's formula of saturation holds
constexpr Range wind_range{-200, 200};

const Row<Convection> convection_table[] = {
    {"cells", Kind::voxels, &Convection::cells,
     "cells over the cloud's extent along x, y and z, in which the air moves", Range{8, 512},
     KeyFlag::required, Hint{"products of 2, 3 and 5, along x and y even; edges of 20 to 50 m"}},
    {"mixed_layer", Kind::length, &Convection::mixed_layer,
     "depth of the layer below the base, from whose floor warm air rises", Range{1, 1e4},
     Default{R"("600 m")"}, Hint{"it adds cells below the cloud"}},
    {"inversion", Kind::length, &Convection::inversion,
     "height above the base at which stable air begins; 0.7 times that of the extent by default",
     inversion_range},
    {"instability", Kind::number, &Convection::instability,
     "kelvin per kilometre by which the air below the inversion cools faster than what rises in "
     "cloud",
     Range{-20, 20}, Default{"1.5"}, Hint{"0.5 keeps cumulus low, 3 makes towers"}},
    {"temperature", Kind::number, &Convection::temperature, "temperature at the base in kelvin",
     temperature_range, Default{"288"}, Hint{"warmer air holds more water"}},
    {"humidity", Kind::fraction, &Convection::humidity, "relative humidity above the base",
     unit_range, Default{"0.7"}, Hint{"dry air eats what mixes with it"}},
    {"wind", Kind::pair, &Convection::wind, "wind along x and y up to the base, in m/s", wind_range,
     Default{"[0, 0]"},
     Hint{"the tile moves with the mean wind; only its change with height leans"}},
    {"wind_above", Kind::pair, &Convection::wind_above,
     "wind along x and y at the inversion, in m/s", wind_range, Default{"[0, 0]"}},
    {"patches", Kind::integer, &Convection::patches, "number of warm patches of ground",
     Range{0, 10000}, Default{"12"}},
    {"patch_width", Kind::length_bounds, &Convection::patch_width,
     "range of the width of a patch, within which it is warmer by more than 1/e", Range{1, 1e6},
     Default{R"(["0.4 km", "1.2 km"])"}},
    {"warmth", Kind::number, &Convection::warmth, "kelvin by which air above a patch is warmed",
     Range{0, 20}, Default{"0.6"}},
    {"seed", Kind::seed, &Convection::seed, "another seed gives other patches", Default{"1"}},
    {"minutes", Kind::number, &Convection::minutes, "minutes for which the cloud grows",
     Range{.minimum = 0, .maximum = 600, .open_minimum = true}, Default{"20"}},
    {"loop_minutes", Kind::number, &Convection::loop_minutes,
     "minutes of the flow that a loop of the cloud's `period` frames shows, at most those "
     "for which it grows; two seconds per frame by default",
     Range{0, 600}, Hint{"the last frames of a loop turn into the first ones"}},
    {"relief", Kind::number, &Convection::relief,
     "how far the cloud's detail noise moves its edge, outwards where the noise is 1 and inwards "
     "where it is 0, as a share of the width of the largest billows of the noise",
     Range{0, 1}, Default{"0.7"},
     Hint{"it is less near the base, which stays flat, and near the top"}},
};

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
    auto entries = mapped<const Entry*>(towers, [](const Entry& entry) { return &entry; });
    std::ranges::sort(entries, {}, [](const Entry* entry) { return order_of(entry->key); });
    return entries;
}

bool cloud_moves(const Cloud& cloud) {
    if (cloud.period == 0) return false;
    if (cloud.shape == CloudShape::convection) return cloud.convection.loop_minutes > 0;
    const bool drifts = cloud.drift != std::array<double, 2>{};
    const auto lives = [&](const TowerLife& tower) { return drifts || tower.lives(); };
    return std::ranges::any_of(cloud.towers, lives);
}

void check_life(const DecodedSection& section, const TowerLife& tower, const Cloud& cloud,
                Decoder& decoder) {
    if (section.at("life").value) {
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

std::span<const Row<Tower>> tower_fields() { return tower_table; }

std::span<const Row<Convection>> convection_fields() { return convection_table; }

}  // namespace skybake::config
