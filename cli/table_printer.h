// Tables of text with aligned columns, for people.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace skybake::cli {

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
