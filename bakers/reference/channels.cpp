#include "bakers/reference/channels.h"

#include "bakers/core/transcendental-inl.h"

namespace skybake {

Channels exponential(const Channels& x) { return HWY_NAMESPACE::exponential(x); }

}  // namespace skybake
