#include "cli/bake_progress.h"

#include <fmt/format.h>

#include <utility>

#include "cli/console.h"
#include "cli/interrupt.h"

namespace skybake::cli {

using std::chrono::duration;
using std::chrono::steady_clock;

BakeProgress::BakeProgress(std::string asset, Console& console)
    : asset_(std::move(asset)),
      console_(console),
      start_(steady_clock::now()),
      shown_(steady_clock::now()) {}

void BakeProgress::advance(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    const auto now = steady_clock::now();
    const double since_shown = duration<double>(now - shown_).count();
    const bool terminal = console_.error_is_terminal();
    if (since_shown < (terminal ? 0.1 : 10.0)) return;
    shown_ = now;
    const std::string text = fmt::format("{}: {} {:.0f} %, {:.0f} s", asset_, step, 100 * fraction,
                                         duration<double>(now - start_).count());
    line_shown_ = terminal;
    console_.note(terminal ? fmt::format("\r\033[K  {}", text) : text + "\n");
}

bool BakeProgress::cancelled() const { return interrupted(); }

BakeProgress::~BakeProgress() {
    if (line_shown_) console_.note("\r\033[K");
}

}  // namespace skybake::cli
