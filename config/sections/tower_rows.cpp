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

constexpr std::array tower_shape_choices = {
    Choice{TowerShape::gaussian, "gaussian", "a Gaussian over the ground plan, at every height"},
    Choice{TowerShape::dome, "dome", "a solid with a round top, in metres"},
};

// These are the shapes for which a key applies.
constexpr std::string_view gaussian[] = {"gaussian"};
constexpr std::string_view dome[] = {"dome"};

// Towers and scatters share the keys of domes.
constexpr Field shape_field{.key = "shape",
                            .kind = Kind::choice,
                            .choices = tower_shape_choices,
                            .fallback = R"("gaussian")",
                            .documentation = "what a tower is"};
constexpr Field widest_field{
    .key = "widest",
    .kind = Kind::number,
    .range = unit_range,
    .fallback = "0",
    .documentation =
        "height of the widest place, as a share of the tower's height; above and "
        "below it the tower narrows as an ellipsoid does",
    .hint = "0 gives a dome on a flat base, 0.5 a ball, and 1 an anvil with a flat top",
    .selector = "shape",
    .selected_by = dome};
constexpr Field lean_field{.key = "lean",
                           .kind = Kind::pair,
                           .range = lean_range,
                           .fallback = "[0, 0]",
                           .documentation =
                               "how far the wind shifts the tower along x and y, per "
                               "height",
                           .selector = "shape",
                           .selected_by = dome};
constexpr Field lobes_field{
    .key = "lobes",
    .kind = Kind::integer,
    .range = lobes_range,
    .fallback = "0",
    .documentation = "number of balls that bulge out of the tower, as on a cauliflower",
    .selector = "shape",
    .selected_by = dome};
constexpr Field lobe_size_field{
    .key = "lobe_size",
    .kind = Kind::bounds,
    .range = lobe_size_range,
    .fallback = "[0.3, 0.55]",
    .documentation = "range of the radius of a lobe, over the lesser radius of its tower",
    .selector = "shape",
    .selected_by = dome};
constexpr Field life_field{
    .key = "life",
    .kind = life_kind,
    .range = unit_range,
    .documentation =
        "how long the tower grows, stays and dissolves, as shares of the cloud's "
        "`period`; without it the tower stands",
    .hint = "after shares that add up to 1, such as [0.4, 0.3, 0.3], it is born again at once",
    .citation = byers_1949};
constexpr Field grows_from_field{
    .key = "grows_from",
    .kind = Kind::number,
    .range = unit_range,
    .fallback = "0.4",
    .documentation =
        "width of a tower that is born, as a share of its full width; its height "
        "grows from 0",
    .needs = "life"};

const std::array tower_table = {
    TowerField{shape_field, &Tower::shape},
    TowerField{{.key = "center",
                .kind = Kind::pair,
                .range = center_range,
                .required = true,
                .documentation = "x and y of the tower's middle, in tiles",
                .hint = "[0.5, 0.5] is the middle of the cloud",
                .citation = olajos_2016,
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::center},
    TowerField{{.key = "sigma",
                .kind = Kind::pair,
                .range = sigma_range,
                .required = true,
                .documentation = "standard deviations along the tower's own axes, in tiles",
                .hint = "for example [0.03, 0.06]",
                .citation = olajos_2016,
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::sigma},
    TowerField{{.key = "foot",
                .kind = Kind::lengths,
                .range = foot_range,
                .required = true,
                .documentation = "x and y of the tower's middle, and how high above the cloud's "
                                 "base it begins",
                .hint = "a height below 0 cuts its foot off",
                .selector = "shape",
                .selected_by = dome},
               &Tower::foot},
    TowerField{{.key = "size",
                .kind = Kind::lengths,
                .range = dome_size_range,
                .required = true,
                .documentation = "widths along the tower's own axes, and its height",
                .selector = "shape",
                .selected_by = dome},
               &Tower::size},
    TowerField{{.key = "rotation",
                .kind = Kind::angle,
                .range = angle_range,
                .fallback = R"("0 deg")",
                .documentation = "angle of the tower's axes against x and y, counterclockwise"},
               &Tower::rotation},
    TowerField{{.key = "correlation",
                .kind = Kind::number,
                .range = correlation_range,
                .fallback = "0",
                .documentation = "correlation between the tower's own axes, before rotation",
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::correlation},
    TowerField{{.key = "amplitude",
                .kind = Kind::number,
                .range = amplitude_range,
                .required = true,
                .documentation = "what the tower adds to the height profile at its middle",
                .citation = olajos_2016},
               &Tower::amplitude},
    TowerField{widest_field, &Tower::widest},
    TowerField{lean_field, &Tower::lean},
    TowerField{lobes_field, &Tower::lobes},
    TowerField{lobe_size_field, &Tower::lobe_size},
    TowerField{{.key = "seed",
                .kind = Kind::seed,
                .fallback = "0",
                .documentation = "another seed gives other lobes",
                .selector = "shape",
                .selected_by = dome},
               &Tower::seed},
    TowerField{life_field, &Tower::life},
    TowerField{grows_from_field, &Tower::grows_from},
    TowerField{{.key = "born",
                .kind = Kind::number,
                .range = unit_range,
                .fallback = "0",
                .documentation = "when the tower is born, as a share of the cloud's `period`",
                .needs = "life"},
               &Tower::born},
};

const std::array tower_scatter_table = {
    TowerScatterField{shape_field, &TowerScatter::shape},
    TowerScatterField{{.key = "count",
                       .kind = Kind::integer,
                       .range = tower_count_range,
                       .fallback = "0",
                       .documentation = "number of towers"},
                      &TowerScatter::count},
    TowerScatterField{{.key = "seed",
                       .kind = Kind::seed,
                       .fallback = "0",
                       .documentation = "another seed gives other places"},
                      &TowerScatter::seed},
    TowerScatterField{{.key = "sigma",
                       .kind = Kind::bounds,
                       .range = scatter_sigma_range,
                       .fallback = "[0.02, 0.05]",
                       .documentation = "range of the standard deviation along the smaller axis, "
                                        "in tiles; its logarithm is uniform",
                       .selector = "shape",
                       .selected_by = gaussian},
                      &TowerScatter::sigma},
    TowerScatterField{{.key = "width",
                       .kind = Kind::length_bounds,
                       .range = dome_size_range,
                       .fallback = R"(["300 m", "900 m"])",
                       .documentation = "range of the width along the smaller axis; its logarithm "
                                        "is uniform",
                       .selector = "shape",
                       .selected_by = dome},
                      &TowerScatter::width},
    TowerScatterField{{.key = "slenderness",
                       .kind = Kind::bounds,
                       .range = slenderness_range,
                       .fallback = "[0.6, 1]",
                       .documentation = "range of the height over the width of the smaller axis",
                       .selector = "shape",
                       .selected_by = dome},
                      &TowerScatter::slenderness},
    TowerScatterField{{.key = "aspect",
                       .kind = Kind::bounds,
                       .range = tower_aspect_range,
                       .fallback = "[1, 2]",
                       .documentation = "range of the ratio of the larger axis to the smaller one"},
                      &TowerScatter::aspect},
    TowerScatterField{{.key = "amplitude",
                       .kind = Kind::bounds,
                       .range = amplitude_range,
                       .fallback = "[0.2, 0.5]",
                       .documentation = "range of what a tower adds to the height profile"},
                      &TowerScatter::amplitude},
    TowerScatterField{widest_field, &TowerScatter::widest},
    TowerScatterField{lean_field, &TowerScatter::lean},
    TowerScatterField{lobes_field, &TowerScatter::lobes},
    TowerScatterField{lobe_size_field, &TowerScatter::lobe_size},
    TowerScatterField{life_field, &TowerScatter::life},
    TowerScatterField{grows_from_field, &TowerScatter::grows_from},
};

}  // namespace

std::span<const TowerField> tower_fields() { return tower_table; }

std::span<const TowerScatterField> tower_scatter_fields() { return tower_scatter_table; }

}  // namespace skybake::config
