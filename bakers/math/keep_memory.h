// For programs, at their start.
#pragma once

namespace skybake {

// Has the process keep the memory that it frees rather than give it back: bakes free and ask for
// the same buffers over and over, and faulting in fresh pages costs as much as octaves of noise do.
// Nothing else depends on it; a no-op where the C library is not glibc.
void keep_freed_memory();

}  // namespace skybake
