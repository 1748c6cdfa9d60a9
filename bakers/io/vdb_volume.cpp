#include "bakers/io/vdb_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

#include "bakers/core/aligned_floats.h"
#include "bakers/core/parallel.h"
#include "bakers/core/voxel_boxes.h"
#include "bakers/io/file_diagnostic.h"
#include "bakers/io/file_input.h"
#include "bakers/io/file_output.h"
#include "bakers/io/vdb_codec.h"
#include "bakers/io/vdb_layout.h"
#include "bakers/io/vdb_module.h"

namespace skybake {
namespace {

using config::Diagnostic;
using config::Outcome;
using config::PixelType;
namespace fs = std::filesystem;

// The unit of parallel work: rows as long as a node, for the sake of noises that are cheap along x,
// and several parts of each node, since small volumes have but one.
constexpr std::array<int, 3> strip_edges = {vdb_node_edge, 32, vdb_node_edge};
// From here on a float rounds to an infinite half: half-way between 65504 and 65536.
constexpr float half_overflow = 65520;
constexpr std::size_t hash_digits = 32;

Diagnostic cannot_write(const fs::path& path, const std::string& reason) {
    return file_error("E0301", path.string(),
                      fmt::format("cannot write `{}`: {}", path.string(), reason));
}

// --- What to write ------------------------------------------------------------------------------

// 32 digits in the groups of a UUID.
std::string uuid_of(const std::string& hash) {
    return fmt::format("{}-{}-{}-{}-{}", hash.substr(0, 8), hash.substr(8, 4), hash.substr(12, 4),
                       hash.substr(16, 4), hash.substr(20, 12));
}

// What would make a file that this writer does not know, as a mistake of the program.
std::optional<std::string> contradiction(const BakedVolume& volume, int level_number) {
    if (level_number < 0 || static_cast<std::size_t>(level_number) >= volume.levels.size()) {
        return fmt::format("a volume without level {}", level_number);
    }
    const VolumeLevel& level = volume.levels[static_cast<std::size_t>(level_number)];
    for (const int size : level.size) {
        if (size < 1) return "a volume without voxels";
    }
    if (volume.channel_names.empty()) return "a volume without channels";
    if (volume.pixel_type != PixelType::half && volume.pixel_type != PixelType::float32) {
        return "VDB files hold float or half";
    }
    if (level.content_hash.size() != hash_digits ||
        level.content_hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
        return fmt::format("`{}` is not a content hash", level.content_hash);
    }
    for (const double edge : volume.voxel_size_m) {
        if (!(edge > 0) || !std::isfinite(edge)) return fmt::format("voxels of {} m", edge);
    }
    return std::nullopt;
}

// A grid per channel, in their order.
std::vector<VdbGridDescription> describe_grids(const BakedVolume& volume,
                                               const VolumeLevel& level) {
    VdbGridDescription grid;
    grid.size = level.size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double voxels = volume.levels[0].size[axis];
        grid.voxel_size[axis] = volume.voxel_size_m[axis] * (voxels / level.size[axis]);
        grid.first_centre[axis] = volume.minimum_m[axis] + grid.voxel_size[axis] / 2;
    }
    grid.encoding = {volume.pixel_type == PixelType::half, volume.vdb_compression};
    grid.metadata = {{"units", "metres"}, {"up_axis", volume.up_axis}};
    std::vector<VdbGridDescription> grids;
    for (const std::string& name : volume.channel_names) {
        grid.name = volume.channel_names.size() == 1 ? "density" : name;
        grids.push_back(grid);
    }
    return grids;
}

// A part of a node, in the order in which parts are encoded.
struct Strip {
    VoxelBox box;
    bool completes_node = false;
};

std::vector<Strip> strips_of(const std::array<int, 3>& size) {
    std::vector<Strip> strips;
    for (const VoxelBox& upper : cells_in_tree_order({{}, size}, vdb_upper_node_edge)) {
        for (const VoxelBox& node : cells_in_tree_order(upper, vdb_node_edge)) {
            for (const VoxelBox& box : cells_in_tree_order(node, strip_edges)) {
                strips.push_back({box, false});
            }
            strips.back().completes_node = true;
        }
    }
    return strips;
}

// --- Writing ------------------------------------------------------------------------------------

class VolumeWriter {
  public:
    VolumeWriter(const BakedVolume& volume, const VolumeLevel& level, const VdbCodec& codec,
                 Progress* progress, const fs::path& path)
        : volume_(volume),
          level_(level),
          codec_(codec),
          progress_(progress),
          path_(path),
          grids_(describe_grids(volume, level)),
          strips_(strips_of(level.size)),
          file_(path) {}

    Outcome<bool> write(const Attributes& attributes, int threads);

  private:
    struct Slot {
        AlignedFloats values;
        VdbStrip encoded;
        std::optional<Diagnostic> error;
    };

    bool cancelled() const { return progress_ != nullptr && progress_->cancelled(); }
    std::size_t grid_of(int index) const {
        return static_cast<std::size_t>(index) / strips_.size();
    }
    std::size_t strip_of(int index) const {
        return static_cast<std::size_t>(index) % strips_.size();
    }
    void produce(int index, Slot& slot) const;
    bool consume(int index, Slot& slot);
    std::optional<Diagnostic> unstorable_voxel(const AlignedFloats& values, const VoxelBox& box,
                                               std::size_t channel) const;
    void begin_grid(const VdbGridDescription& grid);
    void write_node();
    void end_grid();
    bool going_well() const { return !error_ && file_.error() == 0 && !cancelled(); }

    const BakedVolume& volume_;
    const VolumeLevel& level_;
    const VdbCodec& codec_;
    Progress* const progress_;
    const fs::path& path_;
    const std::vector<VdbGridDescription> grids_;
    const std::vector<Strip> strips_;  // of one grid
    const std::size_t count_ = grids_.size() * strips_.size();
    FileOutput file_;
    bool complete_ = false;
    std::optional<Diagnostic> error_;
    std::vector<VdbStrip> node_;  // the strips of a node that is not complete
    std::uint64_t positions_at_ = 0, grid_at_ = 0, voxels_at_ = 0;  // of the grid
};

// The first voxel that the file cannot hold.
std::optional<Diagnostic> VolumeWriter::unstorable_voxel(const AlignedFloats& values,
                                                         const VoxelBox& box,
                                                         std::size_t channel) const {
    const bool half = volume_.pixel_type == PixelType::half;
    const float bound = half ? half_overflow : INFINITY;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::abs(values[i]) < bound) continue;  // no NaN is
        const std::size_t width = static_cast<std::size_t>(box.size[0]);
        const std::size_t plane = width * static_cast<std::size_t>(box.size[1]);
        const std::string place = fmt::format(
            "({}, {}, {}), channel {}", static_cast<std::size_t>(box.origin[0]) + i % width,
            static_cast<std::size_t>(box.origin[1]) + i % plane / width,
            static_cast<std::size_t>(box.origin[2]) + i / plane, volume_.channel_names[channel]);
        if (!std::isfinite(values[i])) {
            return file_error("E0401", path_.string(),
                              fmt::format("the voxel at {} is {}", place, values[i]));
        }
        return file_error(
            "E0402", path_.string(),
            fmt::format("the voxel at {} is {}: a half holds at most 65504", place, values[i]));
    }
    return std::nullopt;
}

void VolumeWriter::produce(int index, Slot& slot) const {
    if (cancelled()) return;
    const std::size_t channel = grid_of(index);
    const VoxelBox& box = strips_[strip_of(index)].box;
    try {
        slot.values.resize(static_cast<std::size_t>(box.count()));
        std::vector<float*> channels(volume_.channel_names.size(), nullptr);
        channels[channel] = slot.values.data();
        level_.voxels->fill(box, channels);
        slot.error = unstorable_voxel(slot.values, box, channel);
        if (slot.error) return;
        codec_.encode_strip(box, slot.values.data(), grids_[channel].encoding, slot.encoded);
    } catch (const std::exception& error) {
        slot.error = cannot_write(path_, error.what());
    }
}

bool VolumeWriter::consume(int index, Slot& slot) {
    if (!going_well()) return false;
    error_ = slot.error;
    if (error_) return false;
    try {
        const std::size_t strip = strip_of(index);
        if (strip == 0) begin_grid(grids_[grid_of(index)]);
        node_.push_back(std::move(slot.encoded));
        if (strips_[strip].completes_node) write_node();
        if (strip + 1 == strips_.size()) end_grid();
        complete_ = static_cast<std::size_t>(index) + 1 == count_ && going_well();
    } catch (const std::exception& error) {
        error_ = cannot_write(path_, error.what());
    }
    if (progress_ != nullptr) {
        progress_->advance("write", (index + 1.0) / static_cast<double>(count_));
    }
    return going_well();
}

void VolumeWriter::begin_grid(const VdbGridDescription& grid) {
    const VdbGridHead head = codec_.grid_head(grid);
    positions_at_ = file_.position() + head.positions_at;
    grid_at_ = file_.position() + head.grid_at;
    file_.write(head.bytes);
    codec_.topology(grid.size, grid.encoding, [&](std::string_view bytes) {
        file_.write(bytes);
        return going_well();
    });
    voxels_at_ = file_.position();
}

// Interleaves the columns of the node's strips.
void VolumeWriter::write_node() {
    const std::size_t columns = node_[0].column_ends.size();
    for (std::size_t column = 0; column < columns; ++column) {
        for (const VdbStrip& strip : node_) {
            const std::size_t begin = column == 0 ? 0 : strip.column_ends[column - 1];
            const std::string_view bytes = strip.bytes;
            file_.write(bytes.substr(begin, strip.column_ends[column] - begin));
        }
    }
    node_.clear();
}

void VolumeWriter::end_grid() {
    const std::uint64_t end = file_.position();
    file_.seek(positions_at_);
    file_.write(codec_.grid_positions(grid_at_, voxels_at_, end));
    file_.seek(end);
}

Outcome<bool> VolumeWriter::write(const Attributes& attributes, int threads) {
    file_.write(codec_.file_head(uuid_of(level_.content_hash), attributes,
                                 static_cast<int>(grids_.size())));
    std::vector<Slot> slots(static_cast<std::size_t>(box_slots(threads)));
    const auto slot_of = [&](int slot) -> Slot& { return slots[static_cast<std::size_t>(slot)]; };
    if (going_well()) {
        ordered_pipeline(
            static_cast<int>(count_), threads, static_cast<int>(slots.size()),
            [&](int index, int slot) { produce(index, slot_of(slot)); },
            [&](int index, int slot) { return consume(index, slot_of(slot)); });
    }
    if (error_) return {{}, {*error_}};
    if (!file_.finish()) return {{}, {file_.diagnostic()}};
    return {complete_, {}};
}

// --- Reading ------------------------------------------------------------------------------------

template <class T, class Read>
Outcome<T> read_with_module(const fs::path& path, Read&& read) {
    Outcome<FileInput> opened = FileInput::open(path);  // says why it cannot be, OpenVDB does not
    if (!opened.value) return {{}, std::move(opened.diagnostics)};
    const LoadedVdbCodec& loaded = vdb_codec();
    if (loaded.codec != nullptr) return read(*loaded.codec);
    return {{},
            {file_error("E0300", path.string(),
                        fmt::format("cannot read `{}`: {}", path.string(), loaded.reason))}};
}

}  // namespace

std::optional<Diagnostic> vdb_obstacle(const fs::path& path) {
    const LoadedVdbCodec& loaded = vdb_codec();
    if (loaded.codec != nullptr) return std::nullopt;
    return cannot_write(path, loaded.reason);
}

Outcome<bool> write_vdb(const BakedVolume& volume, int level, const Attributes& attributes,
                        int threads, Progress* progress, const fs::path& path) {
    if (const auto reason = contradiction(volume, level)) {
        return {{}, {file_error("E0500", path.string(), *reason)}};
    }
    const LoadedVdbCodec& loaded = vdb_codec();
    if (loaded.codec == nullptr) return {{}, {cannot_write(path, loaded.reason)}};
    try {
        VolumeWriter writer(volume, volume.levels[static_cast<std::size_t>(level)], *loaded.codec,
                            progress, path);
        return writer.write(attributes, threads);
    } catch (const std::exception& error) {
        return {{}, {cannot_write(path, error.what())}};
    }
}

Outcome<VdbFile> read_vdb(const fs::path& path) {
    return read_with_module<VdbFile>(path, [&](const VdbCodec& codec) { return codec.read(path); });
}

Outcome<bool> read_vdb_voxels(const fs::path& path,
                              const std::function<bool(const VdbSlab& slab)>& visit) {
    return read_with_module<bool>(
        path, [&](const VdbCodec& codec) { return codec.read_voxels(path, visit); });
}

}  // namespace skybake
