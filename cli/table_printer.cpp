#include "cli/table_printer.h"

#include <algorithm>

#include "cli/text_width.h"

namespace skybake::cli {
namespace {

constexpr std::size_t gap = 2;

std::size_t columns_of(const std::string& cell) {
    return static_cast<std::size_t>(text_width(cell));
}

std::vector<std::size_t> column_widths(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], columns_of(row[i]));
        }
    }
    return widths;
}

}  // namespace

std::string TextTable::text() const {
    const std::vector<std::size_t> widths = column_widths(rows_);
    std::string text;
    for (const auto& row : rows_) {
        std::string line(static_cast<std::size_t>(indent_), ' ');
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string padding(widths[i] - columns_of(row[i]), ' ');
            const bool right = i < columns_.size() && columns_[i] == Align::right;
            if (i > 0) line.append(gap, ' ');
            line += right ? padding + row[i] : row[i] + padding;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

}  // namespace skybake::cli
