#include "config/text/moment.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "config/text/text.h"

namespace skybake::config {
namespace {

using std::chrono::days;
using std::chrono::sys_days;

constexpr double seconds_per_day = 86400;

// Takes texts from the front of another.
struct Scanner {
    std::string_view rest;

    bool take(char wanted) {
        if (!rest.starts_with(wanted)) return false;
        rest.remove_prefix(1);
        return true;
    }

    void skip_blanks() {
        while (take(' ')) continue;
    }

    // Takes a number of exactly `digits` digits that is at most `most`.
    std::optional<int> number(std::size_t digits, int most) {
        if (rest.size() < digits) return std::nullopt;
        int value = 0;
        for (const char c : rest.substr(0, digits)) {
            if (c < '0' || c > '9') return std::nullopt;
            value = 10 * value + (c - '0');
        }
        rest.remove_prefix(digits);
        return value <= most ? std::optional(value) : std::nullopt;
    }

    // Takes a date and returns the seconds from 1970-01-01 to its beginning.
    std::optional<double> date() {
        const auto year = number(4, last_moment_year);
        if (!year || *year < first_moment_year || !take('-')) return std::nullopt;
        const auto month = number(2, 12);
        if (!month || !take('-')) return std::nullopt;
        const auto day = number(2, 31);
        if (!day) return std::nullopt;
        const std::chrono::year_month_day date(std::chrono::year(*year),
                                               std::chrono::month(static_cast<unsigned>(*month)),
                                               std::chrono::day(static_cast<unsigned>(*day)));
        if (!date.ok()) return std::nullopt;
        return seconds_per_day * static_cast<double>(sys_days(date).time_since_epoch().count());
    }

    // Takes "18:30", and the seconds of "18:30:15" if they are wanted, and returns seconds.
    std::optional<double> clock(bool with_seconds) {
        const auto hours = number(2, 23);
        if (!hours || !take(':')) return std::nullopt;
        const auto minutes = number(2, 59);
        if (!minutes) return std::nullopt;
        const double seconds = 3600.0 * *hours + 60.0 * *minutes;
        if (!with_seconds || !take(':')) return seconds;
        const auto last = number(2, 59);
        return last ? std::optional(seconds + *last) : std::nullopt;
    }
};

}  // namespace

std::optional<Moment> parse_moment(std::string_view text) {
    Scanner scanner{trim(text)};
    const auto date = scanner.date();
    if (!date || !(scanner.take('T') || scanner.take(' '))) return std::nullopt;
    scanner.skip_blanks();
    const auto time = scanner.clock(true);
    if (!time) return std::nullopt;
    Moment moment{*date + *time, std::nullopt};
    scanner.skip_blanks();
    if (scanner.take('Z')) {
        moment.offset_seconds = 0;
    } else if (!scanner.rest.empty()) {
        const bool ahead = scanner.take('+');
        if (!ahead && !scanner.take('-')) return std::nullopt;
        const auto offset = scanner.clock(false);
        if (!offset) return std::nullopt;
        moment.offset_seconds = ahead ? *offset : -*offset;
    }
    if (!scanner.rest.empty()) return std::nullopt;
    return moment;
}

double utc_seconds(const Moment& moment, double longitude_degrees) {
    const double solar_offset = longitude_degrees / 360 * seconds_per_day;
    return moment.clock_seconds - moment.offset_seconds.value_or(solar_offset);
}

std::string utc_text(double utc_seconds) {
    const auto minutes = static_cast<long>(std::floor(utc_seconds / 60 + 0.5));
    const long day = minutes >= 0 ? minutes / 1440 : -((1439 - minutes) / 1440);
    const std::chrono::year_month_day date{sys_days(days(day))};
    const long of_day = minutes - 1440 * day;
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       of_day / 60, of_day % 60);
}

}  // namespace skybake::config
