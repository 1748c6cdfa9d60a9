// Shared by the tests of files: a folder that vanishes, a table with all that a table can have.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/survey_volume.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/verify.h"
#include "bakers/math/hash.h"
#include "tests/support/exr_image.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volumes.h"

namespace skybake::testing {

// Runs `body` in a child process, where limits and mounts do no harm, and returns its exit status;
// -1 where it was killed.
inline int in_child(const std::function<int()>& body) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(body());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Returns the number that stands at a byte of a file, or 0 if the file ends before it does.
template <class T>
T number(const std::string& bytes, std::size_t at) {
    T value{};
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}
inline std::uint32_t word(const std::string& bytes, std::size_t at) {
    return number<std::uint32_t>(bytes, at);
}

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return (std::ostringstream() << file.rdbuf()).str();  // at once, as tests are not optimised
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline void save_manifest(const std::filesystem::path& folder, const Manifest& manifest) {
    write_bytes(folder / manifest_name, manifest_json(manifest));
}

// Replaces a file of the first asset, and what the manifest says of its bytes.
inline void replace_file(const std::filesystem::path& folder, Manifest& manifest, std::size_t index,
                         const std::string& bytes) {
    ManifestFile& file = manifest.assets[0].files[index];
    write_bytes(folder / file.path, bytes);
    file.bytes = bytes.size();
    file.xxh3 = xxh3_hex(bytes);
    save_manifest(folder, manifest);
}

// Returns the checks that fail in a folder, each as often as it does.
using Checks = std::multiset<std::string>;
inline Checks failed_checks(const std::filesystem::path& folder,
                            std::span<const AssetCheck> further = {}) {
    const auto report = verify_bake(folder, further);
    Checks checks;
    if (!report.value) {
        ADD_FAILURE() << report.diagnostics[0].message;
        return checks;
    }
    for (const VerifyFailure& failure : report.value->failures) checks.insert(failure.check);
    return checks;
}

// A small generator with the same numbers everywhere (Steele, Lea and Flood 2014: SplitMix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }

  private:
    std::uint64_t state_;
};

// Smooth values that a half holds exactly: multiples of 1/1024 in [0, 1].
inline Image2<float> sample_image(int width, int height, int channels) {
    Image2<float> image(width, height, channels);
    for_each_voxel({width, height, channels}, [&](int x, int y, int channel) {
        const int value = (x * 37 + y * 11 + channel * 301) % 1025;
        image.texel(x, y)[channel] = static_cast<float>(value) / 1024;
    });
    return image;
}

// Lookups about a whole table or tile, many of them across its seams; `names` are those of coordinates.
inline std::vector<Probe> sample_probes(const Level& level, std::size_t channels,
                                        config::PixelType type,
                                        const std::vector<std::string>& names) {
    const bool is_tile = names.size() == 3;
    std::vector<Probe> probes;
    for (int i = 0; i < 16; ++i) {
        Probe probe;
        probe.uvw = {i / 16.0, 1 - i * 0.0625, is_tile ? (i * 5 % 16) / 15.0 : 0.5};
        for (std::size_t a = 0; a < names.size(); ++a)
            probe.at.emplace_back(names[a], probe.uvw[a]);
        probe.value.assign(channels, 0.0);
        probe.tolerance.assign(channels, 1e-9);
        // One probe blends two lookups, as of two sub-images.
        if (i == 3 && is_tile) probe.blend = BlendedLookup{probe.uvw, 0.25};
        for (const VoxelTap& tap :
             trilinear_taps(level.size, probe.uvw, {is_tile, is_tile, is_tile})) {
            const auto voxel = planes_of(*level.voxels, {tap.voxel, {1, 1, 1}}, channels);
            for (std::size_t c = 0; c < channels; ++c) {
                probe.value[c] += tap.weight * double{round_to_pixel_type(voxel[c][0], type)};
            }
        }
        probes.push_back(std::move(probe));
    }
    return probes;
}

// Texels, surveyed, with probes. The image may be that of the level that goes.
inline void set_sample_image(const Image2<float>& image, Baked& table) {
    set_image(image, table);
    const std::vector<std::array<double, 2>> ranges(table.channel_names.size(), {0.0, 1.0});
    EXPECT_TRUE(survey_level(table, 0, ranges, {2}).empty());
    table.levels[0].probes = sample_probes(table.levels[0], table.channel_names.size(),
                                           table.pixel_type, {"cos_zenith", "altitude_km"});
    table.levels[0].catches = {"zeros", "flip_v"};
}

inline Baked sample_table(const std::string& name = "transmittance") {
    Baked table;
    table.axes.resize(2);
    table.name = name;
    table.kind = "transmittance";
    table.content = "transmittance to the top of the atmosphere, in [0, 1]";
    table.mapping = "bruneton";
    table.axes[0] = {"cos_zenith", "x_mu = (d - d_min) / (d_max - d_min)",
                     "end points on texel centres", 1, -0.1};
    table.axes[1] = {"altitude_km", "x_r = rho / H", "end points on texel centres", 0, 100};
    table.channel_names = {"R", "G", "B"};
    table.certified = true;
    table.certificate = {{1e-7, 3.25e-8},
                         {7.1e-3, 2e-4},
                         128,
                         1024,
                         "adaptive quadrature",
                         "1 is full transmittance",
                         "cos_zenith -0.01",
                         "a larger size"};
    set_sample_image(sample_image(16, 8, 3), table);
    table.parameters = "[atmosphere]\nground_radius = \"6360000 m\"\n";
    table.axes[0].constants = {{"ground_radius_km", 6360.0}, {"names", "of a planet"}};
    table.axes[1].constants = {{"tables", std::vector<double>{1, 0.1, -2}}};
    table.conventions = {"km", "1/km", "cosine", "1/sr", {1, 1, 1}, {680, 550, 440}};
    table.details = {{"nodes", 12.0}};
    return table;
}

// Writes the files of an asset, and adds it to the manifest.
inline ManifestAsset& add_asset(const Baked& baked, const std::filesystem::path& folder,
                                Manifest& manifest) {
    manifest.assets.push_back(describe_with_files(baked));
    AtomicFiles files;
    EXPECT_TRUE(stage_files(baked, manifest.assets.back(), folder, files, 2).value.has_value());
    EXPECT_TRUE(files.commit().empty());
    return manifest.assets.back();
}

// Bakes sample tables of these names into the folder, manifest and all.
inline Manifest write_sample_bake(const std::filesystem::path& folder,
                                  const std::vector<std::string>& names) {
    Manifest manifest = new_manifest({});
    for (const std::string& name : names) {
        ManifestAsset& asset = add_asset(sample_table(name), folder, manifest);
        asset.timing.bake.texels = 0.004;
        asset.lookup_cost = LookupCost{"sky_view", 1, 70, 2, 6};
    }
    save_manifest(folder, manifest);
    return manifest;
}

// A volume with all that a volume can have, surveyed; level after level has half the size.
inline Baked sample_volume(const std::array<int, 3>& size = {12, 10, 7}, int channels = 3,
                           config::PixelType type = config::PixelType::half,
                           std::vector<config::FileFormat> formats = {config::FileFormat::exr,
                                                                      config::FileFormat::bin},
                           int levels = 1) {
    Baked volume = plain_volume(size, channels, type);
    volume.formats = std::move(formats);
    volume.levels.resize(static_cast<std::size_t>(levels), volume.levels[0]);
    for (std::size_t i = 0; i < volume.levels.size(); ++i) {
        Level& level = volume.levels[i];
        for (std::size_t a = 0; a < 3; ++a) level.size[a] = std::max(1, size[a] >> i);
        const std::vector<std::array<double, 2>> ranges(volume.channel_names.size(), {0.0, 1.0});
        EXPECT_TRUE(survey_level(volume, static_cast<int>(i), ranges, {2}).empty());
        level.probes =
            sample_probes(level, volume.channel_names.size(), type, {"x_tile", "y_tile", "z_tile"});
        level.catches = {"zeros"};
    }
    volume.certified = true;
    volume.certificate = {{1e-4, 3e-5}, {2e-2, 4e-3}, 64, 1024, "double", "1 is the range", "", ""};
    return volume;
}

// Writes the volume's files and a manifest of it alone.
inline Manifest write_sample_volume(const std::filesystem::path& folder, const Baked& volume) {
    Manifest manifest = new_manifest({});
    add_asset(volume, folder, manifest);
    save_manifest(folder, manifest);
    return manifest;
}

// Writes level 0 of an asset, or all of it, over an existing file, with `{}` for its metadata.
inline config::Outcome<bool> write_as(config::FileFormat format, const Baked& baked, int threads,
                                      Progress* progress, const std::filesystem::path& path) {
    return format_of(format).write({baked, 0, "{}", threads, progress}, path);
}

inline SheetGrid grid_of(const std::array<int, 3>& size, config::SheetLayout layout, int columns,
                         bool flip = false) {
    config::AssetFiles files;
    files.layout = layout;
    files.columns = columns;
    files.flip = flip;
    return sheet_grid(size, files);
}

// Returns the facts that a reader must know of a file of the asset.
inline FileShape shape_of(const Baked& baked) {
    const std::array<int, 3>& size = baked.levels[0].size;
    return {size,
            baked.channel_names.size(),
            baked.pixel_type,
            sheet_grid(size, baked),
            static_cast<int>(baked.levels.size()),
            texture_parts(baked)};
}

inline std::string first_code(const std::vector<config::Diagnostic>& diagnostics) {
    return diagnostics.empty() ? "" : diagnostics[0].code;
}

}  // namespace skybake::testing

namespace skybake {

// Tests speak of these.
using testing::first_code;
using testing::in_child;
using testing::read_bytes;
using testing::write_bytes;

}  // namespace skybake
