#include "bakers/math/bake_clock.h"

#include <utility>

namespace skybake {
namespace {

thread_local BakeClock* running = nullptr;

}  // namespace

BakeClock::BakeClock() : outer_(std::exchange(running, this)) {}

BakeClock::~BakeClock() { running = outer_; }

void BakeClock::go_on_with(BakePart part) {
    const Time::time_point now = Time::now();
    booked_on(part_) += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    part_ = part;
}

BakeSeconds BakeClock::seconds() {
    go_on_with(part_);
    return {booked_on(BakePart::light), booked_on(BakePart::colors), booked_on(BakePart::texels),
            booked_on(BakePart::certificate)};
}

BakeTime::BakeTime(BakePart part) : clock_(running) {
    if (clock_ == nullptr) return;
    before_ = clock_->part_;
    clock_->go_on_with(before_ == BakePart::certificate ? before_ : part);
}

BakeTime::~BakeTime() {
    if (clock_ != nullptr) clock_->go_on_with(before_);
}

}  // namespace skybake
