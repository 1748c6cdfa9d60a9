#include "cli/text_width.h"

#include <array>

namespace skybake::cli {
namespace {

constexpr std::uint32_t replacement_character = 0xFFFD;

struct CodePointRange {
    std::uint32_t first;
    std::uint32_t last;
};

// Marks that are drawn onto the sign before them, and signs that are not drawn (Unicode 15 blocks).
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

// East Asian Width W and F, by blocks.
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

// How many bytes a sign with this first byte has; 0 for a byte that cannot be a first one.
int encoded_length(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return 2;
    if (first >= 0xE0 && first <= 0xEF) return 3;
    if (first >= 0xF0 && first <= 0xF4) return 4;
    return 0;
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

}  // namespace skybake::cli
