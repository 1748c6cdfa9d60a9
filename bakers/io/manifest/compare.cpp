#include "bakers/io/manifest/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bakers/field/voxel_index.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/hdr/hdr.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/volumes/grid_files.h"
#include "bakers/io/volumes/grid_voxels.h"

namespace skybake {
namespace {

std::string layout_of(const ComparedImage& image) {
    return fmt::format("{} x {} {}{}{}", image.rows.width, image.rows.height,
                       fmt::join(image.channel_names, " "), image.window.empty() ? "" : " at ",
                       image.window);
}

// Adds the differences of some rows of one channel. The first of them is row `y` of the image.
void add_rows(const Image2<float>& first, const Image2<float>& second, int rows, int y,
              std::size_t channel, DifferenceSum& sum) {
    for (int row = 0; row < rows; ++row) {
        for (int x = 0; x < first.width; ++x) {
            sum.add(first.texel(x, row)[channel], second.texel(x, row)[channel], [&] {
                return std::vector{x, y + row};
            });
        }
    }
}

// Compares the channels of two images of the same layout.
Outcome<std::vector<ChannelDifference>> compare_channels(const ComparedImage& first,
                                                         const ComparedImage& second) {
    std::vector<DifferenceSum> sums(first.channel_names.size());
    int step = std::min(first.rows.rows_per_piece, first.rows.height);
    const int interleaved = static_cast<int>(sums.size());
    Image2<float> a(first.rows.width, step, interleaved);
    Image2<float> b(first.rows.width, step, interleaved);
    for (int y = 0; y < first.rows.height; y += step) {
        step = std::min(step, first.rows.height - y);
        if (auto problem = first.rows.read(y, step, a.texels.data())) return *problem;
        if (auto problem = second.rows.read(y, step, b.texels.data())) return *problem;
        for (std::size_t c = 0; c < sums.size(); ++c) add_rows(a, b, step, y, c, sums[c]);
    }
    std::vector<ChannelDifference> channels;
    for (DifferenceSum& sum : sums) {
        sum.channel.channel = first.channel_names[channels.size()];
        channels.push_back(sum.finished());
    }
    return {std::move(channels), {}};
}

Attributes facts_of(const ComparedImage& image) {
    Attributes facts = image.attributes;
    facts.emplace_back("pixel type", to_string(image.pixel_type));
    facts.emplace_back("compression", image.compression);
    return facts;
}

std::vector<AttributeDifference> compare_facts(const std::map<std::string, std::string>& first,
                                               const std::map<std::string, std::string>& second) {
    std::map<std::string, AttributeDifference> entries;
    for (const auto& [name, text] : first) entries[name].first = text;
    for (const auto& [name, text] : second) entries[name].second = text;
    std::vector<AttributeDifference> differences;
    for (auto& [name, entry] : entries) {
        if (entry.first == entry.second) continue;
        entry.name = name;
        differences.push_back(std::move(entry));
    }
    return differences;
}

// Returns the members of an entry by their paths, or nothing if the text is not an entry.
std::map<std::string, std::string> members_of(const std::string& text) {
    std::map<std::string, std::string> members;
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return members;
    const nlohmann::json flat = json.flatten();
    for (const auto& [path, value] : flat.items()) {
        members[path.substr(1)] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    return members;
}

namespace fs = std::filesystem;

constexpr std::int64_t most_compared = 16384;  // along an axis

bool holds_numbers(const VdbGrid& grid) {
    constexpr std::array<std::string_view, 8> types = {"float", "half", "double", "int32",
                                                       "int64", "fp8",  "fp16",   "vec3s"};
    return std::ranges::find(types, grid.value_type) != types.end();
}

std::map<std::string, const VdbGrid*> grids_by_channel(const VdbFile& file) {
    std::map<std::string, const VdbGrid*> grids;
    for (const VdbGrid& grid : file.grids) {
        for (const std::string& channel : channels_of(grid)) grids[channel] = &grid;
    }
    return grids;
}

std::string names_of(const VdbFile& file) {
    std::vector<std::string> names;
    for (const auto& [channel, grid] : grids_by_channel(file)) names.push_back(channel);
    return fmt::format("{}", fmt::join(names, ", "));
}

Attributes facts_of(const VdbFile& file) {
    Attributes facts = file.attributes;
    facts.emplace_back("library", file.library);
    for (const VdbGrid& grid : file.grids) {
        facts.emplace_back(grid.name + " type", grid.value_type);
        facts.emplace_back(grid.name + " compression", grid.compression);
    }
    return facts;
}

std::string place_of(const FileVoxels& file) {
    return fmt::format("voxels of {:.7g} from {:.7g}", fmt::join(file.voxel_size, ", "),
                       fmt::join(file.index_origin, ", "));
}

// Whether voxels lie at the same places but for rounding.
bool are_at_same_places(const FileVoxels& first, const FileVoxels& second) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double edge_m = first.voxel_size[i];
        const double origin_m = first.index_origin[i];
        const double rounding_m = 1e-6 * edge_m + 1e-7 * std::fabs(origin_m);
        if (!(std::fabs(second.voxel_size[i] - edge_m) <= 1e-6 * edge_m) ||
            !(std::fabs(second.index_origin[i] - origin_m) <= rounding_m)) {
            return false;
        }
    }
    return true;
}

// Why the voxels of two grids are not compared, in words, or "". `box` becomes that of both.
std::string apart(const FileVoxels& first, const FileVoxels& second, VoxelBox& box) {
    if (!are_at_same_places(first, second)) {
        return fmt::format("{} against {}", place_of(first), place_of(second));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t begin = std::min(first.first[i], second.first[i]);
        const std::int64_t end = std::max(std::int64_t{first.first[i]} + first.size[i],
                                          std::int64_t{second.first[i]} + second.size[i]);
        if (end - begin > most_compared) {
            return fmt::format("{} voxels along {}, of which at most {} are compared", end - begin,
                               "xyz"[i], most_compared);
        }
        box.origin[i] = static_cast<int>(begin);
        box.size[i] = static_cast<int>(end - begin);
    }
    return "";
}

std::vector<int> voxel_place(const VoxelBox& box, std::int64_t index) {
    const std::array<int, 3> voxel = voxel_at(box, index);
    return {voxel.begin(), voxel.end()};
}

ChannelDifference compare_voxels(const FileVoxels& first, const FileVoxels& second,
                                 const VoxelBox& box) {
    constexpr int edge = 128;  // of a node
    DifferenceSum sum;
    std::vector<float> a, b;
    for_cubes(box, edge, [&](const VoxelBox& part) {
        const auto count = static_cast<std::size_t>(part.count());
        if (first.voxels->is_empty(part) && second.voxels->is_empty(part)) {
            sum.count += part.count();
            return true;
        }
        a.resize(count);
        b.resize(count);
        first.voxels->fill(part, {a.data()});
        second.voxels->fill(part, {b.data()});
        for (std::size_t i = 0; i < count; ++i) {
            sum.add(a[i], b[i], [&] { return voxel_place(part, static_cast<std::int64_t>(i)); });
        }
        return true;
    });
    return sum.finished();
}

// Compares two grids of one name, or says in difference.layout why not.
std::vector<Diagnostic> compare_grids(const fs::path& first, const fs::path& second,
                                      const std::string& name, ImageDifference& difference) {
    const Outcome<FileVoxels> a = open_numbers(first, name);
    if (!a.value) return a.diagnostics;
    const Outcome<FileVoxels> b = open_numbers(second, name);
    if (!b.value) return b.diagnostics;
    VoxelBox box;
    if (const std::string reason = apart(*a.value, *b.value, box); !reason.empty()) {
        difference.layout = fmt::format("grid {}: {}", name, reason);
        return {};
    }
    try {
        difference.channels.push_back(compare_voxels(*a.value, *b.value, box));
    } catch (const std::exception& error) {
        return {damaged_file(second, "VDB", error.what())};
    }
    difference.channels.back().channel = name;
    return {};
}

}  // namespace

std::vector<AttributeDifference> metadata_differences(const std::string& first,
                                                      const std::string& second) {
    const auto members = members_of(first);
    const auto others = members_of(second);
    if (first != second && (members.empty() || others.empty())) {
        return {{metadata_name, first, second}};
    }
    return compare_facts(members, others);
}

std::vector<AttributeDifference> attribute_differences(const Attributes& first,
                                                       const Attributes& second) {
    std::vector<AttributeDifference> differences;
    for (AttributeDifference& entry :
         compare_facts({first.begin(), first.end()}, {second.begin(), second.end()})) {
        if (entry.name != metadata_name || !entry.first || !entry.second) {
            differences.push_back(std::move(entry));
            continue;
        }
        for (AttributeDifference& member : metadata_differences(*entry.first, *entry.second)) {
            const bool is_of_texels =
                member.name.starts_with("probes/") || member.name.starts_with("statistics/");
            if (!is_of_texels) differences.push_back(std::move(member));
        }
    }
    return differences;
}

ComparedImage compared(ExrRows& file) {
    const ExrFacts& facts = file.facts();
    return {rows_of(file), facts.channel_names, facts.pixel_type,
            facts.codec,   facts.attributes,    facts.window};
}

config::Outcome<ComparedImage> compared_radiance(const std::filesystem::path& path) {
    config::Outcome<HdrPicture> picture = read_hdr_picture(path);
    if (!picture.value) return {{}, std::move(picture.diagnostics)};
    ComparedImage image;
    image.rows = std::move(picture.value->rows);
    image.channel_names = {"R", "G", "B"};
    image.pixel_type = PixelType::rgbe;
    if (const std::string& entry = picture.value->entry; !entry.empty()) {
        image.attributes.emplace_back(metadata_name, entry);
    }
    return {std::move(image), {}};
}

config::Outcome<ImageDifference> compare_images(const ComparedImage& first,
                                                const ComparedImage& second) {
    ImageDifference difference;
    difference.attributes = attribute_differences(facts_of(first), facts_of(second));
    if (layout_of(first) != layout_of(second)) {
        difference.layout = fmt::format("{} against {}", layout_of(first), layout_of(second));
        return {std::move(difference), {}};
    }
    auto channels = compare_channels(first, second);
    if (!channels.value) return {{}, std::move(channels.diagnostics)};
    difference.channels = std::move(*channels.value);
    return {std::move(difference), {}};
}

std::optional<ListedFile> listed_file(const std::filesystem::path& path) {
    const auto manifest = read_manifest(path.parent_path());
    if (!manifest.value) return std::nullopt;
    for (const ManifestAsset& asset : manifest.value->assets) {
        for (const ManifestFile& file : asset.files) {
            const Format* const format = find_format(file.format);
            if (file.path != path.filename() || !format || !format->read) continue;
            return ListedFile{path, asset, file};
        }
    }
    return std::nullopt;
}

config::Outcome<ImageDifference> compare_listed(const ListedFile& first, const ListedFile& second,
                                                int level) {
    const auto shape_of = [level](const ListedFile& listed) {
        const auto number = static_cast<std::size_t>(listed.file.level + level);
        return fmt::format("{} of {}", fmt::join(listed.asset.levels[number].size, "x"),
                           fmt::join(listed.asset.channels, ", "));
    };
    ImageDifference difference;
    if (shape_of(first) != shape_of(second)) {
        difference.layout = fmt::format("{} against {}", shape_of(first), shape_of(second));
        return {std::move(difference), {}};
    }
    const VoxelBox box{{},
                       first.asset.levels[static_cast<std::size_t>(first.file.level + level)].size};
    const std::size_t channels = first.asset.channels.size();
    std::vector<float> held(static_cast<std::size_t>(box.count()) * channels);
    std::vector<DifferenceSum> sums(channels);
    const auto at = [channels](std::int64_t voxel) {
        return static_cast<std::size_t>(voxel) * channels;
    };
    const auto hold = [&](std::int64_t begin, std::int64_t count, const float* values) {
        std::copy_n(values, at(count), held.begin() + std::ptrdiff_t(at(begin)));
        return true;
    };
    const auto compare = [&](std::int64_t begin, std::int64_t count, const float* values) {
        for (std::size_t i = 0; i < at(count); ++i) {
            sums[i % channels].add(held[at(begin) + i], values[i], [&] {
                return voxel_place(box, begin + static_cast<std::int64_t>(i / channels));
            });
        }
        return true;
    };
    auto read = read_asset_file(first.path, first.asset, first.file, level, hold);
    if (!read.value) return {{}, std::move(read.diagnostics)};
    read = read_asset_file(second.path, second.asset, second.file, level, compare);
    if (!read.value) return {{}, std::move(read.diagnostics)};
    for (std::size_t c = 0; c < channels; ++c) {
        sums[c].channel.channel = first.asset.channels[c];
        difference.channels.push_back(sums[c].finished());
    }
    return {std::move(difference), {}};
}

bool equal_within(const ImageDifference& difference, double tolerance) {
    return difference.layout.empty() &&
           std::ranges::all_of(difference.channels, [tolerance](const ChannelDifference& channel) {
               return channel.max_absolute <= tolerance;
           });
}

Outcome<ImageDifference> compare_volumes(const fs::path& first, const fs::path& second) {
    const Outcome<VdbFile> a = read_grids(first);
    if (!a.value) return {{}, a.diagnostics};
    const Outcome<VdbFile> b = read_grids(second);
    if (!b.value) return {{}, b.diagnostics};
    ImageDifference difference;
    difference.attributes = attribute_differences(facts_of(*a.value), facts_of(*b.value));
    if (names_of(*a.value) != names_of(*b.value)) {
        difference.layout =
            fmt::format("grids {} against {}", names_of(*a.value), names_of(*b.value));
        return {std::move(difference), {}};
    }
    const std::map<std::string, const VdbGrid*> others = grids_by_channel(*b.value);
    for (const auto& [channel, grid] : grids_by_channel(*a.value)) {
        if (!holds_numbers(*grid) || !holds_numbers(*others.at(channel))) {
            difference.layout =
                fmt::format("the bytes differ, and grid {} holds {}, which is not compared",
                            channel, grid->value_type);
            continue;
        }
        auto problems = compare_grids(first, second, channel, difference);
        if (!problems.empty()) return {{}, std::move(problems)};
    }
    return {std::move(difference), {}};
}

}  // namespace skybake
