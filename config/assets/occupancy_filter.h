// How a runtime looks a volume up whose empty cells it skips.
#pragma once

namespace skybake::config {

enum class OccupancyFilter { nearest, trilinear, tricubic };

}  // namespace skybake::config
