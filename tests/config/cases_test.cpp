// Recipes with mistakes, and what is said about them: the files of cases/, whose README says how they
// are written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
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

struct Case {
    std::string name;
    std::vector<CaseLine> lines;
    std::vector<CaseLine> settings;
    std::vector<CaseLine> at_frame;
};

// Takes the expectations off the end of a line: "key = 1  # E0110 7 words # E0102 1+3 words".
CaseLine read_line(const std::string& line, int number) {
    static const std::regex comment(" *#\\^? ([EW]\\d{4}) (\\d+)(?:\\+(\\d+))? ?");
    std::sregex_iterator at(line.begin(), line.end(), comment);
    const std::sregex_iterator end;
    CaseLine result{line.substr(0, at == end ? line.npos : std::size_t(at->position())), number, {}};
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
        finish();
    }
    std::vector<Case> cases;

  private:
    enum class Part { before, behind, cases };

    void read(const std::string& whole, const CaseLine& line) {
        if (whole.starts_with("#===")) {
            finish();
            part_ = Part::before;
            before_.clear();
            behind_.clear();
        } else if (whole == "#...") {
            part_ = Part::behind;
        } else if (whole == "#---") {
            part_ = Part::cases;
        } else if (part_ == Part::before) {
            before_.push_back(line);
        } else if (part_ == Part::behind) {
            behind_.push_back(line);
        } else if (!whole.empty() && !whole.starts_with("# ")) {
            read_case(whole, line);
        }
    }

    void read_case(const std::string& whole, const CaseLine& line) {
        const std::size_t first = whole.find_first_not_of(' ');
        const std::string text = whole.substr(first);
        if (first == 0 && !text.starts_with("#^")) {
            finish();
            open_ = Case{line.text, before_, {}, {}};
        }
        if (!open_) return;
        if (text.starts_with("#^")) {
            auto& above = open_->lines.back().expected;
            above.insert(above.end(), line.expected.begin(), line.expected.end());
        } else if (text.starts_with("#set ")) {
            open_->settings.push_back({line.text.substr(first + 5), line.number, line.expected});
        } else if (text.starts_with("#@")) {
            open_->at_frame.push_back({line.text.substr(first), line.number, line.expected});
        } else {
            open_->lines.push_back(line);
        }
    }

    void finish() {
        if (!open_) return;
        open_->lines.insert(open_->lines.end(), behind_.begin(), behind_.end());
        cases.push_back(std::move(*open_));
        open_.reset();
    }

    Part part_ = Part::cases;
    std::vector<CaseLine> before_, behind_;
    std::optional<Case> open_;
};

// A line's expectations that are met are taken away.
bool take(CaseLine& line, const Diagnostic& found) {
    const std::string said = found.message + " | " + found.label;
    const auto met = std::find_if(
        line.expected.begin(), line.expected.end(), [&](const Expected& expected) {
            return expected.code == found.code && expected.column == found.where.column &&
                   (expected.length == 0 || expected.length == found.where.length) &&
                   said.find(expected.words) != said.npos;
        });
    if (met == line.expected.end()) return false;
    line.expected.erase(met);
    return true;
}

// The line of a case that a diagnostic is about; none where it is about no line of it.
CaseLine* line_of(Case& one, const SourceRange& where) {
    if (where.source != "test.toml") {
        for (CaseLine& setting : one.settings) {
            if (where.source == "--set `" + setting.text + "`") return &setting;
        }
        return nullptr;
    }
    const auto line = static_cast<std::size_t>(where.line);
    const std::string text = line > 0 ? one.lines.at(line - 1).text : "";
    for (CaseLine& said : one.at_frame) {
        if (said.text == (text.empty() ? "#@" : "#@ " + text)) return &said;
    }
    return line > 0 ? &one.lines[line - 1] : nullptr;
}

void check(Case one, const std::string& path) {
    std::string text;
    std::vector<std::string> settings;
    for (const CaseLine& line : one.lines) text += line.text + "\n";
    for (const CaseLine& line : one.settings) settings.push_back(line.text);
    const Outcome<Recipe> outcome = parse_recipe(text, "test.toml", {}, settings);
    for (const Diagnostic& found : outcome.diagnostics) {
        EXPECT_EQ(found.severity == Severity::warning, found.code.starts_with('W')) << found.code;
        CaseLine* line = line_of(one, found.where);
        if (line && take(*line, found)) continue;
        ADD_FAILURE_AT(path.c_str(), line ? line->number : one.lines.at(0).number)
            << one.name << ": said unexpectedly: # " << found.code << ' ' << found.where.column
            << '+' << found.where.length << ' ' << found.message << " | " << found.label;
    }
    EXPECT_EQ(outcome.value.has_value(), exit_code(outcome.diagnostics) == 0) << one.name;
    for (const auto* lines : {&one.lines, &one.settings, &one.at_frame}) {
        for (const CaseLine& line : *lines) {
            for (const Expected& expected : line.expected)
                ADD_FAILURE_AT(path.c_str(), line.number)
                    << one.name << ": not said: " << expected.code << ' ' << expected.column << ' '
                    << expected.words;
        }
    }
}

std::vector<std::string> case_files() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(SKYBAKE_CASES)) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string path_of(const std::string& name) { return SKYBAKE_CASES "/" + name + ".toml"; }

class Cases : public ::testing::TestWithParam<std::string> {};

TEST_P(Cases, AreSaidWhereTheyAre) {
    const CaseReader file(path_of(GetParam()));
    EXPECT_FALSE(file.cases.empty());
    for (const Case& one : file.cases) check(one, path_of(GetParam()));
}

// The codes that need files, options or a bake have tests of their own.
TEST(Recipes, HaveACaseOfEveryCode) {
    std::set<std::string> said = {"E0100", "E0116", "E0120", "E0122", "E0123",
                                  "E0124", "E0125", "E0143", "E0178"};
    for (const std::string& name : case_files()) {
        std::ifstream file(path_of(name));
        for (std::string line; std::getline(file, line);) {
            for (const Expected& expected : read_line(line, 0).expected) said.insert(expected.code);
        }
    }
    for (const DiagnosticCode& code : diagnostic_codes()) {
        EXPECT_TRUE(said.contains(code.code) || !code.code.starts_with("E01")) << code.code;
    }
}

INSTANTIATE_TEST_SUITE_P(Recipes, Cases, ::testing::ValuesIn(case_files()),
                         [](const auto& file) { return file.param; });

}  // namespace
}  // namespace skybake::config
