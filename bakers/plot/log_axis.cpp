#include "bakers/plot/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skybake {

namespace {

constexpr double kLargest = 1e100;     // so that no end of an axis overflows
constexpr double kRoom = 1.25;         // an axis goes at least so far beyond its values
constexpr double kShortDecades = 2.1;  // up to here 2 and 5 are labelled
constexpr std::array<int, 3> kSteps = {1, 2, 5};

struct Step {
    int decade;
    int mantissa;
    double value() const { return mantissa * std::pow(10.0, decade); }
};

// All steps of the decades about [low, high].
std::vector<Step> steps_about(double low, double high) {
    std::vector<Step> steps;
    const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
    const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
    for (int decade = first; decade <= last; ++decade) {
        for (const int mantissa : kSteps) steps.push_back({decade, mantissa});
    }
    return steps;
}

std::string label_of(const Step& step) {
    if (step.decade >= -2 && step.decade <= 3) return fmt::format("{:g}", step.value());
    return fmt::format("{}e{}", step.mantissa, step.decade);
}

}  // namespace

LogAxis::LogAxis(const std::vector<double>& values, double smallest) : smallest_(smallest) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, std::clamp(value, smallest, kLargest));
        most = std::max(most, std::clamp(value, smallest, kLargest));
    }
    if (most == 0) least = most = smallest;
    low_ = least;
    high_ = most;
    for (const Step& step : steps_about(least, most)) {
        if (step.value() <= least / kRoom) low_ = std::max(step.value(), smallest);
    }
    for (const Step& step : steps_about(least, most)) {
        if (step.value() < most * kRoom) continue;
        high_ = step.value();
        break;
    }
}

double LogAxis::position(double value) const {
    const double shown = std::isfinite(value) ? std::clamp(value, smallest_, kLargest) : high_;
    return std::log(shown / low_) / std::log(high_ / low_);
}

std::vector<LogTick> LogAxis::ticks() const {
    const bool is_short = std::log10(high_ / low_) <= kShortDecades;
    // What is not positive stands at an end of its own, called 0.
    const double first = low_ > smallest_ ? low_ * (1 - 1e-9) : low_ * (1 + 1e-9);
    std::vector<LogTick> ticks;
    for (const Step& step : steps_about(low_, high_)) {
        const double value = step.value();
        if (value < first || value > high_ * (1 + 1e-9)) continue;
        ticks.push_back({value, step.mantissa == 1 || is_short ? label_of(step) : ""});
    }
    if (low_ <= smallest_) ticks.insert(ticks.begin(), {smallest_, "0"});
    return ticks;
}

}  // namespace skybake
