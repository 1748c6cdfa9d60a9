// The page of a plan: one HTML file with the chart, the pictures and all ways of each subject, which a
// reader sorts by error, fetches or size.
#pragma once

#include <string>
#include <vector>

#include "bakers/plan/plan.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// Returns the text of index.html, which needs no other file. `title` names the recipe. E0300 if the
// module that draws charts is missing.
config::Outcome<std::string> plan_page(const std::vector<Plan>& plans, const std::string& title);

// Returns the name of a subject's chart and pictures, without the files' extensions.
std::string file_name_of(const PlanSubject& subject);

// Returns what a table says of a way: "chosen", "knee", "front", and of which baseline it is.
std::string remark_of(const Plan& plan, std::size_t index);

}  // namespace skybake::cli
