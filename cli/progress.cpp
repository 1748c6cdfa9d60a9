#include "cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "cli/console.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

using std::chrono::milliseconds;

std::string progress_bar(double fraction) {
    constexpr int width = 10;
    const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < filled ? "█" : "░";
    return bar;
}

// Returns the longest beginning of a text that takes at most this many columns.
std::string cut(std::string text, int columns) {
    while (text_width(text) > columns) {
        while ((text.back() & 0xC0) == 0x80) text.pop_back();
        text.pop_back();
    }
    return text;
}

// Spells a duration: "8 s", "3 min 05 s", "2 h 10 min".
std::string clock_text(double seconds) {
    const long whole = std::lround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string line_text(const ProgressState& state, bool with_bar) {
    std::string text;
    if (state.count > 0) text += fmt::format("[{}/{}] ", state.index, state.count);
    text += state.what;
    if (!state.step.empty()) {
        text += fmt::format(": {}  ", state.step);
        if (with_bar) text += progress_bar(state.fraction) + "  ";
        text += fmt::format("{:.0f} %", std::floor(100 * state.fraction));
    }
    text += fmt::format("  {}", clock_text(state.elapsed_s));
    if (state.left_s >= 0.5) text += fmt::format(", about {} left", clock_text(state.left_s));
    return text;
}

}  // namespace

ProgressLine::ProgressLine(Console& console, std::function<std::string()> text,
                           std::optional<milliseconds> every)
    : console_(console),
      text_(std::move(text)),
      every_(every.value_or(console.error_is_terminal() ? milliseconds{200} : milliseconds{5000})) {
    if (!console.shows_notes() || console.json()) return;
    try {
        teller_ = std::thread([this] { tell(); });
    } catch (const std::system_error&) {  // the system grants no thread: the work goes on untold
    }
}

ProgressLine::~ProgressLine() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    wake_.notify_all();
    if (teller_.joinable()) teller_.join();
    if (shown_ && console_.error_is_terminal()) console_.rewrite_line("");
}

void ProgressLine::tell() {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, every_, [this] { return ended_; })) {
        const std::string text = text_();
        if (text.empty()) continue;
        if (console_.error_is_terminal()) {
            console_.rewrite_line("  " + text);
        } else {
            console_.note(text + "\n");
        }
        shown_ = true;
    }
}

std::string progress_text(const ProgressState& state, int columns) {
    std::string text = line_text(state, true);
    if (columns == 0 || text_width(text) <= columns) return text;
    return cut(line_text(state, false), columns);
}

bool StepClock::advance(double fraction, double seconds) {
    constexpr double out_of_order = 0.25;
    if (fraction < fraction_ - out_of_order) return false;
    fraction_ = std::max(fraction_, fraction);
    told_s_ = seconds;
    return true;
}

// Estimates the time left once a tenth of a step is done, or a fiftieth after two seconds. Before
// that too little is known. So it is once the step is done, or once an estimate has run out, because
// what is at work then has told nothing.
double StepClock::seconds_left(double seconds) const {
    const double done = fraction_ - first_fraction_;
    const double took_s = told_s_ - began_s_;
    if (done < 0.1 && (done < 0.02 || took_s < 2)) return -1;
    const double left_s = took_s * (1 - fraction_) / done - (seconds - told_s_);
    return left_s > 0 ? left_s : -1;
}

void ProgressTeller::begin_stage(int index, int count, std::string_view what) {
    index_ = index;
    count_ = count;
    what_ = what;
    step_.clear();
}

void ProgressTeller::advance(std::string_view step, double fraction, double seconds) {
    if (step != step_ || !clock_.advance(fraction, seconds)) clock_ = {fraction, seconds};
    step_ = step;
}

std::string ProgressTeller::text(double seconds, int columns) const {
    const double left = step_.empty() ? -1 : clock_.seconds_left(seconds);
    return progress_text({index_, count_, what_, step_, clock_.fraction(), seconds, left}, columns);
}

// A terminal's last column stays free, and two blanks stand before the line.
BakeProgress::BakeProgress(std::string what, Console& console, int index, int count)
    : teller_(std::move(what), index, count),
      line_(console, [this, columns = std::max(console.error_columns() - 3, 0)] {
          const std::lock_guard lock(mutex_);
          return teller_.text(stopwatch_.seconds(), columns);
      }) {}

void BakeProgress::advance(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    teller_.advance(step, fraction, stopwatch_.seconds());
}

void BakeProgress::begin_stage(int index, int count, std::string_view what) {
    const std::lock_guard lock(mutex_);
    teller_.begin_stage(index, count, what);
}

bool BakeProgress::cancelled() const { return interrupted(); }

}  // namespace skybake::cli
