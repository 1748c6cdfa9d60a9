// Compares two images: the values of their channels and their attributes.
//
// Compares the grids of OpenVDB and NanoVDB files, of any program, by value.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/file_formats.h"

namespace skybake {

struct ChannelDifference {
    std::string channel;
    double max_absolute = 0;  // infinite where only one of two values is finite
    double rms = 0;
    double max_relative = 0;          // relative to the greater of the two magnitudes
    std::int64_t differing = 0;       // number of texels; NaN equals NaN
    std::vector<int> worst = {0, 0};  // place of max_absolute: column and row, or x, y and z
};

// Gathers the differences of a channel.
struct DifferenceSum {
    ChannelDifference channel;
    double squares = 0;
    std::int64_t count = 0;

    // Adds two values at a place, which `place()` returns.
    template <class Place>
    void add(double a, double b, const Place& place) {
        ++count;
        if (a == b || (std::isnan(a) && std::isnan(b))) return;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double difference = std::abs(a - b);
        const double absolute = std::isnan(difference) ? infinity : difference;
        const double larger = std::max(std::abs(a), std::abs(b));
        squares += absolute * absolute;
        ++channel.differing;
        channel.max_relative =
            std::max(channel.max_relative, std::isinf(absolute) ? infinity : absolute / larger);
        if (absolute <= channel.max_absolute) return;
        channel.max_absolute = absolute;
        channel.worst = place();
    }
    ChannelDifference finished() {
        channel.rms = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
        return std::move(channel);
    }
};

// A text that differs between two files, or that one of them lacks.
struct AttributeDifference {
    std::string name;
    std::optional<std::string> first;
    std::optional<std::string> second;
};

// Returns the differences between the entries that two files carry (file_entry_json). The names are
// the paths of members, such as "error/lookup/max". Texts that are not entries are compared as a
// whole.
std::vector<AttributeDifference> metadata_differences(const std::string& first,
                                                      const std::string& second);

struct ImageDifference {
    std::string layout;  // why the images cannot be compared (size, channels), or empty
    std::vector<ChannelDifference> channels;      // empty if they cannot be compared
    std::vector<AttributeDifference> attributes;  // pixel type and compression among them
};

// An image for comparison; its rows are read one after the other.
struct ComparedImage {
    RowSource rows;
    std::vector<std::string> channel_names;
    PixelType pixel_type = PixelType::float32;
    std::string compression = "zip";
    Attributes attributes;
    std::string window = {};  // where it lies in a larger image
};

// Makes an open EXR file comparable. The result refers to `file`, which must not be moved.
ComparedImage compared(ExrRows& file);

// Reads a Radiance picture into memory.
config::Outcome<ComparedImage> compared_radiance(const std::filesystem::path& path);

// Reads both images once, row by row. Diagnostics come from the row sources.
Outcome<ImageDifference> compare_images(const ComparedImage& first, const ComparedImage& second);

// A file that the manifest beside it lists, which says how its values are read.
struct ListedFile {
    std::filesystem::path path;
    ManifestAsset asset;
    ManifestFile file;
};

// Returns nothing if no manifest lists the file, or if it has no values of its own.
std::optional<ListedFile> listed_file(const std::filesystem::path& path);

// Compares a level of two files, of the same format or not, by value. The first one's is held in memory.
Outcome<ImageDifference> compare_listed(const ListedFile& first, const ListedFile& second,
                                        int level);

// Returns the differences between facts and texts by name. Those of entries are compared by member, except
// for members that follow from the texels.
std::vector<AttributeDifference> attribute_differences(const Attributes& first,
                                                       const Attributes& second);

// Whether the images have the same layout and no value differs by more than `tolerance`.
bool equal_within(const ImageDifference& difference, double tolerance);

// Compares two files, of the same format or not, grid after grid over the boxes of both, along the
// axes of the files' space. Numbers are as stored, whether active or not. `layout` says which grids hold
// no numbers, lie elsewhere or span more than 16384 voxels along an axis. E0300, E0304.
Outcome<ImageDifference> compare_volumes(const std::filesystem::path& first,
                                         const std::filesystem::path& second);

}  // namespace skybake
