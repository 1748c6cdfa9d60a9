// Writes the records of a VDB file one after the other. write_vdb uses it after it has checked that
// the volume can be written.
//
// In a file, a tree's topology precedes its voxels. The topology of a dense volume follows from its
// size. A sparse volume is surveyed first: all its strips are evaluated in the order of the tree.
// The survey keeps the masks of leaves with active voxels and, up to a number of bytes, the encoded
// voxels. Strips whose bytes are not kept are evaluated again when they are written.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/memory.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// The memory for a strip, and its results: a strip is a part of a volume, and any thread may make one.
struct VdbStripSlot {
    AlignedFloats values;      // of each component after the other
    AlignedFloats magnitudes;  // of vectors: of the largest component
    VdbLeaves leaves;  // leaves with active voxels
    VdbStrip encoded;
    std::optional<config::Diagnostic> error;
};

class VdbWriter {
  public:
    // All arguments must outlive the writer. `progress` may be null.
    VdbWriter(const Baked& volume, const Level& level, const VdbCodec& codec,
              std::size_t most_kept_bytes, Progress* progress, const std::filesystem::path& path);

    // Writes the file. Call it only once.
    config::Outcome<bool> write(const Attributes& attributes, int threads);

  private:
    // A strip with voxels in the file.
    struct Part {
        std::size_t grid = 0;
        VoxelBox strip;
        VdbLeaves leaves;  // for sparse volumes
        bool is_encoded = false;
        VdbStrip encoded;
    };
    using Parts = std::span<const Part>;

    bool cancelled() const { return progress_ != nullptr && progress_->cancelled(); }
    bool going_well() const { return !error_ && file_.error() == 0 && !cancelled(); }
    void report(double fraction);
    // Does some work. What it throws becomes the error.
    template <class Work>
    void attempt(std::optional<config::Diagnostic>& error, const Work& work) const {
        try {
            work();
        } catch (const std::exception& failure) {
            error = cannot_write(path_, failure.what());
        }
    }

    void take_all_parts();
    void survey(int threads);
    void survey_strip(std::size_t grid, const VoxelBox& strip, VdbStripSlot& slot) const;
    void keep(std::size_t grid, const VoxelBox& strip, VdbStripSlot& slot);

    void write_parts(int threads);
    void encode_part(const Part& part, VdbStripSlot& slot) const;
    // Fills in slot.values and slot.leaves, from which `encode` makes slot.encoded. Throws what the
    // volume's source throws.
    void evaluate(const VoxelBox& strip, std::size_t grid, VdbStripSlot& slot) const;
    void encode(const VoxelBox& strip, std::size_t grid, VdbStripSlot& slot) const;
    VdbEncoding encoding_of(std::size_t grid) const;
    bool write_part(std::size_t index, VdbStripSlot& slot);
    void begin_grids_through(std::size_t grid);
    void begin_grid(std::size_t grid);
    VdbGridDescription describe(std::size_t number) const;
    void write_topology(Parts parts, VdbEncoding encoding);
    VdbLeaves leaves_of_node(Parts parts) const;
    void write_node();
    void end_grid();

    const Baked& volume_;
    const Level& level_;
    const VdbCodec& codec_;
    const std::size_t most_kept_bytes_;
    Progress* const progress_;
    const std::filesystem::path& path_;
    const std::vector<VdbGridChannels> grids_;
    FileOutput file_;
    std::optional<config::Diagnostic> error_;

    std::vector<Part> parts_;               // in the order of the file
    std::vector<VdbActiveVoxels> active_;   // per grid
    std::size_t kept_bytes_ = 0;            // of encoded strips
    std::atomic<bool> keeps_bytes_ = true;  // until they are too many

    std::size_t grids_begun_ = 0;
    std::vector<VdbStrip> node_;  // the strips of the node that is not yet complete
    std::uint64_t positions_at_ = 0, grid_at_ = 0, voxels_at_ = 0;  // of the last grid begun
};

}  // namespace skybake
