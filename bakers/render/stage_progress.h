// Progress of a preview, which runs in stages: each stage is an asset's bake or its pictures.
#pragma once

#include <string>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake {

class StageProgress : public Progress {
  public:
    // Says that stage `index` of `count` begins, counted from 1. Later calls of advance() refer to
    // it.
    virtual void begin_stage(int index, int count, std::string_view what) = 0;
};

// Reports a part of a stage as if it were the whole: the part begins at the fraction `first`, is
// the fraction `share` of the stage and has one name. `whole` may be null.
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
    std::string step_;
    double first_;
    double share_;
};

}  // namespace skybake
