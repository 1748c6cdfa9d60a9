// config/KEYS.md, the page of all keys, is written from the tables that everything else is
// generated from (config/fields/fields.h). A failure means that a table has changed and the page
// has not:
//
//   SKYBAKE_UPDATE_GOLDEN=1 build/quickstart/tests/config/config_tests --gtest_filter='KeysPage.*'
//
// writes it anew.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "config/fields/fields.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

const std::filesystem::path kKeysPage = SKYBAKE_EXAMPLES "/../config/KEYS.md";

constexpr std::string_view kKeysPageHead = R"(# All keys of a recipe

This page is generated from the tables that the program itself reads, checks and explains recipes by,
and a test holds it to them. `skybake explain KEY` prints the same for one key, `skybake show RECIPE`
prints the values of a recipe with where each came from, and `skybake schema` prints a JSON Schema for
editors.

A recipe is a [TOML](https://toml.io) file. NAME in a section's title stands for a name of your choice.
`preset = "earth"` and `include = ["haze.toml"]` are read first, the file's own keys override them, and
`--set a.b=c` overrides the file. Tables merge key by key; arrays are replaced. If a later source names
another `profile`, `phase` or `type`, or another one of keys that exclude each other, it drops what
belonged to the earlier one.

A quantity is a number and a unit in quotes, as in `"8 km"`. A number without quotes has no unit. In
ranges, a square bracket includes the bound and a round one excludes it.

)";

// Text that stands in a cell of a table.
std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (std::string_view("|*<>").find(c) != std::string_view::npos) escaped += '\\';
        escaped += c == '\n' ? ' ' : c;
    }
    return escaped;
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string coded(const std::vector<std::string_view>& words, std::string_view between) {
    std::vector<std::string> codes;
    for (const std::string_view word : words) codes.push_back(code(word));
    return fmt::format("{}", fmt::join(codes, between));
}

std::string units_table() {
    std::string text = "| quantity | units |\n|---|---|\n";
    for (const Dimension dimension :
         {Dimension::fraction, Dimension::length, Dimension::inverse_length,
          Dimension::number_density, Dimension::angle}) {
        text += fmt::format("| {} | {} |\n", dimension_name(dimension),
                            coded(unit_names(dimension), ", "));
    }
    return text;
}

// "[atmosphere.layers.NAME]", "Asset transmittance".
std::string title(const Section& section) {
    if (!section.asset.empty()) return fmt::format("Asset {}", section.asset);
    if (section.path.empty()) return "Top level";
    static const std::regex star("\\*");
    return fmt::format("[{}]", std::regex_replace(std::string(section.path), star, "NAME"));
}

// The anchor that renderers of Markdown make of a title.
std::string anchor(std::string_view title) {
    std::string slug;
    for (const char c : title) {
        if (c == ' ') slug += '-';
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
            slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return slug;
}

std::string contents() {
    std::string text;
    for (const Section& section : sections()) {
        const std::string name = title(section);
        text += fmt::format("- [{}](#{}): {}\n", name[0] == '[' ? code(name) : name, anchor(name),
                            cell(section.documentation));
    }
    return text;
}

std::string default_of(const Field& field) {
    if (!field.fallback.empty()) return code(field.fallback);
    if (field.key == "asset") return "the section's name";
    return field.required ? "**required**" : "none";
}

std::string allowed(const Field& field) {
    std::vector<std::string> parts;
    for (const Choice& choice : field.choices) {
        parts.push_back(fmt::format("`\"{}\"`: {}", choice.name, cell(choice.documentation)));
    }
    if (const std::string range = describe_range(field); !range.empty()) {
        parts.push_back(cell(range));
    }
    if (!field.hint.empty()) parts.push_back(cell(field.hint));
    return fmt::format("{}", fmt::join(parts, "<br>"));
}

std::string meaning(const Section& section, const Field& field) {
    std::string text = cell(field.documentation);
    if (!field.selector.empty()) {
        text += fmt::format("; only with `{}` = {}", field.selector,
                            coded({field.selected_by.begin(), field.selected_by.end()}, " or "));
    }
    if (!field.needs.empty()) text += fmt::format("; only with `{}`", field.needs);
    std::vector<std::string_view> others;
    for (const Field& other : section.fields) {
        if (exclude_each_other(field, other)) others.push_back(other.key);
    }
    if (!others.empty()) text += fmt::format("; not together with {}", coded(others, ", "));
    if (!field.citation.empty()) text += fmt::format(" ({})", cell(field.citation));
    return text;
}

// A key of some section, and how the page shows it.
struct KeyRow {
    const Field* field = nullptr;
    std::string start;  // key and kind
    std::string by_default;
    std::string end;  // what is allowed, and the meaning
    int uses = 0;     // how many assets have it

    std::string text(std::string_view given) const { return start + std::string(given) + end; }
    bool says_what(const KeyRow& other) const { return start == other.start && end == other.end; }
};

std::vector<KeyRow> rows_of(const Section& section) {
    std::vector<KeyRow> rows;
    for (const Field& field : section.fields) {
        rows.push_back({&field, fmt::format("| `{}` | {} | ", field.key, cell(field.kind.words)),
                        default_of(field),
                        fmt::format(" | {} | {} |\n", allowed(field), meaning(section, field))});
    }
    return rows;
}

// The row that says the same; the end where there is none.
std::vector<KeyRow>::iterator alike(std::vector<KeyRow>& rows, const KeyRow& row) {
    return std::ranges::find_if(rows, [&](const KeyRow& other) { return other.says_what(row); });
}

// The keys that at least three assets have alike, but perhaps for the default.
std::vector<KeyRow> shared_rows() {
    std::vector<KeyRow> shared;
    for (const Section& section : sections()) {
        if (section.asset.empty()) continue;
        for (const KeyRow& row : rows_of(section)) {
            auto same = alike(shared, row);
            if (same == shared.end()) same = shared.insert(same, row);
            ++same->uses;
            if (same->by_default != row.by_default) same->by_default = "the asset's";
        }
    }
    std::erase_if(shared, [](const KeyRow& row) { return row.uses < 3; });
    return shared;
}

constexpr std::string_view kTableHead =
    "\n| key | takes | default | allowed | meaning |\n|---|---|---|---|---|\n";
constexpr std::string_view kSharedTitle = "Keys of several assets";

std::string page_of_shared(const std::vector<KeyRow>& shared) {
    std::string text = fmt::format("\n## {}\n\nEach asset below names those that it has.\n{}",
                                   kSharedTitle, kTableHead);
    for (const KeyRow& row : shared) text += row.text(row.by_default);
    return text;
}

std::string section_of_page(const Section& section, std::vector<KeyRow>& shared) {
    std::string text = fmt::format("\n## {}\n\n", title(section));
    std::string documentation = cell(section.documentation);
    documentation[0] =
        static_cast<char>(std::toupper(static_cast<unsigned char>(documentation[0])));
    text += documentation + ".\n";
    if (!section.asset.empty()) {
        text +=
            fmt::format("`[bake.NAME]` with `asset = \"{0}\"`, or `[bake.{0}]`.", section.asset);
        text += fmt::format(" [A page of its own](../examples/assets/{}.md).\n", section.asset);
    }
    std::string own;
    std::vector<std::string> others;
    for (const KeyRow& row : rows_of(section)) {
        const auto same = alike(shared, row);
        if (section.asset.empty() || same == shared.end()) {
            own += row.text(row.by_default);
        } else {
            others.push_back(code(row.field->key) + (same->by_default == row.by_default
                                                         ? ""
                                                         : fmt::format(" ({})", row.by_default)));
        }
    }
    if (!own.empty()) text += std::string(kTableHead) + own;
    if (!others.empty()) {
        text += fmt::format("\n[{}](#{}), with defaults where they are the asset's: {}.\n",
                            kSharedTitle, anchor(kSharedTitle), fmt::join(others, ", "));
    }
    return text;
}

std::string keys_page() {
    std::string text(kKeysPageHead);
    text += units_table() + '\n' + contents();
    std::vector<KeyRow> shared = shared_rows();
    bool is_told = false;
    for (const Section& section : sections()) {
        if (!section.asset.empty() && !is_told) text += page_of_shared(shared);
        is_told = is_told || !section.asset.empty();
        text += section_of_page(section, shared);
    }
    return text;
}

TEST(KeysPage, SaysWhatTheTablesSay) {
    if (std::getenv("SKYBAKE_UPDATE_GOLDEN")) std::ofstream(kKeysPage) << keys_page();
    std::ifstream file(kKeysPage);
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(page == keys_page()) << "write it anew as keys_page_test.cpp says";
}

}  // namespace
}  // namespace skybake::config
