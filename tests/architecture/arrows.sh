#!/usr/bin/env bash
# The arrows between rooms point one way, config <- bakers <- cli, and each heavy library is included
# behind its wall.
set -euo pipefail
cd "$1"
failures=0

# forbid WHAT WHERE EXCEPT: no include matching WHAT under WHERE, but in files matching EXCEPT
forbid() {
    local found
    found=$(grep -rnE "#include [<\"]$1" --include='*.h' --include='*.cpp' $2 | grep -vE "^($3):" || true)
    if [[ -n "$found" ]]; then
        echo "not allowed here:"
        echo "$found"
        failures=$((failures + 1))
    fi
}

none='^$'
forbid '(bakers|cli)/' config "$none"
forbid 'cli/' 'config bakers' "$none"
forbid 'toml\+\+' 'config bakers cli' 'config/toml_source\.cpp'
forbid 'CLI/' 'config bakers cli' 'cli/parse_arguments\.cpp'
forbid '(OpenEXR|Imf)' 'config bakers cli' 'bakers/io/exr(_[a-z]+)?\.cpp|bakers/io/exr_library\.h'
forbid 'bakers/io/exr_library\.h' 'config bakers cli' 'bakers/io/exr(_[a-z]+)?\.cpp'
forbid 'openvdb/' 'config bakers cli' 'bakers/io/vdb_(decoder|encoder)\.cpp|bakers/io/vdb_library\.h'
forbid 'OpenImageIO/' 'config bakers cli' 'bakers/io/(map_reader|png_encoder)\.cpp'
forbid 'ft2build' 'config bakers cli' 'bakers/io/text_renderer\.cpp'
forbid 'Imath' 'config bakers cli' 'bakers/io/exr(_[a-z]+)?\.cpp'
forbid '(oneapi/)?tbb' 'config bakers cli' 'bakers/core/parallel_tbb\.cpp'
forbid 'xxh' 'config bakers cli' 'bakers/core/hash\.cpp'
forbid '(thread|mutex|OpenEXR)' config "$none"
# The reading and writing of files, and the console, are not a baker's business.
forbid '(iostream|fstream|bakers/io/)' 'bakers/core bakers/atmosphere bakers/cloud bakers/noise' "$none"

# Sources are compiled in batches, where a namespace that one source opens is open in those after it.
opened=$(grep -rnE '^using namespace ' --include='*.h' --include='*.cpp' config bakers cli |
    grep -v 'std::string_view_literals;' || true)
if [[ -n "$opened" ]]; then
    echo "not allowed outside of functions:"
    echo "$opened"
    failures=$((failures + 1))
fi

exit "$failures"
