// Writes volumes for programs of others to read into the folder that the first argument names: a
// ball in clear sky, a sky without a cloud, and the ball in two channels on voxels that are no
// cubes.
#include <algorithm>
#include <cmath>

#include "tests/io/files.h"

namespace skybake {
namespace {

using config::VolumeFormat;

// 0 outside of the ball and 1 at its centre, the same for each channel but for a factor.
BakedVolume ball(const std::string& name, double radius, int channels) {
    constexpr std::array<int, 3> size = {44, 36, 28};
    BakedVolume volume = testing::plain_volume(
        size, channels, config::PixelType::half, [=](int x, int y, int z, int channel) {
            const double squared =
                std::pow(x - 21.5, 2) + std::pow(y - 17.5, 2) + std::pow(z - 13.5, 2);
            const double density = radius > 0 ? 1 - squared / (radius * radius) : 0;
            return static_cast<float>(std::max(0.0, density) / (channel + 1));
        });
    volume.name = name;
    volume.sparse = true;
    volume.formats = {VolumeFormat::exr, VolumeFormat::vdb, VolumeFormat::bin};
    VolumeLevel& level = volume.levels[0];
    const std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(channels), {0.0, 1.0});
    EXPECT_TRUE(survey_level(volume, 0, ranges, {2}).empty());
    level.probes =
        testing::sample_volume_probes(level, volume.channel_names.size(), volume.pixel_type);
    return volume;
}

void write(const std::filesystem::path& folder) {
    BakedVolume two_channels = ball("channels", 12, 3);
    two_channels.grid_names = {"density", "ice", "rain"};
    two_channels.voxel_size_m = {25, 50, 12.5};
    Manifest manifest = new_manifest({});
    for (const BakedVolume& volume : {ball("cloud", 12, 1), ball("clear", 0, 1), two_channels}) {
        manifest.assets.push_back(testing::write_sample_volume(folder, volume).assets[0]);
    }
    EXPECT_TRUE(write_file_atomically(folder / manifest_name, manifest_json(manifest)).value);
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    skybake::write(argv[1]);
    return ::testing::Test::HasFailure() ? 1 : 0;
}
