#include "bakers/io/formats/vdb/vdb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/take_boxes.h"
#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {
namespace {

// The size of a strip, which is the unit of parallel work. Its rows are as long as a node, because
// some noises are cheap along x. A node has several strips, because small volumes have only one
// node.
constexpr std::array<int, 3> strip_edges = {vdb_node_edge, 32, vdb_node_edge};

// Returns the strips of a volume in the order of its tree, node after node.
std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size) {
    std::vector<VoxelBox> strips;
    for (const VoxelBox& node : nodes_in_tree_order(size)) {
        for (const VoxelBox& strip : cells_in_tree_order(node, strip_edges)) {
            strips.push_back(strip);
        }
    }
    return strips;
}

// Arranges 32 digits in the groups of a UUID.
std::string uuid_of(const std::string& hash) {
    return fmt::format("{}-{}-{}-{}-{}", hash.substr(0, 8), hash.substr(8, 4), hash.substr(12, 4),
                       hash.substr(16, 4), hash.substr(20, 12));
}

// Divides parts into runs that are in the same node of this edge.
template <class Part>
std::vector<std::span<const Part>> nodes_of(std::span<const Part> parts, int edge) {
    std::vector<std::span<const Part>> nodes;
    while (!parts.empty()) {
        const auto corner = node_corner(parts.front().strip, edge);
        const auto end = std::find_if(parts.begin(), parts.end(), [&](const Part& part) {
            return node_corner(part.strip, edge) != corner;
        });
        nodes.push_back(parts.first(static_cast<std::size_t>(end - parts.begin())));
        parts = parts.subspan(nodes.back().size());
    }
    return nodes;
}

}  // namespace

VdbWriter::VdbWriter(const Baked& volume, const Level& level, const VdbCodec& codec,
                     std::size_t most_kept_bytes, Progress* progress,
                     const std::filesystem::path& path)
    : volume_(volume),
      level_(level),
      codec_(codec),
      most_kept_bytes_(most_kept_bytes),
      progress_(progress),
      path_(path),
      grids_(vdb_grids(volume)),
      file_(path),
      active_(grids_.size()) {}

Outcome<bool> VdbWriter::write(const Attributes& attributes, int threads) {
    file_.write(codec_.file_head(uuid_of(level_.content_hash), attributes,
                                 static_cast<int>(active_.size())));
    if (volume_.sparse) {
        survey(threads);
    } else {
        take_all_parts();
    }
    if (going_well()) write_parts(threads);
    const bool complete = going_well();
    if (error_) return *error_;
    return file_.finished(complete);
}

void VdbWriter::report(double fraction) {
    if (progress_ != nullptr) progress_->advance("write", fraction);
}

// --- What to write ------------------------------------------------------------------------------

void VdbWriter::take_all_parts() {
    const std::vector<VoxelBox> strips = vdb_strips(level_.size);
    for (std::size_t grid = 0; grid < active_.size(); ++grid) {
        for (const VoxelBox& strip : strips) parts_.push_back({grid, strip, {}, false, {}});
    }
    const auto [width, height, depth] = level_.size;
    const std::int64_t count = VoxelBox{{}, level_.size}.count();
    active_.assign(active_.size(), {{0, 0, 0}, {width - 1, height - 1, depth - 1}, count});
}

void VdbWriter::survey(int threads) {
    return_freed_memory();  // which would wait in vain while bytes are kept
    const std::vector<VoxelBox> strips = vdb_strips(level_.size);
    const std::size_t count = active_.size() * strips.size();
    const auto grid_of = [&](int i) { return static_cast<std::size_t>(i) / strips.size(); };
    const auto strip_of = [&](int i) {
        return strips[static_cast<std::size_t>(i) % strips.size()];
    };
    take_boxes<VdbStripSlot>(
        static_cast<int>(count), threads, box_slots(threads),
        [&](int i, VdbStripSlot& slot) { survey_strip(grid_of(i), strip_of(i), slot); },
        [&](int i, VdbStripSlot& slot) {
            if (!going_well()) return false;
            error_ = slot.error;
            if (!error_) keep(grid_of(i), strip_of(i), slot);
            report(static_cast<double>(i + 1) / static_cast<double>(count) / 2);
            return going_well();
        });
}

void VdbWriter::survey_strip(std::size_t grid, const VoxelBox& strip, VdbStripSlot& slot) const {
    slot.leaves = {};
    if (cancelled()) return;
    attempt(slot.error, [&] {
        if (level_.voxels->is_empty(strip)) return;
        evaluate(strip, grid, slot);
        if (!slot.leaves.empty() && keeps_bytes_) encode(strip, grid, slot);
    });
}

VdbEncoding VdbWriter::encoding_of(std::size_t grid) const {
    return {volume_.pixel_type == PixelType::half, grids_[grid].count, volume_.vdb_compression};
}

void VdbWriter::evaluate(const VoxelBox& strip, std::size_t grid, VdbStripSlot& slot) const {
    const auto count = static_cast<std::size_t>(strip.count());
    const auto components = static_cast<std::size_t>(grids_[grid].count);
    slot.values.resize(count * components);
    std::vector<float*> channels(volume_.channel_names.size(), nullptr);
    for (std::size_t c = 0; c < components; ++c) {
        channels[grids_[grid].first + c] = slot.values.data() + c * count;
    }
    level_.voxels->fill(strip, channels);
    if (!volume_.sparse) {
        slot.leaves = all_leaves(strip);
        return;
    }
    const float* magnitudes = slot.values.data();
    if (components > 1) {
        slot.magnitudes.assign(count, 0);
        for (std::size_t c = 0; c < components; ++c) {
            const float* const values = slot.values.data() + c * count;
            for (std::size_t i = 0; i < count; ++i) {
                slot.magnitudes[i] = std::max(slot.magnitudes[i], std::fabs(values[i]));
            }
        }
        magnitudes = slot.magnitudes.data();
    }
    slot.leaves = active_leaves(strip, magnitudes, volume_.pixel_type);
}

void VdbWriter::encode(const VoxelBox& strip, std::size_t grid, VdbStripSlot& slot) const {
    codec_.encode_strip(strip, slot.values.data(), slot.leaves, encoding_of(grid), slot.encoded);
}

// Keeps the bytes of the first strips, as far as they fit. Which strips these are does not depend
// on threads; only the number of strips that are encoded in vain does.
void VdbWriter::keep(std::size_t grid, const VoxelBox& strip, VdbStripSlot& slot) {
    if (slot.leaves.empty()) return;
    active_[grid].add(strip, slot.leaves);
    attempt(error_, [&] {
        // Copies take no more memory than they need.
        Part& part = parts_.emplace_back(Part{grid, strip, slot.leaves, false, {}});
        if (!keeps_bytes_) return;
        keeps_bytes_ = slot.encoded.bytes.size() <= most_kept_bytes_ - kept_bytes_;
        if (!keeps_bytes_) return;
        kept_bytes_ += slot.encoded.bytes.size();
        part.encoded = slot.encoded;
        part.is_encoded = true;
    });
}

// --- Writing ------------------------------------------------------------------------------------

void VdbWriter::write_parts(int threads) {
    const double surveyed = volume_.sparse ? 0.5 : 0;
    take_boxes<VdbStripSlot>(
        static_cast<int>(parts_.size()), threads, box_slots(threads),
        [&](int i, VdbStripSlot& slot) { encode_part(parts_[static_cast<std::size_t>(i)], slot); },
        [&](int i, VdbStripSlot& slot) {
            if (!going_well()) return false;
            error_ = slot.error;
            if (error_ || !write_part(static_cast<std::size_t>(i), slot)) return false;
            const double written = static_cast<double>(i + 1) / static_cast<double>(parts_.size());
            report(surveyed + (1 - surveyed) * written);
            return going_well();
        });
    if (!going_well()) return;
    begin_grids_through(active_.size() - 1);
    end_grid();
}

void VdbWriter::encode_part(const Part& part, VdbStripSlot& slot) const {
    if (part.is_encoded || cancelled()) return;
    attempt(slot.error, [&] {
        evaluate(part.strip, part.grid, slot);
        encode(part.strip, part.grid, slot);
    });
}

bool VdbWriter::write_part(std::size_t index, VdbStripSlot& slot) {
    Part& part = parts_[index];
    attempt(error_, [&] {
        begin_grids_through(part.grid);
        node_.push_back(std::move(part.is_encoded ? part.encoded : slot.encoded));
        const bool is_last = index + 1 == parts_.size() || parts_[index + 1].grid != part.grid ||
                             node_corner(parts_[index + 1].strip, vdb_node_edge) !=
                                 node_corner(part.strip, vdb_node_edge);
        if (is_last) write_node();
    });
    return going_well();
}

// Begins all grids up to `grid`. Grids without active voxels have no parts, so several may begin.
void VdbWriter::begin_grids_through(std::size_t grid) {
    while (grids_begun_ <= grid) {
        if (grids_begun_ > 0) end_grid();
        begin_grid(grids_begun_++);
    }
}

void VdbWriter::begin_grid(std::size_t grid) {
    const VdbGridHead head = codec_.grid_head(describe(grid));
    positions_at_ = file_.position() + head.positions_at;
    grid_at_ = file_.position() + head.grid_at;
    file_.write(head.bytes);
    const auto of_grid = [&](const Part& part, std::size_t other) { return part.grid < other; };
    const auto begin = std::lower_bound(parts_.begin(), parts_.end(), grid, of_grid);
    const auto end = std::lower_bound(begin, parts_.end(), grid + 1, of_grid);
    write_topology(Parts(begin, end), encoding_of(grid));
    voxels_at_ = file_.position();
}

VdbGridDescription VdbWriter::describe(std::size_t number) const {
    VdbGridDescription grid;
    grid.name = grids_[number].name;
    grid.active = active_[number];
    const auto [width, height, depth] = level_.size;
    if (grid.active.count == 0) grid.active = {{0, 0, 0}, {width - 1, height - 1, depth - 1}, 0};
    if (volume_.sparse) grid.size = level_.size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double voxels = volume_.levels[0].size[axis];
        grid.voxel_size[axis] = volume_.voxel_size_m[axis] * (voxels / level_.size[axis]);
        grid.first_centre[axis] = volume_.minimum_m[axis] + grid.voxel_size[axis] / 2;
    }
    grid.encoding = encoding_of(number);
    grid.metadata = {{"units", "metres"}, {"up_axis", volume_.up_axis}};
    return grid;
}

void VdbWriter::write_topology(Parts parts, VdbEncoding encoding) {
    const std::vector<Parts> upper_nodes = nodes_of(parts, vdb_upper_node_edge);
    file_.write(codec_.root(upper_nodes.size(), encoding));
    for (const Parts& upper_node : upper_nodes) {
        const std::vector<Parts> nodes = nodes_of(upper_node, vdb_node_edge);
        std::vector<std::uint16_t> places;
        for (const Parts& node : nodes) {
            places.push_back(child_place(node.front().strip.origin, vdb_node_edge,
                                         vdb_upper_node_edge / vdb_node_edge));
        }
        const auto corner = node_corner(upper_node.front().strip, vdb_upper_node_edge);
        file_.write(codec_.upper_node(corner, places, encoding));
        for (const Parts& node : nodes) {
            file_.write(codec_.lower_node(leaves_of_node(node), encoding));
            if (!going_well()) return;
        }
    }
}

VdbLeaves VdbWriter::leaves_of_node(Parts parts) const {
    std::vector<VdbLeaves> leaves;
    for (const Part& part : parts) {
        leaves.push_back(volume_.sparse ? part.leaves : all_leaves(part.strip));
    }
    return merge_leaves(leaves);
}

// Writes the columns of the node's strips, interleaved.
void VdbWriter::write_node() {
    for (std::size_t column = 0; column < vdb_node_columns; ++column) {
        for (const VdbStrip& strip : node_) {
            const std::size_t begin = column == 0 ? 0 : strip.column_ends[column - 1];
            const std::string_view bytes = strip.bytes;
            file_.write(bytes.substr(begin, strip.column_ends[column] - begin));
        }
    }
    node_.clear();
}

void VdbWriter::end_grid() {
    const std::uint64_t end = file_.position();
    file_.seek(positions_at_);
    file_.write(codec_.grid_positions(grid_at_, voxels_at_, end));
    file_.seek(end);
}

}  // namespace skybake
