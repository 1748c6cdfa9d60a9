// How a preview tells what it is at: one stage after another, an asset's bake or its pictures.
#pragma once

#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake {

class StageProgress : public Progress {
  public:
    // Stage `index` of `count`, from 1 on, begins; what is told by advance() is of it.
    virtual void begin_stage(int index, int count, std::string_view what) = 0;
};

// A stage's part from `first` on, `share` of it, as though it were all that there is; under one
// name. `whole` may be null.
class ProgressPart : public Progress {
  public:
    ProgressPart(Progress* whole, std::string_view step, double first, double share)
        : whole_(whole), step_(step), first_(first), share_(share) {}

    void advance(std::string_view, double fraction) override {
        if (whole_ != nullptr) whole_->advance(step_, first_ + share_ * fraction);
    }
    bool cancelled() const override { return whole_ != nullptr && whole_->cancelled(); }

  private:
    Progress* whole_;
    std::string_view step_;
    double first_;
    double share_;
};

}  // namespace skybake
