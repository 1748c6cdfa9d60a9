// How many threads the system lets a process begin: limits of a user (ulimit -u), of a container
// (pids.max) and of memory may let it begin fewer than it has processors. Libraries abort or wait for
// ever when a thread cannot begin, so it is tried before they are asked.
#pragma once

namespace skybake {

// Begins up to `wanted` threads at once, ends them again, and returns how many could begin.
int startable_threads(int wanted);

// Makes parallel loops (parallel.h) find out again how many threads they may have, after a library has
// begun some of its own. Otherwise they do so when they are asked for more than before.
void count_threads_again();

}  // namespace skybake
