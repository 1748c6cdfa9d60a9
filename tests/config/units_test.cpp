#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "config/text/moment.h"
#include "config/text/units.h"

namespace skybake::config {

namespace {

using ErrorKind = QuantityError::Kind;

Quantity quantity_of(std::string_view text) {
    const auto parsed = parse_quantity(text);
    const auto* quantity = std::get_if<Quantity>(&parsed);
    EXPECT_TRUE(quantity) << text;
    return quantity ? *quantity : Quantity{};
}

double value_of(std::string_view text) { return quantity_of(text).value; }
Dimension dimension_of(std::string_view text) { return quantity_of(text).dimension; }

ErrorKind error_of(std::string_view text) {
    const auto parsed = parse_quantity(text);
    const auto* error = std::get_if<QuantityError>(&parsed);
    EXPECT_TRUE(error) << text;
    return error ? error->kind : ErrorKind::not_a_number;
}

bool is_error(std::string_view text) {
    return std::holds_alternative<QuantityError>(parse_quantity(text));
}

TEST(Units, ReadsLengthsExactly) {
    EXPECT_EQ(value_of("8 km"), 8000.0);
    EXPECT_EQ(value_of("6360km"), 6360000.0);
    EXPECT_EQ(value_of("1.2 km"), 1200.0);
    EXPECT_EQ(value_of("0.001 km"), 1.0);
    EXPECT_EQ(value_of("680 nm"), 6.8e-7);
    EXPECT_EQ(value_of("550 nm"), 5.5e-7);
    EXPECT_EQ(value_of("58 /Mm"), 5.8e-5);
    EXPECT_EQ(value_of("0.3 atm-cm"), value_of("300 DU"));
    EXPECT_EQ(value_of("0.44 um"), 4.4e-7);
    EXPECT_EQ(value_of("0.44 \u00b5m"), 4.4e-7);
    EXPECT_EQ(value_of("0.44 \u03bcm"), 4.4e-7);
    EXPECT_EQ(value_of("3 mm"), 0.003);
    EXPECT_EQ(value_of("3 cm"), 0.03);
    EXPECT_EQ(value_of("  -5   m "), -5.0);
    EXPECT_EQ(value_of("+.5 m"), 0.5);
    EXPECT_EQ(value_of("5. m"), 5.0);
    EXPECT_EQ(value_of("5.e1 m"), 50.0);
    EXPECT_EQ(value_of("1E3 m"), 1000.0);
}

TEST(Units, ReadsCoefficientsExactly) {
    for (const char* text : {"5.802e-6 /m", "5.802e-3 /km", "5.802e-6 1/m", "5.802e-3 1/km",
                             "5.802e-6 m^-1", "5.802e-3 km^-1", "5.802e-6 m-1", "5.802 Mm-1"}) {
        EXPECT_EQ(value_of(text), 5.802e-6) << text;
        EXPECT_EQ(dimension_of(text), Dimension::inverse_length) << text;
    }
}

TEST(Units, ReadsAnglesFractionsAndNumbers) {
    EXPECT_EQ(value_of("180 deg"), std::numbers::pi);
    EXPECT_EQ(value_of("1.5 rad"), 1.5);
    EXPECT_EQ(value_of("0.2 %"), 0.002);
    EXPECT_EQ(dimension_of("0.2 %"), Dimension::fraction);
    EXPECT_EQ(dimension_of("0.002"), Dimension::number);
    EXPECT_EQ(dimension_of("53 deg"), Dimension::angle);
}

TEST(Units, RefusesWhatIsNoNumber) {
    for (const char* text : {"", " ", "km", "nan", "inf", "-inf", "nan km", "inf km", "0x10 m", ".",
                             "-", "+", "e5", ".e5", "--1", "one"}) {
        EXPECT_TRUE(is_error(text)) << text;
    }
    EXPECT_EQ(error_of("nan km"), ErrorKind::not_a_number);
    EXPECT_EQ(error_of("8 kn"), ErrorKind::unknown_unit);
    EXPECT_EQ(error_of("8 km km"), ErrorKind::unknown_unit);
    EXPECT_EQ(error_of("1,5 km"), ErrorKind::unknown_unit);
    EXPECT_EQ(error_of("8 KM"), ErrorKind::unknown_unit);
    EXPECT_EQ(error_of("1e m"), ErrorKind::unknown_unit);
}

TEST(Units, RefusesWhatNoDoubleHolds) {
    EXPECT_EQ(error_of("1e308 km"), ErrorKind::too_large);
    EXPECT_EQ(error_of("-1e400"), ErrorKind::too_large);
    EXPECT_EQ(error_of("1e-400 m"), ErrorKind::too_small);
    EXPECT_EQ(error_of("1e999999999999999999999 m"), ErrorKind::too_large);
    EXPECT_EQ(error_of("1e-999999999999999999999 m"), ErrorKind::too_small);
    EXPECT_EQ(error_of("1e-320 nm"), ErrorKind::too_small);
    // Zeros before the first digit count too.
    EXPECT_EQ(error_of("0." + std::string(400, '0') + "1 m"), ErrorKind::too_small);
    EXPECT_EQ(error_of(std::string(400, '9') + " m"), ErrorKind::too_large);
    EXPECT_EQ(value_of("0." + std::string(400, '0') + "1e401 m"), 1.0);
    EXPECT_EQ(value_of("0e999 km"), 0.0);
}

TEST(Units, ZeroHasNoSign) {
    EXPECT_FALSE(std::signbit(value_of("-0 m")));
    EXPECT_FALSE(std::signbit(value_of("-0.0e-5 %")));
}

TEST(Units, SpellsCanonically) {
    EXPECT_EQ(length_to_string(8000), "8000 m");
    EXPECT_EQ(length_to_string(6360000), "6360000 m");
    EXPECT_EQ(length_to_string(1e12), "1e+12 m");
    EXPECT_EQ(length_to_string(-0.5), "-0.5 m");
    EXPECT_EQ(wavelength_to_string(6.8e-7), "680 nm");
    EXPECT_EQ(wavelength_to_string(5.325e-7), "532.5 nm");
    EXPECT_EQ(inverse_length_to_string(5.802e-6), "5.802e-06 /m");
    EXPECT_EQ(inverse_length_to_string(0), "0 /m");
    EXPECT_EQ(number_to_string(0.002), "0.002");
    EXPECT_EQ(number_to_string(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(number_to_string(1e-300), "1e-300");
    EXPECT_EQ(angle_to_string(1.5), "1.5 rad");
}

TEST(Units, NamesUnitsOfADimension) {
    EXPECT_EQ(unit_names(Dimension::inverse_length),
              (std::vector<std::string_view>{"/m", "/km", "/Mm"}));
    EXPECT_EQ(unit_meant("/Km", Dimension::inverse_length), "/km");
    // Letters in another order or case; never a unit that is a power of ten away, or another one.
    EXPECT_EQ(unit_meant("mk", Dimension::length), "km");
    EXPECT_EQ(unit_meant("CM-ATM", Dimension::column_density), std::nullopt) << "M is mega";
    EXPECT_EQ(unit_meant("cm-atm", Dimension::column_density), "atm-cm");
    for (const char* name : {"/mm", "/MM", "/Gm"}) {
        EXPECT_FALSE(unit_meant(name, Dimension::inverse_length)) << name;
    }
    for (const char* name : {"mi", "dm", "Mm", "MM", "ft", "hm", "um2"}) {
        EXPECT_FALSE(unit_meant(name, Dimension::length)) << name;
    }
    for (const Dimension dimension :
         {Dimension::length, Dimension::inverse_length, Dimension::pressure,
          Dimension::number_density, Dimension::column_density}) {
        for (const std::string_view one : unit_spellings(dimension)) {
            const auto meant = unit_meant(one, dimension);
            if (!meant) continue;
            EXPECT_EQ(value_of("1 " + std::string(*meant)), value_of("1 " + std::string(one)))
                << one;
        }
    }
    EXPECT_TRUE(unit_names(Dimension::number).empty());
    for (const Dimension dimension :
         {Dimension::fraction, Dimension::length, Dimension::inverse_length, Dimension::angle}) {
        for (const std::string_view unit : unit_spellings(dimension)) {
            EXPECT_EQ(dimension_of("1 " + std::string(unit)), dimension) << unit;
        }
        EXPECT_FALSE(dimension_name(dimension).empty());
    }
}

TEST(Units, CanonicalSpellingReadsBackToTheSameDouble) {
    EXPECT_TRUE(rc::check("canonical spellings round trip", [] {
        const auto value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>()) + 0.0;
        RC_PRE(std::isfinite(value));
        RC_ASSERT(std::get<Quantity>(parse_quantity(number_to_string(value))).value == value);
        RC_ASSERT(std::get<Quantity>(parse_quantity(length_to_string(value))).value == value);
        RC_ASSERT(std::get<Quantity>(parse_quantity(wavelength_to_string(value))).value == value);
        RC_ASSERT(std::get<Quantity>(parse_quantity(inverse_length_to_string(value))).value ==
                  value);
        RC_ASSERT(std::get<Quantity>(parse_quantity(angle_to_string(value))).value == value);
    }));
}

TEST(Units, CanonicalSpellingIsStable) {
    EXPECT_TRUE(rc::check("spelling what was read changes nothing", [] {
        const auto mantissa = *rc::gen::inRange<std::int64_t>(-999999999, 999999999);
        const auto exponent = *rc::gen::inRange(-20, 20);
        const auto unit = *rc::gen::elementOf(unit_spellings(Dimension::length));
        const std::string text =
            std::to_string(mantissa) + "e" + std::to_string(exponent) + " " + std::string(unit);
        const double once = std::get<Quantity>(parse_quantity(text)).value;
        const std::string canonical = length_to_string(once);
        const double twice = std::get<Quantity>(parse_quantity(canonical)).value;
        RC_ASSERT(once == twice);
        RC_ASSERT(length_to_string(twice) == canonical);
    }));
}

// A decimal comma must change nothing. Where no such locale is installed the test says so.
TEST(Units, DoesNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    bool found = false;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE", "sv_SE.UTF-8"}) {
        if (!std::setlocale(LC_ALL, name)) continue;
        found = true;
        EXPECT_EQ(value_of("1.5 km"), 1500.0) << name;
        EXPECT_EQ(length_to_string(1.5), "1.5 m") << name;
        EXPECT_TRUE(is_error("1,5 km")) << name;
    }
    std::setlocale(LC_ALL, before.c_str());
    if (!found) GTEST_SKIP() << "no locale with a decimal comma is installed";
}

// Seconds since 1970 by `date -u -d ... +%s`.
TEST(Moment, IsReadInEachForm) {
    const struct {
        const char* text;
        double clock;
        std::optional<double> offset;
    } cases[] = {
        {"1970-01-01 00:00Z", 0, 0.0},
        {"2003-10-17T12:30:30-07:00", 1066393830, -25200.0},
        {"2026-06-21 18:30", 1782066600, std::nullopt},
        {"  2026-06-21  18:30 +02:00 ", 1782066600, 7200.0},
        {"2024-02-29 23:59:59 +05:45", 1709251199, 20700.0},
        {"1900-01-01 00:00 Z", -2208988800, 0.0},
        {"2100-12-31 00:00 Z", 4133894400, 0.0},
    };
    for (const auto& one : cases) {
        const auto moment = parse_moment(one.text);
        ASSERT_TRUE(moment) << one.text;
        EXPECT_EQ(moment->clock_seconds, one.clock) << one.text;
        EXPECT_EQ(moment->offset_seconds, one.offset) << one.text;
    }
}

TEST(Moment, IsNoOtherText) {
    for (const char* text : {"",
                             "18:30",
                             "2026-06-21",
                             "2026-06-21 ",
                             "2026-6-21 18:30",
                             "26-06-21 18:30",
                             "2026-13-21 18:30",
                             "2026-02-29 18:30",
                             "2026-06-31 18:30",
                             "2026-06-00 18:30",
                             "2026-06-21 24:00",
                             "2026-06-21 18:60",
                             "2026-06-21 18:30:60",
                             "2026-06-21 1830",
                             "2026-06-21 18:30 CET",
                             "2026-06-21 18:30 +2",
                             "2026-06-21 18:30 +02:00 x",
                             "2026-06-21 18:30Zx",
                             "1899-12-31 18:30",
                             "2101-01-01 00:00",
                             "+026-06-21 18:30"}) {
        EXPECT_FALSE(parse_moment(text)) << text;
    }
}

TEST(Moment, IsMeanSolarTimeWithoutAnOffset) {
    EXPECT_EQ(utc_seconds({86400, 3600.0}, 90), 82800);
    EXPECT_EQ(utc_seconds({86400, std::nullopt}, 90), 86400 - 6 * 3600);
    EXPECT_EQ(utc_seconds({86400, std::nullopt}, -15), 86400 + 3600);
}

TEST(Moment, IsSpelledToTheMinute) {
    for (const char* text : {"2026-06-21 16:30", "1970-01-01 00:00", "1969-12-31 23:59",
                             "1900-03-01 00:00", "2000-02-29 12:07"}) {
        EXPECT_EQ(utc_text(parse_moment(text + std::string("Z"))->clock_seconds),
                  text + std::string(" UTC"));
    }
    EXPECT_EQ(utc_text(59.0), "1970-01-01 00:01 UTC");
    EXPECT_EQ(utc_text(-31.0), "1969-12-31 23:59 UTC");
}

}  // namespace

}  // namespace skybake::config
