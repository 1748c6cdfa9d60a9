// Tables of text with aligned columns, for people, and how wide UTF-8 text is in a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::cli {

// The code point at `position`, which moves behind it. A byte that is not UTF-8 counts as U+FFFD.
std::uint32_t next_code_point(std::string_view text, std::size_t& position);

// Columns of one code point: 0 for combining marks, 2 for wide East Asian signs and emoji, else 1.
int code_point_width(std::uint32_t code_point);

// Columns of a text without tabs and newlines.
int text_width(std::string_view text);

enum class Align { left, right };

// Rows of cells, the first row being the heading if there is one; rows may be of different length.
// Each line starts with `indent` spaces, columns are two spaces apart, and no line ends in spaces.
// Widths are those of a terminal: "µ" and "²" take one column.
class TextTable {
  public:
    explicit TextTable(std::vector<Align> columns = {}, int indent = 2)
        : columns_(std::move(columns)), indent_(indent) {}
    void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    bool empty() const { return rows_.empty(); }
    std::string text() const;

    // The same for a terminal of that many columns, 0 being any number of them. A table that is too
    // wide loses the columns that are `expendable`, the first of them first; then the texts of
    // those that are `shrinkable` lose their ends, the longest first, down to eight signs each.
    std::string text_within(int terminal_columns, std::span<const std::size_t> expendable,
                            std::span<const std::size_t> shrinkable) const;

  private:
    int width() const;
    void drop_column(std::size_t column);
    bool shorten_widest(std::span<const std::size_t> columns, int excess);

    std::vector<Align> columns_;  // columns beyond these are left
    int indent_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace skybake::cli
