#include "bakers/plot/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace skybake {
namespace {

// Returns steps from about `range` down to a ten-thousandth of it, the coarsest first.
std::vector<double> steps_within(double range, AxisTicks kind) {
    std::vector<double> steps;
    if (kind == AxisTicks::angles) {
        for (const double angle : {90.0, 30.0, 15.0, 5.0}) {
            if (angle <= range) steps.push_back(angle);
        }
        range = std::min(range, 2.0);
    }
    const int decade = static_cast<int>(std::floor(std::log10(range)));
    for (int k = decade; k >= decade - 4; --k) {
        for (const int mantissa : {5, 2, 1}) {
            const double step = mantissa * std::pow(10.0, k);
            if (step <= range) steps.push_back(step);
        }
    }
    return steps;
}

class Ticks {
  public:
    Ticks(const ChartAxis& axis, double gap)
        : axis_(axis), gap_(gap), first_(axis.value(0)), last_(axis.value(1)) {}

    std::vector<AxisTick> decimal() {
        const double range = std::abs(last_ - first_);
        if (!std::isfinite(range) || range == 0) return {};
        const std::vector<double> steps = steps_within(range, axis_.ticks);
        // Takes the finest step that fits everywhere, then finer steps in places with enough room.
        std::optional<std::vector<AxisTick>> uniform;
        for (const double step : steps) {
            std::vector<AxisTick> candidates = multiples(step, first_, last_);
            if (!spaced(candidates)) break;
            uniform = std::move(candidates);
        }
        ticks_ = uniform.value_or(std::vector<AxisTick>());
        refine(steps);
        return std::move(ticks_);
    }

    std::vector<AxisTick> logarithmic() {
        if (!(first_ > 0 && last_ > 0) || !std::isfinite(first_ * last_)) return decimal();
        for (const int stride : {1, 2, 3, 5, 10, 20, 50, 100}) {
            std::vector<AxisTick> candidates = powers({1}, stride);
            if (candidates.size() < 2 && stride == 1) return decimal();
            if (!spaced(candidates)) continue;
            std::vector<AxisTick> finer = powers({1, 2, 5}, stride);
            return stride == 1 && spaced(finer) ? finer : candidates;
        }
        return {};
    }

  private:
    AxisTick tick_at(double value) const {
        return {place_on(axis_, value), value, number_label(value)};
    }

    // Returns the multiples of the step from one value to another, including the ends, ascending in
    // t. An end counts as a multiple if it is one up to rounding.
    std::vector<AxisTick> multiples(double step, double from, double to) const {
        constexpr double rounding = 1e-9;
        const double low = std::min(from, to), high = std::max(from, to);
        std::vector<AxisTick> found;
        for (double i = std::ceil(low / step - rounding); i <= high / step + rounding; ++i) {
            found.push_back(tick_at(i * step));
            if (found.size() > most_ticks) break;
        }
        if (last_ < first_) std::ranges::reverse(found);
        return found;
    }

    std::vector<AxisTick> powers(const std::vector<int>& mantissas, int stride) const {
        constexpr double rounding = 1 + 1e-9;
        const double low = std::min(first_, last_), high = std::max(first_, last_);
        std::vector<AxisTick> found;
        const int begin = static_cast<int>(std::floor(std::log10(low)));
        for (int k = begin; std::pow(10.0, k) <= high * rounding; ++k) {
            if (k % stride != 0) continue;
            for (const int mantissa : mantissas) {
                const double value = mantissa * std::pow(10.0, k);
                if (value * rounding >= low && value <= high * rounding) {
                    found.push_back(tick_at(value));
                }
            }
        }
        if (last_ < first_) std::ranges::reverse(found);
        return found;
    }

    bool spaced(const std::vector<AxisTick>& ticks) const {
        if (ticks.size() > most_ticks) return false;
        return std::ranges::adjacent_find(ticks, [this](const AxisTick& a, const AxisTick& b) {
                   return b.t - a.t < gap_;
               }) == ticks.end();
    }

    // Puts ticks of the coarsest step that fits into gaps wide enough for three.
    void refine(const std::vector<double>& steps) {
        for (const double step : steps) {
            std::vector<AxisTick> with;
            double begin = 0, begin_value = first_;
            const auto fill_to = [&](double end, double end_value, bool end_is_tick) {
                if (end - begin < 3 * gap_) return;
                for (AxisTick& tick : multiples(step, begin_value, end_value)) {
                    const double before = with.empty() ? -gap_ : with.back().t;
                    const double after = end_is_tick ? end : end + gap_;
                    if (tick.t - before >= gap_ && after - tick.t >= gap_) {
                        with.push_back(std::move(tick));
                    }
                }
            };
            for (AxisTick& tick : ticks_) {
                fill_to(tick.t, tick.value, true);
                begin = tick.t;
                begin_value = tick.value;
                with.push_back(std::move(tick));
            }
            fill_to(1, last_, false);
            ticks_ = std::move(with);
        }
    }

    // More ticks cannot be distinguished, whatever the gap.
    static constexpr std::size_t most_ticks = 1000;

    const ChartAxis& axis_;
    double gap_;
    double first_;
    double last_;
    std::vector<AxisTick> ticks_;
};

std::string superscript(int number) {
    static constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                           "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char digit : fmt::format("{}", std::abs(number))) {
        text += digits[static_cast<std::size_t>(digit - '0')];
    }
    return text;
}

// --- Ranges -------------------------------------------------------------------------------------

// This is far beyond anything measured, and small enough that differences and quotients are finite.
constexpr double largest_shown = 1e150;

// Returns 1, 2 and 5 times the powers of ten around [low, high], ascending.
std::vector<double> round_numbers_about(double low, double high) {
    std::vector<double> numbers;
    const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
    const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
    for (int decade = first; decade <= last; ++decade) {
        for (const int mantissa : {1, 2, 5}) {
            numbers.push_back(mantissa * std::pow(10.0, decade));
        }
    }
    return numbers;
}

}  // namespace

ChartAxis linear_axis(std::string title, double low, double high) {
    return {std::move(title), [=](double t) { return low + t * (high - low); }};
}

ChartAxis logarithmic_axis(std::string title, double low, double high) {
    return {std::move(title), [=](double t) { return low * std::pow(high / low, t); },
            AxisTicks::logarithmic};
}

ChartAxis axis_over(std::string title, const std::vector<double>& values, bool logarithmic,
                    double room) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : values) {
        if (!(std::abs(value) <= largest_shown)) continue;
        if (logarithmic && value < 1 / largest_shown) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) low = high = 1;
    // Values below a trillionth of the largest are only rounding errors.
    if (logarithmic) low = std::max(low, high * 1e-12);
    if (low == high) {
        const double half = low == 0 ? 1 : std::abs(low) / 2;
        low -= half;
        high += half;
    }
    if (logarithmic) {
        const double factor = std::pow(high / low, room);
        return logarithmic_axis(std::move(title), low / factor, high * factor);
    }
    const double range = high - low;
    return linear_axis(std::move(title), low == 0 ? 0 : low - room * range,
                       high == 0 ? 0 : high + room * range);
}

ChartAxis rounded_axis(std::string title, const std::vector<double>& values, double smallest) {
    constexpr double largest = 1e100;  // so that no end of an axis overflows
    constexpr double beyond = 1.25;    // an axis goes beyond its values by at least this factor
    double least = largest, most = 0;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, std::clamp(value, smallest, largest));
        most = std::max(most, std::clamp(value, smallest, largest));
    }
    if (most == 0) least = most = smallest;
    double low = least, high = most;
    for (const double number : round_numbers_about(least, most)) {
        if (number <= least / beyond) low = std::max(number, smallest);
    }
    for (const double number : round_numbers_about(least, most)) {
        high = number;
        if (number >= most * beyond) break;
    }
    ChartAxis axis = logarithmic_axis(std::move(title), low, high);
    axis.begins_at_zero = low <= smallest;
    return axis;
}

bool can_show(const ChartAxis& axis, double value) {
    return std::abs(value) <= largest_shown &&
           (axis.ticks != AxisTicks::logarithmic || value >= 1 / largest_shown);
}

// Finds the place by bisection, because the axis is monotonic.
double place_on(const ChartAxis& axis, double value) {
    if (std::isnan(value)) return 1;
    const bool rising = axis.value(1) > axis.value(0);
    double low = 0, high = 1;
    for (int i = 0; i < 53; ++i) {
        const double middle = (low + high) / 2;
        ((axis.value(middle) < value) == rising ? low : high) = middle;
    }
    return (low + high) / 2;
}

std::vector<AxisTick> axis_ticks(const ChartAxis& axis, double gap) {
    Ticks ticks(axis, gap);
    if (axis.ticks != AxisTicks::logarithmic) return ticks.decimal();
    std::vector<AxisTick> found = ticks.logarithmic();
    if (axis.begins_at_zero) {
        std::erase_if(found, [gap](const AxisTick& tick) { return tick.t < gap; });
        found.insert(found.begin(), {0, 0, "0"});
    }
    return found;
}

std::vector<double> minor_ticks(const ChartAxis& axis, double gap) {
    const double first = axis.value(0), last = axis.value(1);
    if (axis.ticks != AxisTicks::logarithmic || !(first > 0 && last > first)) return {};
    if (std::log10(10.0 / 9) / std::log10(last / first) < gap) return {};
    std::vector<double> places;
    for (int k = static_cast<int>(std::floor(std::log10(first))); std::pow(10.0, k) < last; ++k) {
        for (int mantissa = 2; mantissa < 10; ++mantissa) {
            const double value = mantissa * std::pow(10.0, k);
            if (value > first && value < last) places.push_back(place_on(axis, value));
        }
    }
    return places;
}

std::string number_label(double value) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    const std::string sign = value < 0 ? "−" : "";
    const double magnitude = std::abs(value);
    if (magnitude == 0 || (magnitude >= 1e-3 && magnitude < 1e5)) {
        return sign + fmt::format("{:.6g}", magnitude);
    }
    const std::string text = fmt::format("{:.3e}", magnitude);  // "2.500e-05"
    const std::size_t e = text.find('e');
    const std::string mantissa = text.substr(0, text.find_last_not_of("0.", e - 1) + 1);
    const std::string power = "10" + superscript(std::stoi(text.substr(e + 1)));
    return sign + (mantissa == "1" ? power : mantissa + "×" + power);
}

}  // namespace skybake
