// The channels of channels-inl.h as every processor has them, for code that is compiled once.
// Sources that Highway compiles for each target include channels-inl.h in its place.
#pragma once

#include "bakers/math/channels-inl.h"

namespace skybake {

using HWY_NAMESPACE::Channels;

// e^x of each, the same bits as exponential(double).
Channels exponential(const Channels& x);

}  // namespace skybake
