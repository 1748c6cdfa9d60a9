#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range center_range{-16, 16};  // tiles
constexpr Range sigma_range{1e-6, 16};  // tiles
constexpr Range angle_range{-1e3, 1e3};
constexpr Range correlation_range{-0.999999, 0.999999};
constexpr Range amplitude_range{0, 1e6};

constexpr ValueKind life_kind = list_kind("three numbers, such as [0.4, 0.3, 0.3]", read_triple,
                                          numbers_schema, &Scales::plain, 3, 3);

constexpr std::string_view byers_1949 = "Byers and Braham 1949, The Thunderstorm";

const TowerField tower_table[] = {
    {"center", Kind::pair, &Tower::center, "x and y of the tower's middle, in tiles", center_range,
     KeyFlag::required, Hint{"[0.5, 0.5] is the middle of the cloud"}, Cited{olajos_2016}},
    {"sigma", Kind::pair, &Tower::sigma, "standard deviations along the tower's own axes, in tiles",
     sigma_range, KeyFlag::required, Hint{"for example [0.03, 0.06]"}, Cited{olajos_2016}},
    {"rotation", Kind::angle, &Tower::rotation,
     "angle of the tower's axes against x and y, counterclockwise", angle_range,
     Default{R"("0 deg")"}},
    {"correlation", Kind::number, &Tower::correlation,
     "correlation between the tower's own axes, before rotation", correlation_range, Default{"0"}},
    {"amplitude", Kind::number, &Tower::amplitude,
     "what the tower adds to the height profile at its middle", amplitude_range, KeyFlag::required,
     Cited{olajos_2016}},
    {"life", life_kind, &Tower::life,
     "how long the tower grows, stays and dissolves, as shares of the cloud's "
     "`period`; without it the tower stands",
     unit_range,
     Hint{"after shares that add up to 1, such as [0.4, 0.3, 0.3], it is born again at once"},
     Cited{byers_1949}},
    {"grows_from", Kind::number, &Tower::grows_from,
     "width of a tower that is born, as a share of its full width; its height "
     "grows from 0",
     unit_range, Default{"0.4"}, Needs{"life"}},
    {"born", Kind::number, &Tower::born,
     "when the tower is born, as a share of the cloud's `period`", unit_range, Default{"0"},
     Needs{"life"}},
};

}  // namespace

std::span<const TowerField> tower_fields() { return tower_table; }

}  // namespace skybake::config
