#!/usr/bin/env bash
# GCC's build against Clang's, of which the bakers alone are built. Skipped where there is no Clang.
source "$(dirname "$0")/common.sh"
if [[ -z "${CLANG_COMPILER:-}" || "$CLANG_COMPILER" == *NOTFOUND ]]; then
    echo "skipped: no clang++ here"
    exit 77
fi
cmake -S "$SKYBAKE_SOURCE" -B "$work/../clang-build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$CLANG_COMPILER" -DSKYBAKE_WARNINGS_AS_ERRORS=ON \
    -DSKYBAKE_TESTS=ON -DSKYBAKE_BENCHMARKS=OFF -DSKYBAKE_PRECOMPILED_HEADERS=ON \
    -DSKYBAKE_BATCHES=ON -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" >/dev/null
cmake --build "$work/../clang-build" --target bake_without_cli
bake "$work/clang" "$work/../clang-build/tests/bytes/bake_without_cli"
same "$reference" "$work/clang"
