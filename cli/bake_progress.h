// How a bake shows how far it is: one line that is rewritten on a terminal, a line every ten
// seconds elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "bakers/core/progress.h"

namespace skybake::cli {

class Console;

class BakeProgress : public Progress {
  public:
    BakeProgress(std::string asset, Console& console);
    // Takes the line away again.
    ~BakeProgress() override;

    void advance(std::string_view step, double fraction) override;
    bool cancelled() const override;

  private:
    std::string asset_;
    Console& console_;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    bool line_shown_ = false;
};

}  // namespace skybake::cli
