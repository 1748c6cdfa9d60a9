#!/usr/bin/env bash
# GCC's build against Clang's, of which the bakers alone are built. Skipped where there is no Clang.
# Clang optimises what computes, and compiles kernels for the instruction set that they run on here and
# for the scalar one, which Highway needs; targets.sh compares instruction sets.
source "$(dirname "$0")/common.sh"
if [[ -z "${CLANG_COMPILER:-}" || "$CLANG_COMPILER" == *NOTFOUND ]]; then
    echo "skipped: no clang++ here"
    exit 77
fi
target=$("$BAKE_ON_TARGET" --list | head -n 1)
cmake -S "$SKYBAKE_SOURCE" -B "$work/../clang-build" -G Ninja -DCMAKE_BUILD_TYPE=Bytes \
    -DCMAKE_CXX_COMPILER="$CLANG_COMPILER" -DSKYBAKE_WARNINGS_AS_ERRORS=ON \
    -DSKYBAKE_TESTS=ON -DSKYBAKE_BENCHMARKS=OFF -DSKYBAKE_PRECOMPILED_HEADERS=ON \
    -DSKYBAKE_BATCHES=ON -DCMAKE_CXX_FLAGS_BYTES="-O0 -DNDEBUG" \
    -DCMAKE_CXX_FLAGS="-DHWY_BROKEN_TARGETS=-1^HWY_SCALAR^HWY_EMU128^HWY_$target" >/dev/null
cmake --build "$work/../clang-build" --target bake_without_cli
bake "$work/clang" "$work/../clang-build/tests/bytes/bake_without_cli"
same "$reference" "$work/clang"
