// Bakes sample tables into the folder that the first argument names, for tests in other languages.
#include "tests/io/files.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    auto manifest = skybake::testing::write_sample_bake(argv[1], {"transmittance", "second"});
    manifest.assets[1].error.reset();  // one that was not measured
    const auto written = skybake::write_file_atomically(
        std::filesystem::path(argv[1]) / skybake::manifest_name, skybake::manifest_json(manifest));
    return written.value ? 0 : 1;
}
