// A bake's loops: parallel, with progress, stopped early by an interruption.
#pragma once

#include <functional>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake {

// parallel_for over `count` tiles that tells options.progress of each. After an interruption the
// remaining tiles are skipped: what was made is thrown away by whoever asked for it.
void for_each_tile(int count, const BakeOptions& options, std::string_view step,
                   const std::function<void(int)>& tile);

}  // namespace skybake
