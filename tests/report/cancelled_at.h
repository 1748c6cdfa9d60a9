// An interruption in the middle of a report.
#pragma once

#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake::testing {

// Cancels once `step` advances: "timing", or what comes after it.
class CancelledAt : public Progress {
  public:
    explicit CancelledAt(std::string_view step) : step_(step) {}
    void advance(std::string_view step, double) override {
        timing_ = timing_ || step == "timing";
        if (timing_ && step == step_) cancelled_ = true;
    }
    bool cancelled() const override { return cancelled_; }

  private:
    std::string_view step_;
    bool timing_ = false;  // the recipe's own asset, which comes first, is made
    bool cancelled_ = false;
};

}  // namespace skybake::testing
