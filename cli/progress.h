// This header shows how far a bake, a preview or a report is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "bakers/io/files/stopwatch.h"
#include "bakers/render/stage_progress.h"

namespace skybake::cli {

class Console;

// This is the line that says how far a long run is. On a terminal it is rewritten in place;
// elsewhere a new line is written every five seconds. It is rewritten even if the work has not
// advanced, so that its clock never stands still.
class ProgressLine {
  public:
    // `text` is called from another thread until the line ends. Nothing is shown if the console
    // shows no notes, or if results are events (--json), which say what is done. `every` is another
    // time between two lines.
    ProgressLine(Console& console, std::function<std::string()> text,
                 std::optional<std::chrono::milliseconds> every = std::nullopt);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    // Removes the line from a terminal.
    ~ProgressLine();

  private:
    void tell();

    Console& console_;
    std::function<std::string()> text_;
    std::chrono::milliseconds every_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool ended_ = false;
    bool shown_ = false;
    std::thread teller_;
};

// This says how far a piece of work is.
struct ProgressState {
    int index = 0;  // from 1 to `count`; 0 if pieces are not counted
    int count = 0;
    std::string_view what;  // "shape", "cumulus_humilis, pictures"
    std::string_view step;  // "voxels", "lighting, sun 20 deg"; empty before the first
    double fraction = 0;    // of the step
    double elapsed_s = 0;   // of the whole run
    double left_s = -1;     // for the step; not told below half a second; negative if not known
};

// Returns the text of the line:
// "[3/12] cumulus_humilis, pictures: lighting, sun 20 deg  ████░░░░░░  43 %  31 s, about 20 s left"
// It takes at most `columns` columns, or any number if that is 0. The bar is left out first, and
// then the end is cut off.
std::string progress_text(const ProgressState& state, int columns = 0);

// Says how far a step is, and estimates from its speed since it began how long it may still take.
// Times are seconds since the start of the whole run.
class StepClock {
  public:
    StepClock(double fraction, double began_s)
        : first_fraction_(fraction), began_s_(began_s), fraction_(fraction), told_s_(began_s) {}

    // Returns false if the step has begun anew. Threads may report their shares out of order, so a
    // fraction a little below the last one is ignored.
    bool advance(double fraction, double seconds);
    double fraction() const { return fraction_; }
    // Returns a negative number if too little is known, or if the step should be done by now.
    double seconds_left(double seconds) const;

  private:
    double first_fraction_;
    double began_s_;
    double fraction_;
    double told_s_;
};

// Says how far the steps of some work are. Times are seconds since the start of the whole run, so
// that the caller's clock is the only one.
class ProgressTeller {
  public:
    // `what` is the piece of work, number `index` of `count`. Both are 0 if pieces are not counted.
    ProgressTeller(std::string what, int index, int count)
        : index_(index), count_(count), what_(std::move(what)) {}

    void begin_stage(int index, int count, std::string_view what);
    void advance(std::string_view step, double fraction, double seconds);
    std::string text(double seconds, int columns) const;

  private:
    int index_;
    int count_;
    std::string what_;
    std::string step_;
    StepClock clock_{0, 0};
};

// Shows the steps of a bake, a preview or a report on a progress line.
class BakeProgress : public StageProgress {
  public:
    BakeProgress(std::string what, Console& console, int index = 0, int count = 0);

    void advance(std::string_view step, double fraction) override;
    void begin_stage(int index, int count, std::string_view what) override;
    bool cancelled() const override;

  private:
    mutable std::mutex mutex_;
    const Stopwatch stopwatch_;
    ProgressTeller teller_;
    ProgressLine line_;  // the last member: it ends before the members that it reads
};

}  // namespace skybake::cli
