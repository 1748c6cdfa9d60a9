// How, not what, to bake, and how a bake tells how far it is: none of it changes a texel.
#pragma once

#include <string_view>

namespace skybake {

// How a long bake tells how far it is, and learns that it should stop.

class Progress {
  public:
    virtual ~Progress() = default;
    // fraction of the named step that is done, in [0, 1]. May be called from any thread.
    virtual void advance(std::string_view step, double fraction) = 0;
    // True once the user has interrupted: the bake returns early and its result is thrown away.
    virtual bool cancelled() const = 0;
};

// Whether a bake that may report to nobody (null) has been interrupted.
inline bool is_cancelled(const Progress* progress) {
    return progress != nullptr && progress->cancelled();
}

// How thoroughly a table's error is measured.
enum class Certification { off, quick, full };

struct BakeOptions {
    int threads = 0;  // 0: as many as the machine has
    Certification certification = Certification::quick;
    Progress* progress = nullptr;

    // Once true a bake returns early, with a result that is not to be used.
    bool cancelled() const { return progress != nullptr && progress->cancelled(); }
};

}  // namespace skybake
