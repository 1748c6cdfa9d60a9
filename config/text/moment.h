// This header reads a time of day on a date, for the sun's position.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skybake::config {

inline constexpr int first_moment_year = 1900;
inline constexpr int last_moment_year = 2100;

// A clock's date and time in the Gregorian calendar. Without an offset the clock shows the mean
// solar time of the place that it stands at, which is 4 minutes later for each degree to the east.
struct Moment {
    double clock_seconds = 0;              // since 1970-01-01 00:00, as the clock shows them
    std::optional<double> offset_seconds;  // by which the clock is ahead of UTC
    bool operator==(const Moment&) const = default;
};

// These words say what parse_moment reads.
inline constexpr std::string_view moment_words =
    "a date and time from 1900 to 2100, such as \"2026-06-21 18:30 +02:00\", with Z for UTC, or "
    "without a zone for mean solar time";

// Reads "2026-06-21 18:30", with `T` or blanks between date and time, optional seconds, and an
// optional zone: `Z` or an offset such as `+02:00`. Returns none for any other text, for a date that
// does not exist, and for other years.
std::optional<Moment> parse_moment(std::string_view text);

// Returns the seconds of UTC since 1970-01-01 00:00, at a place of this longitude, which is positive
// east of Greenwich.
double utc_seconds(const Moment& moment, double longitude_degrees);

// Spells a time in UTC to the minute: "2026-06-21 16:30 UTC".
std::string utc_text(double utc_seconds);

}  // namespace skybake::config
