// What `bake --json` prints: JSON Lines as event_schema.json describes them.
#pragma once

#include <string>

#include "bakers/workspace/bake_folder.h"

namespace skybake::cli {

std::string plan_event(const FolderPlan& plan);

// One event per file, then the last one.
std::string finished_events(const BakedFolder& baked, const std::filesystem::path& folder,
                            double seconds);

}  // namespace skybake::cli
