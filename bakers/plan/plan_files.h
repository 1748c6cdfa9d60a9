// A plan as files: a table, JSON, a chart, and the recipe of the way that was chosen.
#pragma once

#include <string>

#include "bakers/plan/plan_sky.h"
#include "bakers/plot/chart.h"

namespace skybake {

// Returns one row per way. The first line names the columns; an error of 1 means 100 %.
std::string plan_csv(const SkyPlan& plan);

// Returns the same figures with the views, the limits and the choice, as JSON.
std::string plan_json(const SkyPlan& plan);

// Returns a chart of error over bytes and one of error over fetches, with the front.
Figure plan_figure(const SkyPlan& plan);

// Returns a recipe that bakes what the chosen way needs, from resolved values alone. Comments say what
// it costs, and what its neighbours on the front would.
std::string planned_recipe(const SkyPlan& plan, const config::Recipe& recipe);

// Returns "at most 2.3 % off in nine of ten views, 48 fetches, 160 KiB".
std::string figures_text(const WayFigures& figures);

// Returns "cameras from 0 to 3 km, suns from -6 to 90 degrees".
std::string views_text(const SkyPlan& plan);

// Returns the name of a way with its family: "moments of degree 4, [64, 64], half, 16 steps".
std::string full_name(const SkyWay& way);

// Returns the ways on the front by rising error.
std::vector<std::size_t> front_by_error(const SkyPlan& plan);

}  // namespace skybake
