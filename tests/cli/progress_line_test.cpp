#include "cli/progress.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "cli/console.h"
#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

using std::chrono::milliseconds;

// Keeps what a console has written to stderr, for any thread.
class Screen {
  public:
    Sink sink(bool terminal) {
        return {[this](std::string_view text) {
                    const std::lock_guard lock(mutex_);
                    text_ += text;
                    return true;
                },
                terminal};
    }
    std::string text() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

  private:
    mutable std::mutex mutex_;
    std::string text_;
};

Sink nowhere() {
    return {[](std::string_view) { return true; }, false};
}

void wait_until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!holds() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    ASSERT_TRUE(holds());
}

// Returns what stands on a screen after a line was asked for at least so often: "line 1", "line 2".
std::string lines_told(bool terminal, int least, int& times) {
    Screen screen;
    Console console(nowhere(), screen.sink(terminal), {});
    std::atomic<int> asked = 0;
    {
        const ProgressLine line(
            console, [&] { return "line " + std::to_string(++asked); }, milliseconds(1));
        wait_until([&] { return asked >= least; });
    }
    times = asked;
    return screen.text();
}

// The clock ticks although the work says nothing.
TEST(ProgressLine, IsToldAgainWithoutNews) {
    int asked = 0;
    const std::string text = lines_told(false, 4, asked);
    EXPECT_TRUE(text.starts_with("line 1\nline 2\nline 3\n")) << text;
    EXPECT_EQ(count_lines(text), asked);
}

TEST(ProgressLine, IsRewrittenOnATerminalAndTakenAway) {
    int asked = 0;
    const std::string text = lines_told(true, 3, asked);
    EXPECT_TRUE(text.starts_with("\r\033[K  line 1\r\033[K  line 2")) << text;
    EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
    EXPECT_EQ(count_lines(text), 0);
}

TEST(ProgressLine, IsSilentWhereThereAreNoNotes) {
    for (const Display& display :
         {Display{.quiet = true}, Display{.diagnostics = DiagnosticFormat::json},
          Display{.json = true}}) {
        Screen screen;
        Console console(nowhere(), screen.sink(true), display);
        bool asked = false;
        {
            const ProgressLine line(
                console,
                [&] {
                    asked = true;
                    return std::string("x");
                },
                milliseconds(1));
            std::this_thread::sleep_for(milliseconds(20));
        }
        EXPECT_EQ(screen.text(), "");
        EXPECT_FALSE(asked);
    }
}

TEST(ProgressText, HasCountBarClockAndTimeLeft) {
    EXPECT_EQ(progress_text({3, 12, "cumulus, pictures", "lighting, sun 20 deg", 0.439, 31, 20.2}),
              "[3/12] cumulus, pictures: lighting, sun 20 deg  ████░░░░░░  43 %  31 s, about 20 s "
              "left");
    EXPECT_EQ(progress_text({0, 0, "manifest", "", 0, 0.2, -1}), "manifest  0 s");
    EXPECT_EQ(progress_text({1, 1, "shape", "voxels", 1, 185, 0}),
              "[1/1] shape: voxels  ██████████  100 %  3 min 05 s");
    EXPECT_EQ(progress_text({1, 2, "shape", "voxels", 0.1, 7800, -1}),
              "[1/2] shape: voxels  █░░░░░░░░░  10 %  2 h 10 min");
}

// The name of a part outlives the text that it was made of.
TEST(ProgressPart, KeepsItsName) {
    class Last : public Progress {
      public:
        void advance(std::string_view step, double fraction) override {
            text = std::string(step) + " " + std::to_string(fraction);
        }
        bool cancelled() const override { return false; }
        std::string text;
    };
    Last last;
    std::string name = "lighting of all clouds, sun 20 deg";
    ProgressPart part(&last, name, 0.5, 0.25);
    name.assign(name.size(), '?');
    part.advance("marching", 0.5);
    EXPECT_EQ(last.text, "lighting of all clouds, sun 20 deg 0.625000");
}

// A line that wraps could not be rewritten.
TEST(ProgressText, FitsTheTerminal) {
    const ProgressState state{3, 12, "wölkchen", "lighting", 0.439, 31, 20.2};
    EXPECT_EQ(progress_text(state, 66),
              "[3/12] wölkchen: lighting  ████░░░░░░  43 %  31 s, about 20 s left");
    EXPECT_EQ(progress_text(state, 65), "[3/12] wölkchen: lighting  43 %  31 s, about 20 s left");
    EXPECT_EQ(progress_text(state, 9), "[3/12] wö");
    EXPECT_EQ(progress_text(state, 8), "[3/12] w");
}

// The time left comes from the work that was done since a step began, and runs on between two
// pieces of news.
TEST(ProgressTeller, TellsByTheClockOfItsCaller) {
    ProgressTeller teller("preview", 0, 0);
    EXPECT_EQ(teller.text(0.2, 0), "preview  0 s");
    teller.begin_stage(2, 3, "cumulus");
    teller.advance("voxels", 0, 10);
    EXPECT_EQ(teller.text(11, 0), "[2/3] cumulus: voxels  ░░░░░░░░░░  0 %  11 s");
    teller.advance("voxels", 0.5, 30);
    EXPECT_EQ(teller.text(30, 0), "[2/3] cumulus: voxels  █████░░░░░  50 %  30 s, about 20 s left");
    EXPECT_EQ(teller.text(38, 0), "[2/3] cumulus: voxels  █████░░░░░  50 %  38 s, about 12 s left");
    // A step that runs slower than at first is told so at the next news.
    teller.advance("voxels", 0.6, 70);
    EXPECT_EQ(teller.text(70, 0),
              "[2/3] cumulus: voxels  ██████░░░░  60 %  1 min 10 s, about 40 s left");
    // Another step says nothing of the time before it.
    teller.advance("certify", 0.01, 71);
    EXPECT_EQ(teller.text(71, 0), "[2/3] cumulus: certify  ░░░░░░░░░░  1 %  1 min 11 s");
    teller.begin_stage(3, 3, "shape");
    EXPECT_EQ(teller.text(72, 0), "[3/3] shape  1 min 12 s");
}

TEST(StepClock, SaysHowLongAStepMayStillTake) {
    StepClock clock(0, 100);
    EXPECT_LT(clock.seconds_left(100), 0);
    ASSERT_TRUE(clock.advance(0.01, 101));
    EXPECT_LT(clock.seconds_left(101), 0);  // too little is known
    ASSERT_TRUE(clock.advance(0.25, 110));
    EXPECT_DOUBLE_EQ(clock.seconds_left(110), 30);
    EXPECT_DOUBLE_EQ(clock.seconds_left(114), 26);  // it runs on between two pieces of news
    // A step that takes longer than that is not about to end, as far as anybody knows.
    EXPECT_LT(clock.seconds_left(140), 0);
    EXPECT_LT(clock.seconds_left(999), 0);
    ASSERT_TRUE(clock.advance(1, 1000));
    EXPECT_LT(clock.seconds_left(1000), 0) << "the step is done; the next has not begun";
    ASSERT_TRUE(clock.advance(0.9, 1001));  // a thread that tells late
    EXPECT_DOUBLE_EQ(clock.fraction(), 1);
    EXPECT_FALSE(StepClock(0.9, 0).advance(0, 1));  // begun anew
}

TEST(StepClock, CountsFromWhereItBegan) {
    StepClock clock(0.5, 10);  // the second of two suns
    ASSERT_TRUE(clock.advance(0.75, 20));
    EXPECT_DOUBLE_EQ(clock.seconds_left(20), 10);
}

}  // namespace
}  // namespace skybake::cli
