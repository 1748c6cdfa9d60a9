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

// The first signs of a text and "…", in that many columns.
std::string shortened(const std::string& text, std::size_t columns) {
    if (columns_of(text) <= columns) return text;
    std::size_t end = 0;
    std::size_t used = 1;  // the sign of omission
    for (std::size_t position = 0; position < text.size(); end = position) {
        const auto code_point = next_code_point(text, position);
        used += static_cast<std::size_t>(code_point_width(code_point));
        if (used > columns) break;
    }
    return text.substr(0, end) + "…";
}

}  // namespace

int TextTable::width() const {
    std::size_t total = static_cast<std::size_t>(indent_);
    const std::vector<std::size_t> widths = column_widths(rows_);
    for (std::size_t i = 0; i < widths.size(); ++i) total += widths[i] + (i > 0 ? gap : 0);
    return static_cast<int>(total);
}

void TextTable::drop_column(std::size_t column) {
    for (auto& row : rows_) {
        if (column < row.size()) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
    if (column < columns_.size()) {
        columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(column));
    }
}

// Takes signs from the widest of these columns. False where none may lose one.
bool TextTable::shorten_widest(std::span<const std::size_t> columns, int excess) {
    constexpr std::size_t least = 8;
    const std::vector<std::size_t> widths = column_widths(rows_);
    std::size_t widest = widths.size();
    for (const std::size_t column : columns) {
        if (column >= widths.size() || widths[column] <= least) continue;
        if (widest == widths.size() || widths[column] > widths[widest]) widest = column;
    }
    if (widest == widths.size()) return false;
    const std::size_t wanted =
        widths[widest] - std::min(static_cast<std::size_t>(excess), widths[widest] - least);
    for (auto& row : rows_) {
        if (widest < row.size()) row[widest] = shortened(row[widest], wanted);
    }
    return true;
}

std::string TextTable::text_within(int terminal_columns, std::span<const std::size_t> expendable,
                                   std::span<const std::size_t> shrinkable) const {
    if (terminal_columns <= 0) return text();
    TextTable table = *this;
    std::vector<std::size_t> shrinking(shrinkable.begin(), shrinkable.end());
    std::vector<std::size_t> dropped;
    const auto position = [&dropped](std::size_t column) {
        const auto before = std::count_if(dropped.begin(), dropped.end(),
                                          [column](std::size_t other) { return other < column; });
        return column - static_cast<std::size_t>(before);
    };
    for (const std::size_t column : expendable) {
        if (table.width() <= terminal_columns) break;
        table.drop_column(position(column));
        dropped.push_back(column);
    }
    for (std::size_t& column : shrinking) column = position(column);
    while (table.width() > terminal_columns) {
        if (!table.shorten_widest(shrinking, table.width() - terminal_columns)) break;
    }
    return table.text();
}

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
