#!/usr/bin/env bash
# Every published lookup compiles alone and with all others, as GLSL of OpenGL 4.5, of Vulkan and of
# WebGL 2 (ES 3.00); in a folder of HLSL, as HLSL; in one of Godot's language, of which no compiler is
# packaged, as GLSL of ES 3.00, on which it rests.
#   compile.sh FOLDER [alone]      alone: not with all others, and not for Vulkan, as costs.py does that
set -euo pipefail
if ! command -v glslangValidator >/dev/null; then
    echo "SKIPPED: glslangValidator is missing (Debian's glslang-tools), so no lookup was compiled" >&2
    exit 77
fi
shaders=$(mktemp -d)
trap 'rm -rf "$shaders"' EXIT
cd "$1"
files=(*.*)
kind=${files[0]##*.} alone=${2:-}
failures=0

# compile NAME HEAD MAIN FILES_AT_ONCE OPTIONS: each file, and unless they are to stay alone all
# together, as a fragment shader with that head. A process that links nothing takes many files, and makes
# the tables of what the language has once for all of them.
compile() {
    local name=$1 head=$2 main=$3 at_once=$4 options=$5 file answer
    for file in "${files[@]}"; do { printf '%b' "$head"; cat "$file"; echo "$main"; } >"$shaders/$file.frag"; done
    [[ $alone ]] || { printf '%b' "$head"; cat "${files[@]}"; echo "$main"; } >"$shaders/all.frag"
    # shellcheck disable=SC2086
    if ! answer=$(find "$shaders" -type f -print0 | xargs -0 -n "$at_once" glslangValidator $options -S frag 2>&1) ||
            [[ $answer == *WARNING* ]]; then
        printf 'as %s:\n' "$name" >&2
        grep -B 1 -E '^(ERROR|WARNING)' <<<"$answer" >&2
        failures=$((failures + 1))
    fi
}

es='#version 300 es\nprecision highp float;\nprecision highp sampler3D;\nprecision highp sampler2DArray;\n'
if [[ $kind == hlsl ]]; then
    compile "HLSL" "" 'float4 main() : SV_Target { return float4(0.0, 0.0, 0.0, 0.0); }' 1 "-D -V -e main -o /dev/null"
else
    compile "ES 3.00" "$es" 'void main() {}' 1000 ""
fi
[[ $kind != glsl ]] || compile "OpenGL 4.5" '#version 450 core\n' 'void main() {}' 1000 ""
[[ $kind != glsl || $alone ]] || compile "Vulkan" '#version 450\n' 'void main() {}' 1 "-V -o /dev/null"
echo "${#files[@]} lookups"
((${#files[@]} >= 10 && failures == 0))
