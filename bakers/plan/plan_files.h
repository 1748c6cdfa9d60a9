// Plans as files: a table, JSON, a chart each, and the recipe of the ways that were chosen.
#pragma once

#include <span>
#include <string>

#include "bakers/plan/plan.h"
#include "bakers/plot/chart.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Returns one row per way of each plan. The first line names the columns; an error of 1 means 100 %.
std::string plan_csv(std::span<const Plan> plans);

// Returns the same figures with the views, the limits and the choices, as JSON.
std::string plan_json(std::span<const Plan> plans);

// Returns a chart of error over bytes and one of error over fetches, with the front.
Figure plan_figure(const Plan& plan);

// Returns a recipe that bakes what the chosen ways need, from resolved values alone. Comments say what
// they cost, and what their neighbours on the front would.
std::string planned_recipe(std::span<const Plan> plans, const Recipe& recipe);

// Returns "at most 2.3 % off in nine of ten views, 48 fetches, 160 KiB".
std::string figures_text(const Plan& plan, const WayFigures& figures);

// Returns the name of a way with its family: "moments of degree 4, [64, 64], half, 16 steps".
std::string full_name(const Way& way);

}  // namespace skybake
