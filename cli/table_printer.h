// Tables of text with aligned columns, for people.
#pragma once

#include <string>
#include <vector>

namespace skybake::cli {

enum class Align { left, right };

// Rows of cells, the first row being the heading if there is one; ragged rows are allowed. Each
// line starts with `indent` spaces, columns stand two spaces apart, and no line ends in spaces.
// Widths are those of a terminal: "µ" and "²" take one column.
class TextTable {
  public:
    explicit TextTable(std::vector<Align> columns = {}, int indent = 2)
        : columns_(std::move(columns)), indent_(indent) {}
    void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    bool empty() const { return rows_.empty(); }
    std::string text() const;

  private:
    std::vector<Align> columns_;  // columns beyond these are left
    int indent_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace skybake::cli
