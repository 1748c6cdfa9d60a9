#!/usr/bin/env bash
# Every published lookup compiles alone and with all others, as GLSL of OpenGL 4.5, of Vulkan and of
# WebGL 2 (ES 3.00); in a folder of HLSL, as HLSL; in one of Godot's language, of which no compiler is
# packaged, as GLSL of ES 3.00, on which it rests.
#   compile.sh FOLDER [alone]      alone: not with all others
set -euo pipefail
if ! command -v glslangValidator >/dev/null; then
    echo "SKIPPED: glslangValidator is missing (Debian's glslang-tools), so no lookup was compiled" >&2
    exit 77
fi
failures=0

# compile NAME HEAD OPTIONS FILES...: as a fragment shader with that head
compile() {
    local name=$1 head=$2 options=$3
    shift 3
    local answer
    # shellcheck disable=SC2086
    if ! answer=$({ printf '%b' "$head"; cat "$@"; echo "$main"; } |
            glslangValidator $options --stdin -S frag 2>&1); then
        printf '%s as %s:\n%s\n' "$*" "$name" "$answer" >&2
        failures=$((failures + 1))
    elif [[ "$answer" == *WARNING* ]]; then
        printf '%s as %s warns:\n%s\n' "$*" "$name" "$answer" >&2
        failures=$((failures + 1))
    fi
}

compile_everywhere() {
    local main='void main() {}'
    if [[ $1 == *.hlsl ]]; then
        main='float4 main() : SV_Target { return float4(0.0, 0.0, 0.0, 0.0); }'
        compile "HLSL" "" "-D -V -e main -o /dev/null" "$@"
        return
    fi
    if [[ $1 == *.glsl ]]; then
        compile "OpenGL 4.5" '#version 450 core\n' "" "$@"
        compile "Vulkan" '#version 450\n' "-V -o /dev/null" "$@"
    fi
    compile "ES 3.00" '#version 300 es\nprecision highp float;\nprecision highp sampler3D;\nprecision highp sampler2DArray;\n' "" "$@"
}

count=0
for file in "$1"/*.*; do
    compile_everywhere "$file"
    count=$((count + 1))
done
[[ ${2:-} == alone ]] || compile_everywhere "$1"/*.*
echo "$count lookups"
((count >= 10 && failures == 0))
