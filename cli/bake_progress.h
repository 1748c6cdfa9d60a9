// How a bake, a preview or a report shows how far it is.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "bakers/render/stage_progress.h"
#include "cli/progress_line.h"

namespace skybake::cli {

class Console;

class BakeProgress : public StageProgress {
  public:
    // `what` is made: the piece `index` of `count`; 0 of 0 where pieces are not counted.
    BakeProgress(std::string what, Console& console, int index = 0, int count = 0);

    void advance(std::string_view step, double fraction) override;
    void begin_stage(int index, int count, std::string_view what) override;
    bool cancelled() const override;

  private:
    double elapsed_s() const;
    std::string text() const;

    mutable std::mutex mutex_;
    std::chrono::steady_clock::time_point start_;
    int index_;
    int count_;
    std::string what_;
    std::string step_;
    StepClock clock_{0, 0};
    ProgressLine line_;  // the last, so that it ends before what it asks
};

}  // namespace skybake::cli
