#include "cli/diagnostic_printer.h"

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skybake::cli {
namespace {

std::vector<Diagnostic> samples() {
    return {
        {Severity::error,
         "E0102",
         "unknown key `scale_hieght` in [atmosphere.layers.rayleigh]",
         {"earth.toml", 14, 1, 12, "scale_hieght = \"8 km\""},
         "did you mean `scale_height`?"},
        {Severity::error,
         "E0110",
         "`atmosphere.layers.mie.g` is out of range: 1.2",
         {"earth.toml", 22, 5, 3, "g = 1.2"},
         "must be in (-1, 1); typical haze has 0.76"},
        {Severity::error,
         "E0107",
         "expected a length, not an angle",
         {"--set `clouds.cumulus.base_altitude=40deg`", 0, 0, 0, ""},
         ""},
    };
}

std::string human(const Diagnostic& diagnostic) {
    return print_diagnostics({&diagnostic, 1}, DiagnosticFormat::human);
}

TEST(DiagnosticPrinter, HumanIsAsTheManualShowsIt) {
    EXPECT_EQ(print_diagnostics(samples(), DiagnosticFormat::human),
              R"(error[E0102]: unknown key `scale_hieght` in [atmosphere.layers.rayleigh]
 --> earth.toml:14:1
   |
14 | scale_hieght = "8 km"
   | ^^^^^^^^^^^^ did you mean `scale_height`?
error[E0110]: `atmosphere.layers.mie.g` is out of range: 1.2
 --> earth.toml:22:5
   |
22 | g = 1.2
   |     ^^^ must be in (-1, 1); typical haze has 0.76
error[E0107]: expected a length, not an angle
 --> --set `clouds.cumulus.base_altitude=40deg`
3 errors
)");
}

TEST(DiagnosticPrinter, CountsErrorsAndWarnings) {
    std::vector<Diagnostic> diagnostics = samples();
    diagnostics[1].severity = Severity::warning;
    expect_has(print_diagnostics(diagnostics, DiagnosticFormat::human),
               {"\n2 errors, 1 warning\n"});
    EXPECT_TRUE(contains(human(diagnostics[1]), "\n1 warning\n"));
    EXPECT_EQ(print_diagnostics({}, DiagnosticFormat::human), "");
}

TEST(DiagnosticPrinter, CaretsStandBelowWhatTheyMeanBehindWideSigns) {
    // Columns count code points: the key starts at the 9th, the terminal shows it at the 11th.
    const Diagnostic diagnostic{
        Severity::error, "E0102", "m", {"f", 3, 9, 2, "\"µ霧 雲\" = ab"}, "here"};
    expect_has(human(diagnostic), {"3 | \"µ霧 雲\" = ab\n  |           ^^ here\n"});
}

TEST(DiagnosticPrinter, TabsAreShownAsSpaces) {
    const Diagnostic diagnostic{Severity::error, "E0102", "m", {"f", 3, 3, 1, "\t\tg = 1"}, ""};
    expect_has(human(diagnostic), {"3 |         g = 1\n  |         ^\n"});
}

TEST(DiagnosticPrinter, CropsLongLinesAroundTheRange) {
    const std::string line = std::string(5000, 'a') + "BAD" + std::string(5000, 'b');
    const Diagnostic diagnostic{Severity::error, "E0101", "m", {"f", 1, 5001, 3, line}, ""};
    const std::string text = human(diagnostic);
    expect_has(text, {"1 | …" + std::string(30, 'a') + "BAD" + "b", "b…\n",
                      "  | " + std::string(31, ' ') + "^^^\n"});
    EXPECT_LT(text.size(), 400u);
}

TEST(DiagnosticPrinter, PointsBehindALineThatEndsEarly) {
    const Diagnostic diagnostic{Severity::error, "E0101", "m", {"f", 1, 5, 1, "g = "}, "a value"};
    EXPECT_TRUE(contains(human(diagnostic), "1 | g = \n  |     ^ a value\n")) << human(diagnostic);
}

TEST(DiagnosticPrinter, NeverLetsTheTerminalObeyARecipe) {
    const Diagnostic diagnostic{
        Severity::error, "E0101", "m", {"f", 1, 1, 1, "\x1b[31m\xff\x07"}, ""};
    EXPECT_FALSE(contains(human(diagnostic), "\x1b"));
    EXPECT_FALSE(contains(human(diagnostic), "\x07"));
    EXPECT_FALSE(contains(human(diagnostic), "\xff"));
}

TEST(DiagnosticPrinter, PlacesBeyondTheLineDoNoHarm) {
    for (const int column : {-5, 0, 1, 99, 2147483647}) {
        for (const int length : {-5, 0, 1, 99, 2147483647}) {
            const Diagnostic diagnostic{
                Severity::error, "E0101", "m", {"f", 1, column, length, "ab"}, "x"};
            for (const auto format :
                 {DiagnosticFormat::human, DiagnosticFormat::short_, DiagnosticFormat::json,
                  DiagnosticFormat::github, DiagnosticFormat::sarif}) {
                EXPECT_FALSE(print_diagnostics({&diagnostic, 1}, format).empty());
            }
        }
    }
}

TEST(DiagnosticPrinter, ColoursOnRequest) {
    expect_has(print_diagnostics(samples(), DiagnosticFormat::human, true), {"\x1b[1;31m"});
    EXPECT_FALSE(contains(print_diagnostics(samples(), DiagnosticFormat::human), "\x1b"));
}

TEST(DiagnosticPrinter, ShortIsOneLineEach) {
    EXPECT_EQ(print_diagnostics(samples(), DiagnosticFormat::short_),
              "earth.toml:14:1: error[E0102]: unknown key `scale_hieght` in "
              "[atmosphere.layers.rayleigh]; "
              "did you mean `scale_height`?\n"
              "earth.toml:22:5: error[E0110]: `atmosphere.layers.mie.g` is out of range: 1.2; "
              "must be in (-1, 1); typical haze has 0.76\n"
              "--set `clouds.cumulus.base_altitude=40deg`: error[E0107]: expected a length, "
              "not an angle\n");
}

TEST(DiagnosticPrinter, JsonIsOneObjectALine) {
    const std::string text = print_diagnostics(samples(), DiagnosticFormat::json);
    EXPECT_EQ(testing::count_lines(text), 3);
    const auto first = nlohmann::json::parse(text.substr(0, text.find('\n')));
    EXPECT_EQ(first["severity"], "error");
    EXPECT_EQ(first["code"], "E0102");
    EXPECT_EQ(first["file"], "earth.toml");
    EXPECT_EQ(first["line"], 14);
    EXPECT_EQ(first["column"], 1);
    EXPECT_EQ(first["length"], 12);
    EXPECT_EQ(first["label"], "did you mean `scale_height`?");
    const auto setting = nlohmann::json::parse(text.substr(text.rfind("{\"severity")));
    EXPECT_EQ(setting["source"], "--set `clouds.cumulus.base_altitude=40deg`");
    for (const char* key : {"file", "line", "column", "length"}) {
        EXPECT_FALSE(setting.contains(key)) << setting;
    }
}

// An editor cannot open an option, a preset or standard input; of the last it knows the lines.
TEST(DiagnosticPrinter, OnlyFilesAreFiles) {
    for (const char* source : {"--set `a=1`", "--vary `a=1,2`", "preset earth", "<stdin>"}) {
        const Diagnostic diagnostic{Severity::error, "E0101", "m", {source, 3, 1, 2, "ab"}, "x"};
        const auto json =
            nlohmann::json::parse(print_diagnostics({&diagnostic, 1}, DiagnosticFormat::json));
        EXPECT_FALSE(json.contains("file")) << source;
        EXPECT_EQ(json["source"], source);
        EXPECT_EQ(json.contains("line"), std::string(source) == "<stdin>") << source;
        const std::string github = print_diagnostics({&diagnostic, 1}, DiagnosticFormat::github);
        EXPECT_TRUE(github.starts_with("::error title=E0101::m (")) << github;
        EXPECT_TRUE(contains(github, source)) << github;
    }
}

TEST(DiagnosticPrinter, GitHubEscapesWhatEndsAProperty) {
    std::vector<Diagnostic> diagnostics = samples();
    diagnostics[0].where.source = "a,b:c%.toml";
    diagnostics[0].message = "100 %\nof it";
    const std::string text = print_diagnostics(diagnostics, DiagnosticFormat::github);
    expect_has(text, {"::error file=a%2Cb%3Ac%25.toml,line=14,col=1,endColumn=13,title=E0102::"
                      "100 %25%0Aof it; did you mean"});
}

TEST(DiagnosticPrinter, SarifIsOneDocument) {
    std::vector<Diagnostic> diagnostics = samples();
    diagnostics[1].severity = Severity::warning;
    diagnostics[1].where.source = "a b/µ.toml";
    const auto document =
        nlohmann::json::parse(print_diagnostics(diagnostics, DiagnosticFormat::sarif));
    EXPECT_EQ(document["version"], "2.1.0");
    const auto& run = document["runs"][0];
    EXPECT_EQ(run["tool"]["driver"]["name"], "skybake");
    EXPECT_EQ(run["tool"]["driver"]["rules"].size(), 3u);
    ASSERT_EQ(run["results"].size(), 3u);
    EXPECT_EQ(run["results"][0]["ruleId"], "E0102");
    EXPECT_EQ(run["results"][0]["locations"][0]["physicalLocation"]["region"]["startLine"], 14);
    EXPECT_EQ(run["results"][1]["level"], "warning");
    EXPECT_EQ(run["results"][1]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
              "a%20b/%C2%B5.toml");
    EXPECT_FALSE(run["results"][2]["locations"][0].contains("physicalLocation"));
    const auto empty = nlohmann::json::parse(print_diagnostics({}, DiagnosticFormat::sarif));
    EXPECT_TRUE(empty["runs"][0]["results"].empty());
}

}  // namespace
}  // namespace skybake::cli
