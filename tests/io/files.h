// What the tests of files share: a folder that vanishes, a table with all that a table can have.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bakers/core/baked_table.h"
#include "bakers/core/bilinear.h"
#include "bakers/io/atomic_file.h"
#include "bakers/io/manifest.h"
#include "bakers/io/write_table.h"

namespace skybake::testing {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "skybake-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    // The names in the folder, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }

  private:
    std::filesystem::path path_;
};

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
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
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int channel = 0; channel < channels; ++channel) {
                const int value = (x * 37 + y * 11 + channel * 301) % 1025;
                image.texel(x, y)[channel] = static_cast<float>(value) / 1024;
            }
        }
    }
    return image;
}

inline std::vector<Probe> sample_probes(const Image2<float>& image) {
    std::vector<Probe> probes;
    for (int i = 0; i < 16; ++i) {
        Probe probe;
        probe.at = {{"altitude_km", i * 6.25}, {"cos_zenith", 1 - i / 7.5}};
        probe.uv = {i / 15.0, 1 - i / 15.0};
        probe.value.resize(static_cast<std::size_t>(image.channels));
        bilinear(image, probe.uv[0], probe.uv[1], probe.value.data());
        probe.tolerance.assign(probe.value.size(), 1e-9);
        probes.push_back(probe);
    }
    return probes;
}

inline BakedTable sample_table(const std::string& name = "transmittance") {
    BakedTable table;
    table.name = name;
    table.kind = "transmittance";
    table.content = "transmittance to the top of the atmosphere, in [0, 1]";
    table.mapping = "bruneton";
    table.axes[0] = {"cos_zenith", "x_mu = (d - d_min) / (d_max - d_min)",
                     "end points on texel centres", 1, -0.1};
    table.axes[1] = {"altitude_km", "x_r = rho / H", "end points on texel centres", 0, 100};
    table.channel_names = {"R", "G", "B"};
    table.image = sample_image(16, 8, 3);
    table.certified = true;
    table.certificate = {{1e-7, 3.25e-8},
                         {7.1e-3, 2e-4},
                         128,
                         1024,
                         "adaptive quadrature",
                         "1 is full transmittance",
                         "cos_zenith -0.01",
                         "a larger size"};
    table.probes = sample_probes(table.image);
    table.parameters = "[atmosphere]\nground_radius = \"6360000 m\"\n";
    table.details = {{"nodes", "12"}};
    return table;
}

// Bakes sample tables of these names into the folder, manifest and all.
inline Manifest write_sample_bake(const std::filesystem::path& folder,
                                  const std::vector<std::string>& names) {
    Manifest manifest = new_manifest({});
    manifest.wavelengths_nm = {680, 550, 440};
    for (const std::string& name : names) {
        auto table = encode_table(sample_table(name));
        EXPECT_TRUE(table.value.has_value());
        EXPECT_TRUE(write_table(*table.value, folder).value.has_value());
        table.value->asset.timing.bake_s = 0.004;
        manifest.assets.push_back(table.value->asset);
    }
    EXPECT_TRUE(
        write_file_atomically(folder / manifest_name, manifest_json(manifest)).value.has_value());
    return manifest;
}

inline std::string first_code(const std::vector<config::Diagnostic>& diagnostics) {
    return diagnostics.empty() ? "" : diagnostics[0].code;
}

}  // namespace skybake::testing
