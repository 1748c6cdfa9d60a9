// Recipes with mistakes, and what is said about them: cases/README.md says how they are written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic_codes.h"
#include "config/recipe/recipe.h"

namespace skybake::config {
namespace {

struct Expected {
    std::string code;
    int column = 0;
    int length = 0;     // 0 where the case does not say
    std::string words;  // a part of "message | label"
};

struct CaseLine {
    std::string text;
    int number = 0;  // in the file of cases
    std::vector<Expected> expected;
};

// "#= .size [8, 8] < derived": a value of the recipe, in base units, and where it comes from.
struct ExpectedValue {
    int number = 0;
    std::string path, canonical, origin;
};

struct Case {
    int number = 0;
    std::vector<CaseLine> lines, behind;
    std::vector<ExpectedValue> values;
    std::vector<std::string> settings;
    std::vector<CaseLine> places;  // "#@ LINE" of the frame, "--set `SETTING`", or the recipe
};

const std::string whole_recipe = "test.toml";  // as a place

// Takes the expectations off the end of a line: "key = 1  # E0110 7 words # E0102 1+3 words".
CaseLine read_line(const std::string& line, int number) {
    static const std::regex comment(" *#\\^? ([EW]\\d{4}) (\\d+)(?:\\+(\\d+))? ?");
    std::sregex_iterator at(line.begin(), line.end(), comment), end;
    const auto text_end = at == end ? line.end() : line.begin() + at->position();
    CaseLine result{std::string(line.begin(), text_end), number, {}};
    while (at != end) {
        const std::smatch found = *at++;
        const auto words = line.begin() + found.position() + found.length();
        result.expected.push_back(
            {found[1], std::stoi(found[2]), found[3].matched ? std::stoi(found[3]) : 0,
             std::string(words, at == end ? line.end() : line.begin() + at->position())});
    }
    return result;
}

// Reads the cases of one file: a line that is not indented begins one.
class CaseReader {
  public:
    explicit CaseReader(const std::filesystem::path& path) {
        std::ifstream file(path);
        int number = 0;
        for (std::string line; std::getline(file, line);) read(line, read_line(line, ++number));
    }
    std::vector<Case> cases;

  private:
    void read(const std::string& whole, const CaseLine& line) {
        if (whole.starts_with("#===")) {
            before_.clear();
            behind_.clear();
            frame_ = &before_;
        } else if (whole == "#...") {
            frame_ = &behind_;
        } else if (whole == "#---") {
            frame_ = nullptr;
        } else if (frame_) {
            frame_->push_back(line);
        } else if (!whole.empty() && !whole.starts_with("# ")) {
            read_case(whole, line);
        }
    }

    void read_case(const std::string& whole, CaseLine line) {
        const std::size_t first = whole.find_first_not_of(' ');
        const bool is_below =
            whole[first] == '#' && (whole[first + 1] == '^' || whole[first + 1] == '=');
        if (cases.empty() || (first == 0 && !is_below))
            cases.push_back({line.number, before_, behind_, {}, {}, {}});
        Case& open = cases.back();
        if (is_below && whole[first + 1] == '=') return read_values(open, whole.substr(first));
        line.text.erase(0, std::min(first, line.text.size()));
        if (is_below && !open.lines.empty()) {
            auto& above = open.lines.back().expected;
            above.insert(above.end(), line.expected.begin(), line.expected.end());
        } else if (line.text.starts_with("#set ")) {
            open.settings.push_back(line.text.substr(5));
            line.text = "--set `" + open.settings.back() + "`";
            open.places.push_back(line);
        } else if (line.text.starts_with("#@")) {
            if (line.text == "#@") line.text = whole_recipe;
            open.places.push_back(line);
        } else {
            for (std::size_t end; (end = line.text.find(" ; ")) != line.text.npos;) {
                open.lines.push_back({line.text.substr(0, end), line.number, {}});
                line.text.erase(0, end + 3);
            }
            open.lines.push_back(line);
        }
    }

    // A path that begins with a point is one of the frame's last section.
    void read_values(Case& open, const std::string& line) {
        static const std::regex value("#= (\\S+)(?: (.*?)){0,1}?(?: < (.*?))?(?= #= |$)");
        for (std::sregex_iterator at(line.begin(), line.end(), value), end; at != end; ++at)
            open.values.push_back({open.number, path_of((*at)[1]), (*at)[2], (*at)[3]});
    }

    std::string path_of(const std::string& path) const {
        const auto section = std::find_if(before_.rbegin(), before_.rend(), [](const auto& line) {
            return line.text.starts_with("[");
        });
        if (!path.starts_with(".") || section == before_.rend()) return path;
        return section->text.substr(1, section->text.size() - 2) + path;
    }

    std::vector<CaseLine> before_, behind_, *frame_ = nullptr;
};

// A line's expectations that are met are taken away.
bool take(CaseLine& line, const Diagnostic& found) {
    const std::string said = found.message + " | " + found.label;
    const auto met =
        std::find_if(line.expected.begin(), line.expected.end(), [&](const Expected& expected) {
            return expected.code == found.code && expected.column == found.where.column &&
                   (expected.length == 0 || expected.length == found.where.length) &&
                   said.find(expected.words) != said.npos;
        });
    if (met == line.expected.end()) return false;
    line.expected.erase(met);
    return true;
}

// The line of a case that a diagnostic is about; none where the case has no such line.
CaseLine* line_of(Case& one, const SourceRange& where) {
    const bool is_text = where.source == whole_recipe && where.line > 0;
    CaseLine* line = is_text ? &one.lines.at(static_cast<std::size_t>(where.line) - 1) : nullptr;
    const std::string place = line ? "#@ " + line->text : where.source;
    for (CaseLine& said : one.places) {
        if (place.starts_with(said.text)) return &said;
    }
    return line;
}

void check_values(const Case& one, const Outcome<Recipe>& outcome, const char* path) {
    for (const ExpectedValue& expected : one.values) {
        ResolvedValue found;
        for (const ResolvedValue& value :
             outcome.value ? outcome.value->values : decltype(outcome.value->values){})
            if (value.path == expected.path) found = value;
        if (found.canonical == expected.canonical &&
            (expected.origin.empty() || found.origin == expected.origin))
            continue;
        ADD_FAILURE_AT(path, one.number)
            << "#= " << expected.path << ' ' << found.canonical << " < " << found.origin;
    }
}

void check(Case one, const char* path) {
    std::string text;
    one.lines.insert(one.lines.end(), one.behind.begin(), one.behind.end());
    for (const CaseLine& line : one.lines) text += line.text + "\n";
    const Outcome<Recipe> outcome = parse_recipe(text, whole_recipe, {}, one.settings);
    check_values(one, outcome, path);
    if (outcome.value.has_value() != (exit_code(outcome.diagnostics) == 0))
        ADD_FAILURE_AT(path, one.number) << "a value and errors, or neither";
    for (const Diagnostic& found : outcome.diagnostics) {
        EXPECT_EQ(found.severity == Severity::warning, found.code.starts_with('W')) << found.code;
        EXPECT_FALSE(found.message.empty()) << found.code;
        CaseLine* line = line_of(one, found.where);
        if (line && take(*line, found)) continue;
        ADD_FAILURE_AT(path, line ? line->number : one.number)
            << "not expected: # " << found.code << ' ' << found.where.column << '+'
            << found.where.length << ' ' << found.message << " | " << found.label;
    }
    one.lines.insert(one.lines.end(), one.places.begin(), one.places.end());
    for (const CaseLine& line : one.lines) {
        for (const Expected& left : line.expected)
            ADD_FAILURE_AT(path, line.number)
                << "not reported: # " << left.code << ' ' << left.column << ' ' << left.words;
    }
}

std::vector<std::filesystem::path> case_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SKYBAKE_CASES)) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class Cases : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(Cases, AreReportedAsTheySay) {
    const CaseReader file(GetParam());
    EXPECT_FALSE(file.cases.empty());
    for (const Case& one : file.cases) check(one, GetParam().c_str());
}

// The codes that need files, options or a bake have tests of their own.
TEST(CaseFiles, HoldEveryCodeOfARecipe) {
    std::string said = "E0100 E0116 E0120 E0122 E0123 E0124 E0125 E0143 E0178";
    for (const auto& path : case_files()) {
        std::ifstream file(path);
        for (std::string line; std::getline(file, line);)
            for (const Expected& expected : read_line(line, 0).expected) said += expected.code;
    }
    for (const DiagnosticCode& code : diagnostic_codes())
        EXPECT_TRUE(said.find(code.code) != said.npos || !code.code.starts_with("E01"))
            << code.code;
}

INSTANTIATE_TEST_SUITE_P(Recipes, Cases, ::testing::ValuesIn(case_files()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace skybake::config
