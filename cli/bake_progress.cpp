#include "cli/bake_progress.h"

#include <utility>

#include "cli/console.h"
#include "cli/interrupt.h"

namespace skybake::cli {

BakeProgress::BakeProgress(std::string what, Console& console, int index, int count)
    : start_(std::chrono::steady_clock::now()),
      index_(index),
      count_(count),
      what_(std::move(what)),
      line_(console, [this] { return text(); }) {}

double BakeProgress::elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void BakeProgress::advance(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    const double elapsed = elapsed_s();
    if (step != step_ || !clock_.advance(fraction, elapsed)) clock_ = {fraction, elapsed};
    step_ = step;
}

void BakeProgress::begin_stage(int index, int count, std::string_view what) {
    const std::lock_guard lock(mutex_);
    index_ = index;
    count_ = count;
    what_ = what;
    step_.clear();
}

std::string BakeProgress::text() const {
    const std::lock_guard lock(mutex_);
    const double elapsed = elapsed_s();
    const double left = step_.empty() ? -1 : clock_.seconds_left(elapsed);
    return progress_text({index_, count_, what_, step_, clock_.fraction(), elapsed, left});
}

bool BakeProgress::cancelled() const { return interrupted(); }

}  // namespace skybake::cli
