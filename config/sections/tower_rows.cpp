#include <array>
#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range foot_range{-1e8, 1e8};
constexpr Range center_range{-16, 16};  // tiles
constexpr Range sigma_range{1e-6, 16};  // tiles
constexpr Range scatter_sigma_range{1e-6, 1};
constexpr Range angle_range{-1e3, 1e3};
constexpr Range correlation_range{-0.999999, 0.999999};
constexpr Range tower_count_range{0, 100000};
constexpr Range tower_aspect_range{1, 10};
constexpr Range dome_size_range{1e-3, 1e8};
constexpr Range lobes_range{0, 1000};
constexpr Range lobe_size_range{0.01, 1};
constexpr Range slenderness_range{0.01, 100};
constexpr Range amplitude_range{0, 1e6};
constexpr Range lean_range{-10, 10};

constexpr ValueKind life_kind = list_kind("three numbers, such as [0.4, 0.3, 0.3]", read_triple,
                                          numbers_schema, &Scales::plain, 3, 3);

constexpr std::string_view byers_1949 = "Byers and Braham 1949, The Thunderstorm";

constexpr Choice tower_shape_choices[] = {
    {TowerShape::gaussian, "gaussian", "a Gaussian over the ground plan, at every height"},
    {TowerShape::dome, "dome", "a solid with a round top, in metres"},
};

// These are the shapes for which a key applies.
constexpr std::string_view gaussian[] = {"gaussian"};
constexpr std::string_view dome[] = {"dome"};

// Towers and scatters share the keys of domes.
constexpr Field shape_field =
    key("shape", Kind::choice, "what a tower is", tower_shape_choices, Default{R"("gaussian")"});
constexpr Field widest_field =
    key("widest", Kind::number,
        "height of the widest place, as a share of the tower's height; above and "
        "below it the tower narrows as an ellipsoid does",
        unit_range, Default{"0"},
        Hint{"0 gives a dome on a flat base, 0.5 a ball, and 1 an anvil with a flat top"},
        When{"shape", dome});
constexpr Field lean_field = key("lean", Kind::pair,
                                 "how far the wind shifts the tower along x and y, per "
                                 "height",
                                 lean_range, Default{"[0, 0]"}, When{"shape", dome});
constexpr Field lobes_field =
    key("lobes", Kind::integer, "number of balls that bulge out of the tower, as on a cauliflower",
        lobes_range, Default{"0"}, When{"shape", dome});
constexpr Field lobe_size_field = key(
    "lobe_size", Kind::bounds, "range of the radius of a lobe, over the lesser radius of its tower",
    lobe_size_range, Default{"[0.3, 0.55]"}, When{"shape", dome});
constexpr Field life_field =
    key("life", life_kind,
        "how long the tower grows, stays and dissolves, as shares of the cloud's "
        "`period`; without it the tower stands",
        unit_range,
        Hint{"after shares that add up to 1, such as [0.4, 0.3, 0.3], it is born again at once"},
        Cited{byers_1949});
constexpr Field grows_from_field =
    key("grows_from", Kind::number,
        "width of a tower that is born, as a share of its full width; its height "
        "grows from 0",
        unit_range, Default{"0.4"}, Needs{"life"});

const TowerField tower_table[] = {
    {shape_field, &Tower::shape},
    {"center", Kind::pair, &Tower::center, "x and y of the tower's middle, in tiles", center_range,
     KeyFlag::required, Hint{"[0.5, 0.5] is the middle of the cloud"}, When{"shape", gaussian},
     Cited{olajos_2016}},
    {"sigma", Kind::pair, &Tower::sigma, "standard deviations along the tower's own axes, in tiles",
     sigma_range, KeyFlag::required, Hint{"for example [0.03, 0.06]"}, When{"shape", gaussian},
     Cited{olajos_2016}},
    {"foot", Kind::lengths, &Tower::foot,
     "x and y of the tower's middle, and how high above the cloud's "
     "base it begins",
     foot_range, KeyFlag::required, Hint{"a height below 0 cuts its foot off"},
     When{"shape", dome}},
    {"size", Kind::lengths, &Tower::size, "widths along the tower's own axes, and its height",
     dome_size_range, KeyFlag::required, When{"shape", dome}},
    {"rotation", Kind::angle, &Tower::rotation,
     "angle of the tower's axes against x and y, counterclockwise", angle_range,
     Default{R"("0 deg")"}},
    {"correlation", Kind::number, &Tower::correlation,
     "correlation between the tower's own axes, before rotation", correlation_range, Default{"0"},
     When{"shape", gaussian}},
    {"amplitude", Kind::number, &Tower::amplitude,
     "what the tower adds to the height profile at its middle", amplitude_range, KeyFlag::required,
     Cited{olajos_2016}},
    {widest_field, &Tower::widest},
    {lean_field, &Tower::lean},
    {lobes_field, &Tower::lobes},
    {lobe_size_field, &Tower::lobe_size},
    {"seed", Kind::seed, &Tower::seed, "another seed gives other lobes", Default{"0"},
     When{"shape", dome}},
    {life_field, &Tower::life},
    {grows_from_field, &Tower::grows_from},
    {"born", Kind::number, &Tower::born,
     "when the tower is born, as a share of the cloud's `period`", unit_range, Default{"0"},
     Needs{"life"}},
};

const TowerScatterField tower_scatter_table[] = {
    {shape_field, &TowerScatter::shape},
    {"count", Kind::integer, &TowerScatter::count, "number of towers", tower_count_range,
     Default{"0"}},
    {"seed", Kind::seed, &TowerScatter::seed, "another seed gives other places", Default{"0"}},
    {"sigma", Kind::bounds, &TowerScatter::sigma,
     "range of the standard deviation along the smaller axis, "
     "in tiles; its logarithm is uniform",
     scatter_sigma_range, Default{"[0.02, 0.05]"}, When{"shape", gaussian}},
    {"width", Kind::length_bounds, &TowerScatter::width,
     "range of the width along the smaller axis; its logarithm "
     "is uniform",
     dome_size_range, Default{R"(["300 m", "900 m"])"}, When{"shape", dome}},
    {"slenderness", Kind::bounds, &TowerScatter::slenderness,
     "range of the height over the width of the smaller axis", slenderness_range,
     Default{"[0.6, 1]"}, When{"shape", dome}},
    {"aspect", Kind::bounds, &TowerScatter::aspect,
     "range of the ratio of the larger axis to the smaller one", tower_aspect_range,
     Default{"[1, 2]"}},
    {"amplitude", Kind::bounds, &TowerScatter::amplitude,
     "range of what a tower adds to the height profile", amplitude_range, Default{"[0.2, 0.5]"}},
    {widest_field, &TowerScatter::widest},
    {lean_field, &TowerScatter::lean},
    {lobes_field, &TowerScatter::lobes},
    {lobe_size_field, &TowerScatter::lobe_size},
    {life_field, &TowerScatter::life},
    {grows_from_field, &TowerScatter::grows_from},
};

}  // namespace

std::span<const TowerField> tower_fields() { return tower_table; }

std::span<const TowerScatterField> tower_scatter_fields() { return tower_scatter_table; }

}  // namespace skybake::config
