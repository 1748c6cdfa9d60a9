// Checks of a file that the tests of several formats share: every voxel in its place, and no damaged file
// taken for a whole one.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/format.h"
#include "tests/io/files.h"
#include "tests/io/open_formats.h"

namespace skybake::testing {

inline constexpr std::array<config::PixelType, 4> kPixelTypes = {
    config::PixelType::float32, config::PixelType::half, config::PixelType::unorm8,
    config::PixelType::unorm16};

// Writes an asset over the file `a.file` and returns its bytes.
inline std::string written(const TemporaryFolder& folder, config::FileFormat format,
                           const Baked& baked, int threads) {
    const auto path = folder / "a.file";
    write_bytes(path, "what was there before");
    const auto result = write_as(format, baked, threads, nullptr, path);
    EXPECT_EQ(result.value, true);
    for (const auto& diagnostic : result.diagnostics) ADD_FAILURE() << diagnostic.message;
    return read_bytes(path);
}

// Returns the code of what the format's writer refuses; empty where it writes.
inline std::string write_code(config::FileFormat format, const Baked& baked) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.file", "");
    return first_code(write_as(format, baked, 1, nullptr, folder / "a.file").diagnostics);
}

// Expects either a value or a diagnostic, and returns the code of the first diagnostic.
template <class T>
std::string code_without_value(const config::Outcome<T>& outcome) {
    EXPECT_NE(outcome.value.has_value(), !outcome.diagnostics.empty());
    return first_code(outcome.diagnostics);
}

// Returns the code of what the format's reader refuses of a file, read as one of this shape.
inline std::string read_code(config::FileFormat format, const std::filesystem::path& path,
                             const FileShape& shape) {
    const auto visit = [](std::int64_t, std::int64_t, const float*) { return true; };
    return code_without_value(read_file_of(format_of(format), path, shape, 0, visit));
}

// Returns the texels of a level of an asset's file, which come in their order.
inline std::vector<float> texels_of(config::FileFormat format, const Baked& baked, int level,
                                    const std::filesystem::path& path) {
    const std::size_t channels = baked.channel_names.size();
    std::vector<float> found;
    const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
        EXPECT_EQ(static_cast<std::size_t>(first) * channels, found.size());
        found.insert(found.end(), values, values + static_cast<std::size_t>(count) * channels);
        return true;
    };
    const auto read = read_file_of(format_of(format), path, shape_of(baked), level, visit);
    EXPECT_EQ(read.value, true);
    for (const auto& diagnostic : read.diagnostics) ADD_FAILURE() << diagnostic.message;
    return found;
}

// The value that a file of a volume of sample_voxel holds.
inline float stored(const std::array<int, 3>& voxel, int channel, config::PixelType type) {
    return round_to_pixel_type(sample_voxel(voxel[0], voxel[1], voxel[2], channel), type);
}

// Reads level 0 by the format's reader; how many values are not those of sample_voxel.
inline long wrong_values(config::FileFormat format, const Baked& baked,
                         const std::filesystem::path& path) {
    const std::vector<float> found = texels_of(format, baked, 0, path);
    const auto channels = static_cast<int>(baked.channel_names.size());
    const auto& size = baked.levels[0].size;
    EXPECT_EQ(found.size(), static_cast<std::size_t>(VoxelBox{{}, size}.count() * channels));
    long wrong = 0;
    std::size_t i = 0;
    for_each_voxel(size, [&](int x, int y, int z) {
        for (int c = 0; c < channels && i < found.size(); ++c) {
            wrong += found[i++] == stored({x, y, z}, c, baked.pixel_type) ? 0 : 1;
        }
    });
    return wrong;
}

// Writes an asset on one thread and on three, and reads back what was written.
inline void expect_reads_back(config::FileFormat format, const Baked& baked) {
    const TemporaryFolder folder;
    const std::string bytes = written(folder, format, baked, 1);
    EXPECT_TRUE(written(folder, format, baked, 3) == bytes);
    EXPECT_EQ(wrong_values(format, baked, folder / "a.file"), 0);
}

// Reads the asset's file cut short, changed in a byte, and as one of another shape. Sparse grids do
// not state the size of the volume.
inline void expect_refuses_damage(config::FileFormat format, const Baked& volume,
                                  bool states_size = true) {
    const TemporaryFolder folder;
    const Format& row = format_of(format);
    Random random(7);
    const FileShape shape = shape_of(volume);
    const std::string whole = written(folder, format, volume, 1);
    const auto code_of = [&](const std::string& name, const FileShape& as) {
        return read_code(format, folder / name, as);
    };
    EXPECT_EQ(code_of("a.file", shape), "");
    for (std::size_t size = 0; size < whole.size(); size += 1 + random.below(whole.size() / 40)) {
        write_bytes(folder / "cut", whole.substr(0, size));
        EXPECT_EQ(code_of("cut", shape), "E0304") << size;
    }
    for (int i = 0; i < 300; ++i) {
        std::string bytes = whole;
        // Every second time the head, where damage hurts most, in several bytes.
        const std::size_t reach =
            i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 500) : bytes.size();
        for (std::size_t k = i % 2 == 0 ? random.below(8) + 1 : 1; k > 0; --k) {
            bytes[random.below(reach)] = static_cast<char>(random.below(256));
        }
        write_bytes(folder / "changed", bytes);
        // Each answer is right that is one: a value or a refusal.
        if (row.inspect) code_without_value(inspect_file(row, folder / "changed"));
        static_cast<void>(code_of("changed", shape));
    }
    FileShape other = shape;
    other.size[0] += states_size ? 1 : -8;
    EXPECT_EQ(code_of("a.file", other), "E0304");
    EXPECT_EQ(code_of("absent", shape), "E0300");
    if (row.inspect) {
        EXPECT_EQ(code_without_value(inspect_file(row, folder / "absent")), "E0300");
    }
}

// Small files fail only when what they keep for the end is written.
inline void expect_says_why_it_cannot_write(config::FileFormat format) {
    const auto expect_says = [&](const Baked& volume, int threads, const char* path,
                                 const char* reason) {
        const auto result = write_as(format, volume, threads, nullptr, path);
        ASSERT_EQ(first_code(result.diagnostics), "E0301");
        EXPECT_NE(result.diagnostics[0].message.find(reason), std::string::npos)
            << result.diagnostics[0].message;
    };
    const config::PixelType type = config::facts_of(format).holds(config::PixelType::half)
                                       ? config::PixelType::half
                                       : config::PixelType::unorm8;
    for (const std::array<int, 3>& size : {std::array{64, 64, 64}, {1, 1, 1}}) {
        const Baked volume = plain_volume(size, 4, type);
        for (const int threads : {1, 3}) {
            expect_says(volume, threads, "/dev/full", "No space left on device");
        }
        expect_says(volume, 1, "/absent/a", "No such file");
    }
}

}  // namespace skybake::testing
