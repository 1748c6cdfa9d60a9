// Options that say how a bake runs and how it reports progress. None of them changes a texel.
#pragma once

#include <cstdint>
#include <string_view>

namespace skybake {

// Receives the progress of a long bake, and tells the bake when it should stop.
class Progress {
  public:
    virtual ~Progress() = default;
    // Reports the fraction of the named step that is done, in [0, 1]. May be called from any
    // thread.
    virtual void advance(std::string_view step, double fraction) = 0;
    // True once the user has interrupted the bake. The bake then returns early and its result is
    // discarded.
    virtual bool cancelled() const = 0;
};

// True if a bake has been interrupted. `progress` may be null: such a bake never is.
inline bool is_cancelled(const Progress* progress) {
    return progress != nullptr && progress->cancelled();
}

// How thoroughly a table's error is measured.
enum class Certification { off, quick, full };

class Intermediates;

struct BakeOptions {
    int threads = 0;  // 0: as many as the machine has
    Certification certification = Certification::quick;
    Progress* progress = nullptr;
    // How many bytes the voxels of volumes that are held in memory may take, those of all running
    // bakes together. Others are made again by each pass over them.
    std::int64_t held_voxel_bytes = std::int64_t{256} << 20;
    // Holds what assets that are baked with the same options share (intermediates.h); null: nothing.
    Intermediates* intermediates = nullptr;

    // True once the bake has been interrupted. It then returns early and its result must not be
    // used.
    bool cancelled() const { return progress != nullptr && progress->cancelled(); }
};

}  // namespace skybake
