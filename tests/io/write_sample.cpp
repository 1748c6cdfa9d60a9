// Bakes sample tables and a volume into the folder that the first argument names, for tests in
// other languages.
#include "tests/io/files.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    auto manifest = skybake::testing::write_sample_bake(argv[1], {"transmittance", "second"});
    manifest.assets[1].error.reset();  // one that was not measured
    auto volume = skybake::testing::sample_volume(
        {12, 10, 7}, 3, skybake::config::PixelType::half,
        {skybake::config::FileFormat::exr, skybake::config::FileFormat::bin,
         skybake::config::FileFormat::vdb},
        2);
    volume.layout = skybake::config::SheetLayout::atlas;
    manifest.assets.push_back(skybake::testing::write_sample_volume(argv[1], volume).assets[0]);
    const auto written = skybake::write_file_atomically(
        std::filesystem::path(argv[1]) / skybake::manifest_name, skybake::manifest_json(manifest));
    return written.value ? 0 : 1;
}
