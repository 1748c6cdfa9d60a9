#include "bakers/io/formats/vdb/vdb_strips.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "bakers/field/baked.h"
#include "bakers/field/value_kernel.h"
#include "bakers/io/files/file_io.h"

namespace skybake {
namespace {

// The size of a strip, which is the unit of parallel work. Its rows are as long as a node, because
// some noises are cheap along x. A node has several strips, because small volumes have only one
// node.
constexpr std::array<int, 3> strip_edges = {vdb_node_edge, 32, vdb_node_edge};
// The largest float that does not round to an infinite half: the one before 65520, which is half-way
// between 65504 and 65536.
constexpr float largest_half_source = 65519.99609375F;

}  // namespace

std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size) {
    std::vector<VoxelBox> strips;
    for (const VoxelBox& upper : cells_in_tree_order({{}, size}, vdb_upper_node_edge)) {
        for (const VoxelBox& node : cells_in_tree_order(upper, vdb_node_edge)) {
            for (const VoxelBox& strip : cells_in_tree_order(node, strip_edges)) {
                strips.push_back(strip);
            }
        }
    }
    return strips;
}

VdbStripMaker::VdbStripMaker(const Baked& volume, const Level& level, const VdbCodec& codec,
                             const std::filesystem::path& path)
    : volume_(volume),
      level_(level),
      codec_(codec),
      path_(path),
      encoding_{volume.pixel_type == PixelType::half, volume.vdb_compression} {}

void VdbStripMaker::evaluate(const VoxelBox& strip, std::size_t channel, VdbStripSlot& slot) const {
    slot.values.resize(static_cast<std::size_t>(strip.count()));
    std::vector<float*> channels(volume_.channel_names.size(), nullptr);
    channels[channel] = slot.values.data();
    level_.voxels->fill(strip, channels);
    slot.error = unstorable_voxel(slot.values, strip, channel);
    if (slot.error) return;
    slot.leaves = volume_.sparse ? active_leaves(strip, slot.values.data(), volume_.pixel_type)
                                 : all_leaves(strip);
}

void VdbStripMaker::encode(const VoxelBox& strip, VdbStripSlot& slot) const {
    codec_.encode_strip(strip, slot.values.data(), slot.leaves, encoding_, slot.encoded);
}

// Returns a diagnostic for the first voxel that the file cannot hold, or nothing.
std::optional<Diagnostic> VdbStripMaker::unstorable_voxel(const AlignedFloats& values,
                                                          const VoxelBox& strip,
                                                          std::size_t channel) const {
    const float bound = encoding_.half ? largest_half_source : std::numeric_limits<float>::max();
    // First checks whether there is such a voxel at all, because a typical strip has none.
    if (are_within(values.data(), values.size(), -bound, bound)) return std::nullopt;
    std::size_t i = 0;
    while (std::abs(values[i]) <= bound) ++i;  // no NaN is
    const std::size_t width = static_cast<std::size_t>(strip.size[0]);
    const std::size_t plane = width * static_cast<std::size_t>(strip.size[1]);
    const std::string place = fmt::format(
        "({}, {}, {}), channel {}", static_cast<std::size_t>(strip.origin[0]) + i % width,
        static_cast<std::size_t>(strip.origin[1]) + i % plane / width,
        static_cast<std::size_t>(strip.origin[2]) + i / plane, volume_.channel_names[channel]);
    if (!std::isfinite(values[i])) {
        return file_error("E0401", path_.string(),
                          fmt::format("the voxel at {} is {}", place, values[i]));
    }
    return file_error(
        "E0402", path_.string(),
        fmt::format("the voxel at {} is {}: a half holds at most 65504", place, values[i]));
}

}  // namespace skybake
