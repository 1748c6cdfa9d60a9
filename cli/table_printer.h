// This header prints tables of text with aligned columns, for people, and measures how wide UTF-8
// text is in a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::cli {

// Returns the code point at `position` and moves `position` behind it. A byte that is not UTF-8
// counts as U+FFFD.
std::uint32_t next_code_point(std::string_view text, std::size_t& position);

// Returns the columns of one code point: 0 for combining marks, 2 for wide East Asian characters
// and emoji, else 1.
int code_point_width(std::uint32_t code_point);

// Returns the columns of a text without tabs and newlines.
int text_width(std::string_view text);

// Spells a time with two or three digits: "2.3 ms", "48 ms", "1.25 s", "250 s".
std::string time_text(double seconds);

// Spells a number of things: "1 asset", "2 assets".
std::string counted(std::size_t count, std::string_view noun);

enum class Align { left, right };

// A table consists of rows of cells. The first row is the heading if there is one. Rows may have
// different lengths. Each line starts with `indent` spaces, columns are two spaces apart, and no
// line ends in spaces. Widths are those of a terminal: "µ" and "²" take one column.
class TextTable {
  public:
    explicit TextTable(std::vector<Align> columns = {}, int indent = 2)
        : columns_(std::move(columns)), indent_(indent) {}
    void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    // Drops a column in which only the heading has a text. The numbers of others stay.
    void drop_if_empty(std::size_t column);
    std::string text() const;

    // Returns the text for a terminal with that many columns; 0 means no limit. A table that is too
    // wide loses the columns listed in `expendable`, in that order. Then the texts in the columns
    // listed in `shrinkable` lose their ends, the widest column first, down to eight characters
    // each.
    std::string text_within(int terminal_columns, std::span<const std::size_t> expendable,
                            std::span<const std::size_t> shrinkable) const;

  private:
    std::vector<std::size_t> column_widths() const;
    int width() const;
    bool shorten_widest(std::span<const std::size_t> columns, int excess);

    std::vector<Align> columns_;  // columns beyond these are aligned left
    int indent_;
    std::vector<std::vector<std::string>> rows_;
    std::set<std::size_t> dropped_;  // columns
};

}  // namespace skybake::cli
