#include "config/diagnostics/toml_source.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skybake::config {
namespace {

struct ParsedText {
    Source source;
    std::optional<Table> table;
    std::vector<Diagnostic> diagnostics;
};

std::vector<Diagnostic> errors_of(const std::string& text) {
    const Source source{Source::Kind::file, 0, "test.toml", text};
    DiagnosticList list;
    EXPECT_FALSE(parse_toml(source, list)) << text;
    return list.take();
}

TEST(TomlSource, KeepsPlacesOfKeysAndValues) {
    const Source source{Source::Kind::file, 0, "test.toml",
                        "[a.b]\n  \"\u00b5\".c = [1, \"8 km\"]\nd = 1979-05-27\n"};
    DiagnosticList list;
    const std::optional<Table> root = parse_toml(source, list);
    ASSERT_TRUE(root);
    const Entry* a = find_entry(*root, "a");
    ASSERT_TRUE(a);
    EXPECT_EQ(a->key_place.column, 2);
    const Entry* b = find_entry(*as_table(a->value), "b");
    ASSERT_TRUE(b);
    const Entry* mu = find_entry(*as_table(b->value), "\u00b5");
    ASSERT_TRUE(mu);
    EXPECT_EQ(mu->key_place.line, 2);
    EXPECT_EQ(mu->key_place.column, 3);
    EXPECT_EQ(mu->key_place.length, 3);
    const Entry* c = find_entry(*as_table(mu->value), "c");
    ASSERT_TRUE(c);
    const auto& items = std::get<Array>(c->value.data);
    EXPECT_EQ(items[1].place.column, 15);
    EXPECT_EQ(items[1].place.length, 6);
    EXPECT_EQ(items[1].place.source, &source);
    const Entry* d = find_entry(*as_table(b->value), "d");
    ASSERT_TRUE(d);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(d->value.data));
}

TEST(TomlSource, ReportsSyntaxErrors) {
    const auto errors = errors_of("a = 1\nb = = 2\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].code, "E0101");
    EXPECT_EQ(errors[0].where.line, 2);
    EXPECT_EQ(errors[0].where.column, 5);
    EXPECT_EQ(errors[0].where.line_text, "b = = 2");
    EXPECT_EQ(errors_of("[*x]")[0].code, "E0101");
    EXPECT_EQ(errors_of("a = 1\na = 2")[0].code, "E0101");
    EXPECT_EQ(errors_of("a = {")[0].code, "E0101");
}

TEST(TomlSource, KnowsTheCommonSlip) {
    const auto errors = errors_of("scale_height = 8 km  # air\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].label, "write a quantity with a unit in quotes: \"8 km\"");
}

TEST(TomlSource, KnowsAnUnclosedQuote) {
    for (const char* text : {"a = 1\nb = \"8 km\nc = 2\n", "a = 1\nb = \"8 km",
                             "a = 1\nb = '8 km\nc = 2\n", "a = 1\nb = \"8 \\\" km\n"}) {
        const auto errors = errors_of(text);
        ASSERT_EQ(errors.size(), 1u) << text;
        EXPECT_EQ(errors[0].message, "not TOML: the quote that opens here is not closed") << text;
        EXPECT_EQ(errors[0].where.line, 2) << text;
        EXPECT_EQ(errors[0].where.column, 5) << text;
    }
    EXPECT_EQ(errors_of("a = '\xc3\xa4' = \"\n").at(0).where.column, 11);
    const auto other = errors_of("a = \"it's\" 'b'\n");
    EXPECT_EQ(other.at(0).message.find("quote"), std::string::npos) << other[0].message;
}

TEST(TomlSource, KnowsADecimalComma) {
    for (const char* value : {"0,3", "-12,5", "+1,0  # half"}) {
        EXPECT_EQ(errors_of(std::string("a = ") + value + "\n").at(0).label,
                  "write a decimal point, not a comma")
            << value;
    }
    EXPECT_EQ(errors_of("a = 1,\n").at(0).label, "");
    EXPECT_EQ(errors_of("a = ,1\n").at(0).label, "");
    EXPECT_EQ(errors_of("a = 1,2,3\n").at(0).label, "");
}

TEST(TomlSource, KnowsTextsOfOtherPrograms) {
    struct Slip {
        const char* text;
        const char* label;
    };
    for (const auto& [text, label] : {
             Slip{"a = \u201c8 km\u201d\n", "a typographic quote: write the plain one, \""},
             Slip{"a =\u00a01 2\n", "a no-break space: write a plain one"},
             Slip{"preset: earth\n", "this looks like YAML; recipes are TOML: preset = \"earth\""},
             Slip{"{\"preset\": \"earth\"}\n",
                  "this looks like JSON; recipes are TOML: preset = \"earth\""},
             Slip{"a = 1\rb = 2\r",
                  "lines end with a carriage return alone, as on an old Mac: save with line feeds"},
         }) {
        EXPECT_EQ(errors_of(text).at(0).label, label) << text;
    }
}

TEST(TomlSource, ReportsTextThatIsNotUtf8) {
    const auto errors = errors_of("a = 1\nb = \"\xff\"\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].code, "E0100");
    EXPECT_EQ(errors[0].where.line, 2);
    EXPECT_EQ(errors[0].where.column, 6);
    EXPECT_EQ(errors[0].where.line_text, "b = \"\\xff\"");
    EXPECT_EQ(errors[0].label, "a recipe is TOML text: save it as UTF-8 in your editor");
    EXPECT_EQ(errors[0].message, "`test.toml` is not UTF-8 text: byte 0xff at offset 11");
    EXPECT_EQ(errors_of(std::string("\x7f"
                                    "ELF\0\1",
                                    6))[0]
                  .code,
              "E0100");
}

// The parser and every walk over its trees recurse; these would overrun the stack.
TEST(TomlSource, RefusesRecursionBombs) {
    std::string dots = "a";
    for (int i = 0; i < 500000; ++i) dots += ".a";
    for (const std::string& text : {dots + " = 1", "[" + dots + "]",
                                    "a = " + std::string(500000, '['), "a = {" + dots + " = 1}"}) {
        EXPECT_EQ(errors_of(text)[0].code, "E0121");
    }
    EXPECT_FALSE(parse_toml_key(dots));
    EXPECT_FALSE(parse_toml_value(std::string(500000, '[')));
}

TEST(TomlSource, ReadsValuesOfSettings) {
    const auto spelled = [](std::string_view text) {
        const std::optional<Value> value = parse_toml_value(text);
        return value ? value_to_string(*value) : "none";
    };
    EXPECT_EQ(spelled("1"), "1");
    EXPECT_EQ(spelled("0.5"), "0.5");
    EXPECT_EQ(spelled("true"), "true");
    EXPECT_EQ(spelled("\"8 km\""), "\"8 km\"");
    EXPECT_EQ(spelled("[1, \"a\", {b = 2}]"), "[1, \"a\", { b = 2 }]");
    EXPECT_EQ(spelled("nan"), "nan");
    EXPECT_EQ(spelled("-inf"), "-inf");
    EXPECT_EQ(spelled("8 km"), "none");
    EXPECT_EQ(spelled(""), "none");
    EXPECT_EQ(spelled("1\nother = 2"), "none");
    EXPECT_EQ(spelled("\xff"), "none");
}

TEST(TomlSource, ReadsKeysOfSettings) {
    EXPECT_EQ(parse_toml_key("a.b.c"), "a.b.c");
    EXPECT_EQ(parse_toml_key("a . 'sea fog'"), "a.\"sea fog\"");
    for (const char* bad : {"", ".", "a.", "a b", "[a]", "a\nb", "a = 1\nb", "[a]\nb", "#"}) {
        EXPECT_EQ(parse_toml_key(bad), std::nullopt) << bad;
    }
}

TEST(TomlSource, SpellsStringsSoThatTheyReadBack) {
    EXPECT_TRUE(rc::check("strings round trip", [] {
        const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(0, 127));
        const std::string spelled = value_to_string(Value{text, {}});
        if (text.find('\0') != std::string::npos) return;
        const std::optional<Value> value = parse_toml_value(spelled);
        RC_ASSERT(value.has_value());
        RC_ASSERT(std::get<std::string>(value->data) == text);
    }));
}

}  // namespace
}  // namespace skybake::config
