// How a long bake tells how far it is, and learns that it should stop.
#pragma once

#include <string_view>

namespace skybake {

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

}  // namespace skybake
