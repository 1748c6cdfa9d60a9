// How a bake, a preview or a report shows how far it is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "bakers/render/stage_progress.h"

namespace skybake::cli {

class Console;

// The line that says how far a long run is: rewritten in place on a terminal, a line of its own
// every ten seconds elsewhere. It is told anew whether or not the work has got on, so that its
// clock never stands still.
class ProgressLine {
  public:
    // `text` is asked from another thread, until the line ends. Nothing is shown where the console
    // shows no notes.
    ProgressLine(Console& console, std::function<std::string()> text);
    // With another time between two lines.
    ProgressLine(Console& console, std::function<std::string()> text,
                 std::chrono::milliseconds every);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    // Takes the line away from a terminal.
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

// Where a piece of work stands.
struct ProgressState {
    int index = 0;  // of `count` pieces, from 1 on; 0: pieces are not counted
    int count = 0;
    std::string_view what;  // "shape", "cumulus_humilis, pictures"
    std::string_view step;  // "voxels", "lighting, sun 20 deg"; empty before the first
    double fraction = 0;    // of the step
    double elapsed_s = 0;   // of the whole run
    double left_s = -1;     // of the step; negative where it is not known yet
};

// "[3/12] cumulus_humilis, pictures: lighting, sun 20 deg  ####......  43 %  31 s, about 20 s left"
std::string progress_text(const ProgressState& state);

// How far a step is, and how long it may still take by how fast it has gone since it began. Times
// are of the whole run.
class StepClock {
  public:
    StepClock(double fraction, double began_s)
        : first_fraction_(fraction), began_s_(began_s), fraction_(fraction), told_s_(began_s) {}

    // False where the step has begun anew. Threads may tell of their shares out of order: a little
    // less than before is no news.
    bool advance(double fraction, double seconds);
    double fraction() const { return fraction_; }
    // Negative where too little is known.
    double seconds_left(double seconds) const;

  private:
    double first_fraction_;
    double began_s_;
    double fraction_;
    double told_s_;
};

// The steps of a bake, a preview or a report on such a line.
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
