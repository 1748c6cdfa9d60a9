// The channels of channels-inl.h, compiled for the instruction set that every processor has, for
// code that is compiled once. Sources that Highway compiles for each target include channels-inl.h
// instead.
#pragma once

#include "bakers/math/channels-inl.h"

namespace skybake {

using HWY_NAMESPACE::Channels;

// Returns e^x of each channel, with the same bits as exponential(double).
Channels exponential(const Channels& x);

}  // namespace skybake
