#include "bakers/io/manifest/compare_volumes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>
#include <utility>

#include "bakers/io/formats/format.h"
#include "bakers/io/volumes/grid_files.h"
#include "bakers/io/volumes/leaf_cubes.h"

namespace skybake {
namespace {

using config::Outcome;
namespace fs = std::filesystem;

constexpr std::int64_t most_compared = 16384;  // along an axis

bool holds_numbers(const VdbGrid& grid) {
    constexpr std::array<std::string_view, 7> types = {"float", "half", "double", "int32",
                                                       "int64", "fp8",  "fp16"};
    return std::find(types.begin(), types.end(), grid.value_type) != types.end();
}

std::string names_of(const VdbFile& file) {
    std::vector<std::string> names;
    for (const VdbGrid& grid : file.grids) names.push_back(grid.name);
    std::sort(names.begin(), names.end());
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

// Why the voxels of two grids are not compared, in words, or "". `box` becomes that of both.
std::string apart(const FileVoxels& first, const FileVoxels& second, VoxelBox& box) {
    const std::string place = place_of(first);
    if (place != place_of(second)) return fmt::format("{} against {}", place, place_of(second));
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
            sum.add(a[i], b[i], [&] {
                const auto at = static_cast<int>(i);
                const int row = at / part.size[0];
                return std::vector{part.origin[0] + at % part.size[0],
                                   part.origin[1] + row % part.size[1],
                                   part.origin[2] + row / part.size[1]};
            });
        }
        return true;
    });
    return sum.finished();
}

// Compares two grids of one name, or says in difference.layout why not.
std::vector<config::Diagnostic> compare_grids(const fs::path& first, const fs::path& second,
                                              const std::string& name,
                                              ImageDifference& difference) {
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
    for (const VdbGrid& grid : a.value->grids) {
        const auto other = std::find_if(b.value->grids.begin(), b.value->grids.end(),
                                        [&](const VdbGrid& one) { return one.name == grid.name; });
        if (!holds_numbers(grid) || !holds_numbers(*other)) {
            difference.layout =
                fmt::format("the bytes differ, and grid {} holds {}, which is not compared",
                            grid.name, grid.value_type);
            continue;
        }
        auto problems = compare_grids(first, second, grid.name, difference);
        if (!problems.empty()) return {{}, std::move(problems)};
    }
    return {std::move(difference), {}};
}

}  // namespace skybake
