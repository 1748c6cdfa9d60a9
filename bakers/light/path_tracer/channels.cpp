#include "bakers/light/path_tracer/channels.h"

#include "bakers/math/transcendental-inl.h"

namespace skybake {

Channels exponential(const Channels& x) { return HWY_NAMESPACE::exponential(x); }

}  // namespace skybake
