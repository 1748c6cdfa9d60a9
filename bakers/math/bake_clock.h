// Where the time of a bake goes: to light, to colours, to texels or to their certificate.
//
// A clock books the wall time of the thread that made it, so that the parts add up to the whole.
// Times are no input of a bake: the clock that runs is the thread's own, and no function is given it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace skybake {

enum class BakePart {
    texels,       // all that is none of the others
    light,        // to solve for light, and to tabulate sunlight
    colors,       // to fit the weights of wavelengths
    certificate,  // to measure errors, and all that is made for this alone
};

struct BakeSeconds {
    double light = 0;
    double colors = 0;
    double texels = 0;
    double certificate = 0;

    // Returns the seconds for the asset itself, without what measures it.
    double made() const { return light + colors + texels; }
};

// Books on texels what no BakeTime books on something else.
class BakeClock {
  public:
    BakeClock();
    ~BakeClock();
    BakeClock(const BakeClock&) = delete;
    BakeClock& operator=(const BakeClock&) = delete;

    // Returns what was booked since the clock was made.
    BakeSeconds seconds();

  private:
    friend class BakeTime;
    using Time = std::chrono::steady_clock;
    double& booked_on(BakePart part) { return booked_[static_cast<std::size_t>(part)]; }
    // Books the time up to now, and goes on with `part`.
    void go_on_with(BakePart part);

    BakeClock* const outer_;  // of the same thread
    Time::time_point since_ = Time::now();
    BakePart part_ = BakePart::texels;
    std::array<double, 4> booked_{};
};

// While it exists, the time of its thread is booked on a part, if a clock runs. Whatever is made for
// a certificate is booked on it.
class BakeTime {
  public:
    explicit BakeTime(BakePart part);
    ~BakeTime();
    BakeTime(const BakeTime&) = delete;
    BakeTime& operator=(const BakeTime&) = delete;

  private:
    BakeClock* const clock_;
    BakePart before_ = BakePart::texels;
};

}  // namespace skybake
