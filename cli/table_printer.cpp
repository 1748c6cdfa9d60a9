#include "cli/table_printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace skybake::cli {
namespace {

constexpr std::uint32_t replacement_character = 0xFFFD;

struct CodePointRange {
    std::uint32_t first;
    std::uint32_t last;
};

// These are marks that are drawn onto the character before them, and characters that are not drawn
// (Unicode 15 blocks).
constexpr std::array<CodePointRange, 9> zero_width = {{
    {0x0300, 0x036F},
    {0x0483, 0x0489},
    {0x0591, 0x05BD},
    {0x1AB0, 0x1AFF},
    {0x1DC0, 0x1DFF},
    {0x200B, 0x200F},
    {0x20D0, 0x20FF},
    {0xFE00, 0xFE0F},
    {0xFE20, 0xFE2F},
}};

// These blocks have East Asian Width W or F.
constexpr std::array<CodePointRange, 10> double_width = {{
    {0x1100, 0x115F},
    {0x2E80, 0x303E},
    {0x3041, 0xA4CF},
    {0xAC00, 0xD7A3},
    {0xF900, 0xFAFF},
    {0xFE30, 0xFE6F},
    {0xFF00, 0xFF60},
    {0xFFE0, 0xFFE6},
    {0x1F300, 0x1FAFF},
    {0x20000, 0x3FFFD},
}};

template <std::size_t count>
bool contains(const std::array<CodePointRange, count>& ranges, std::uint32_t code_point) {
    for (const CodePointRange& range : ranges) {
        if (code_point >= range.first && code_point <= range.last) return true;
    }
    return false;
}

// Returns how many bytes a character with this first byte has, or 0 if the byte cannot be a first
// one.
int encoded_length(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return 2;
    if (first >= 0xE0 && first <= 0xEF) return 3;
    if (first >= 0xF0 && first <= 0xF4) return 4;
    return 0;
}

constexpr std::size_t gap = 2;

std::size_t columns_of(const std::string& cell) {
    return static_cast<std::size_t>(text_width(cell));
}

// Returns the first characters of a text and "…", in that many columns.
std::string shortened(const std::string& text, std::size_t columns) {
    if (columns_of(text) <= columns) return text;
    std::size_t end = 0;
    std::size_t used = 1;  // for the "…"
    for (std::size_t position = 0; position < text.size(); end = position) {
        const auto code_point = next_code_point(text, position);
        used += static_cast<std::size_t>(code_point_width(code_point));
        if (used > columns) break;
    }
    return text.substr(0, end) + "…";
}

}  // namespace

std::uint32_t next_code_point(std::string_view text, std::size_t& position) {
    const auto first = static_cast<unsigned char>(text[position]);
    const int length = encoded_length(first);
    if (length == 1) {
        ++position;
        return first;
    }
    const std::size_t end = position + static_cast<std::size_t>(length);
    if (length == 0 || end > text.size()) {
        ++position;
        return replacement_character;
    }
    std::uint32_t code_point = first & (0x7Fu >> length);
    for (std::size_t i = position + 1; i < end; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0) != 0x80) {
            ++position;
            return replacement_character;
        }
        code_point = code_point << 6 | (byte & 0x3Fu);
    }
    position = end;
    return code_point;
}

int code_point_width(std::uint32_t code_point) {
    if (contains(zero_width, code_point)) return 0;
    return contains(double_width, code_point) ? 2 : 1;
}

int text_width(std::string_view text) {
    int width = 0;
    for (std::size_t position = 0; position < text.size();) {
        width += code_point_width(next_code_point(text, position));
    }
    return width;
}

std::string time_text(double seconds) {
    if (seconds >= 999.5) return fmt::format("{:.0f} s", seconds);
    if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
    const double ms = seconds * 1e3;
    return ms < 9.95 ? fmt::format("{:.2g} ms", ms) : fmt::format("{:.0f} ms", ms);
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

// Returns 0 for a column that was dropped.
std::vector<std::size_t> TextTable::column_widths() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!dropped_.contains(i)) widths[i] = std::max(widths[i], columns_of(row[i]));
        }
    }
    return widths;
}

int TextTable::width() const {
    const std::vector<std::size_t> widths = column_widths();
    std::size_t total = static_cast<std::size_t>(indent_);
    std::size_t before = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        if (!dropped_.contains(i)) total += std::exchange(before, gap) + widths[i];
    }
    return static_cast<int>(total);
}

void TextTable::drop_if_empty(std::size_t column) {
    const auto has_text = [column](const std::vector<std::string>& row) {
        return column < row.size() && !row[column].empty();
    };
    if (std::ranges::count_if(rows_, has_text) <= 1) dropped_.insert(column);
}

// Takes characters from the widest of these columns. Returns false if none of them may lose one.
bool TextTable::shorten_widest(std::span<const std::size_t> columns, int excess) {
    constexpr std::size_t least = 8;
    const std::vector<std::size_t> widths = column_widths();
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
    for (const std::size_t column : expendable) {
        if (table.width() <= terminal_columns) break;
        table.dropped_.insert(column);
    }
    while (table.width() > terminal_columns) {
        if (!table.shorten_widest(shrinkable, table.width() - terminal_columns)) break;
    }
    return table.text();
}

std::string TextTable::text() const {
    const std::vector<std::size_t> widths = column_widths();
    std::string text;
    for (const auto& row : rows_) {
        std::string line(static_cast<std::size_t>(indent_), ' ');
        std::size_t before = 0;  // blanks
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (dropped_.contains(i)) continue;
            const std::string padding(widths[i] - columns_of(row[i]), ' ');
            const bool right = i < columns_.size() && columns_[i] == Align::right;
            line.append(std::exchange(before, gap), ' ');
            line += right ? padding + row[i] : row[i] + padding;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

}  // namespace skybake::cli
