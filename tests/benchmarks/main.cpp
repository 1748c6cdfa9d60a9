// The main of all benchmarks: memory is as the program has it, and times are in milliseconds.
#include <benchmark/benchmark.h>

#include "bakers/math/memory.h"

int main(int argc, char** argv) {
    skybake::keep_freed_memory();
    benchmark::SetDefaultTimeUnit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
