#include "bakers/field/held_voxels.h"

#include <atomic>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace skybake {

namespace {

std::atomic<std::int64_t>& bytes_of_held_voxels() {
    static std::atomic<std::int64_t> bytes = 0;
    return bytes;
}

// Knows as much of empty boxes as its source does: writers and grids skip them unread.
class HeldSource : public VoxelSource {
  public:
    HeldSource(std::shared_ptr<const VoxelSource> source, std::unique_ptr<VoxelMemory> memory,
               const std::array<int, 3>& size, int channels, const BakeOptions& options)
        : source_(std::move(source)),
          memory_(std::move(memory)),
          voxels_(*source_, size, channels, options, "voxels") {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        voxels_.fill(box, channels);
    }
    bool is_empty(const VoxelBox& box) const override { return source_->is_empty(box); }

  private:
    std::shared_ptr<const VoxelSource> source_;
    std::unique_ptr<VoxelMemory> memory_;
    StoredSource voxels_;
};

}  // namespace

VoxelMemory::VoxelMemory(std::int64_t bytes) : bytes_(bytes) {
    assert(bytes >= 0);
    bytes_of_held_voxels() += bytes_;
}

VoxelMemory::~VoxelMemory() { bytes_of_held_voxels() -= bytes_; }

std::int64_t VoxelMemory::total() { return bytes_of_held_voxels(); }

std::shared_ptr<const VoxelSource> held_voxels(std::shared_ptr<const VoxelSource> source,
                                               const std::array<int, 3>& size, int channels,
                                               const BakeOptions& options) {
    const auto bytes_in_float = static_cast<std::int64_t>(sizeof(float));
    const std::int64_t bytes = VoxelBox{{}, size}.count() * channels * bytes_in_float;
    // It is counted before it is compared, so that bakes on other threads see it.
    auto memory = std::make_unique<VoxelMemory>(bytes);
    if (VoxelMemory::total() > options.held_voxel_bytes) return source;
    return std::make_shared<HeldSource>(std::move(source), std::move(memory), size, channels,
                                        options);
}

}  // namespace skybake
