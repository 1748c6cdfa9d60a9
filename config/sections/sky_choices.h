// Choices that several assets of the sky share.
#pragma once

namespace skybake::config {

enum class MultipleScatteringMapping { hillaire, twilight };

// Which light: all of it; scattered once, in the air; or the rest, ground in sunlight included.
enum class SkyOrders { all, single, multiple };

// How light scattered twice or more is found: all orders solved for; or the second alone, from a
// sky of eight strips.
enum class SkyMethod { solved, strips };

}  // namespace skybake::config
