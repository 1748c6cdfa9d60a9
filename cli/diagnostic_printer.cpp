#include "cli/diagnostic_printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cli/events.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

// --- Words that the formats share ---------------------------------------------------------------

// Returns a place as far as it is known, such as "earth.toml:14:1".
std::string place(const config::SourceRange& where) {
    if (where.line == 0) return where.source;
    if (where.column == 0) return fmt::format("{}:{}", where.source, where.line);
    return fmt::format("{}:{}:{}", where.source, where.line, where.column);
}

// --- For people ---------------------------------------------------------------------------------

// These are ANSI colours, or empty texts.
struct Palette {
    std::string_view error, warning, gutter, bold, off;
};
constexpr Palette plain;
constexpr Palette colored = {"\x1b[1;31m", "\x1b[1;33m", "\x1b[1;34m", "\x1b[1m", "\x1b[0m"};

// This is one character of a line as it is shown, and the columns that it takes.
struct Cell {
    std::string_view text;
    int width;
};

// Splits a line into characters. Tabs become spaces, and characters that would control the terminal
// become U+FFFD.
std::vector<Cell> cells_of(std::string_view line) {
    constexpr std::string_view tab = "    ";
    constexpr std::string_view not_shown = "\xEF\xBF\xBD";
    std::vector<Cell> cells;
    for (std::size_t position = 0; position < line.size();) {
        const std::size_t start = position;
        const std::uint32_t code_point = next_code_point(line, position);
        const bool control = code_point < 0x20 || (code_point >= 0x7F && code_point < 0xA0);
        if (code_point == '\t') {
            cells.push_back({tab, static_cast<int>(tab.size())});
        } else if (control || code_point == 0xFFFD) {
            cells.push_back({not_shown, 1});
        } else {
            cells.push_back({line.substr(start, position - start), code_point_width(code_point)});
        }
    }
    return cells;
}

// This is a piece of a line with a range to underline, both ready to print.
struct Excerpt {
    std::string text;
    int indent = 0;     // columns before the range
    int underline = 0;  // columns of the range, at least 1
};

// Crops a long line to a window that shows the beginning of the range.
Excerpt excerpt(const config::SourceRange& where) {
    constexpr int window = 100;
    constexpr int before = 30;  // columns kept before the range
    const std::vector<Cell> cells = cells_of(where.line_text);
    const std::size_t range_begin =
        std::min(static_cast<std::size_t>(std::max(where.column - 1, 0)), cells.size());
    const std::size_t range_end =
        std::min(range_begin + static_cast<std::size_t>(std::max(where.length, 1)), cells.size());

    std::size_t begin = range_begin;
    for (int columns = 0; begin > 0 && columns < before; --begin) columns += cells[begin - 1].width;
    int total = 0;
    for (const Cell& cell : cells) total += cell.width;
    if (total <= window) begin = 0;

    Excerpt result;
    int columns = 0;
    if (begin > 0) {
        result.text = "…";
        columns = 1;
    }
    std::size_t i = begin;
    for (; i < cells.size() && columns + cells[i].width <= window; ++i) {
        if (i == range_begin) result.indent = columns;
        if (i >= range_begin && i < range_end) result.underline += cells[i].width;
        result.text += cells[i].text;
        columns += cells[i].width;
    }
    if (i < cells.size()) result.text += "…";
    if (range_begin >= cells.size())
        result.indent = columns;  // past the end: something is missing there
    result.underline = std::max(result.underline, 1);
    return result;
}

std::string human_line(const Diagnostic& diagnostic, const Palette& palette) {
    const Excerpt shown = excerpt(diagnostic.where);
    const std::string number = fmt::format("{}", diagnostic.where.line);
    const std::string blank(number.size(), ' ');
    const std::string_view tone =
        diagnostic.severity == Severity::error ? palette.error : palette.warning;
    const std::string bar = fmt::format("{} |{}", palette.gutter, palette.off);
    std::string carets = std::string(static_cast<std::size_t>(shown.indent), ' ');
    carets +=
        fmt::format("{}{}{}{}{}", tone, std::string(static_cast<std::size_t>(shown.underline), '^'),
                    diagnostic.label.empty() ? "" : " ", diagnostic.label, palette.off);
    return fmt::format("{}{}\n{}{}{} {}\n{}{} {}\n", blank, bar, palette.gutter, number, bar,
                       shown.text, blank, bar, carets);
}

std::string human_one(const Diagnostic& diagnostic, const Palette& palette) {
    const std::string_view tone =
        diagnostic.severity == Severity::error ? palette.error : palette.warning;
    std::string text =
        fmt::format("{}{}[{}]{}{}: {}{}\n", tone, severity_word(diagnostic), diagnostic.code,
                    palette.off, palette.bold, diagnostic.message, palette.off);
    const config::SourceRange& where = diagnostic.where;
    if (!where.source.empty()) {
        text += fmt::format("{} -->{} {}\n", palette.gutter, palette.off, place(where));
    }
    if (where.line > 0 && where.column > 0 && !where.line_text.empty()) {
        text += human_line(diagnostic, palette);
    } else if (!diagnostic.label.empty()) {
        text += fmt::format("{}  ={} {}\n", palette.gutter, palette.off, diagnostic.label);
    }
    return text;
}

// Returns "3 errors, 1 warning".
std::string count_line(std::span<const Diagnostic> diagnostics) {
    const auto errors = static_cast<std::size_t>(std::ranges::count_if(
        diagnostics,
        [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; }));
    const std::size_t warnings = diagnostics.size() - errors;
    if (warnings == 0) return counted(errors, "error") + "\n";
    if (errors == 0) return counted(warnings, "warning") + "\n";
    return fmt::format("{}, {}\n", counted(errors, "error"), counted(warnings, "warning"));
}

std::string print_human(std::span<const Diagnostic> diagnostics, const Palette& palette) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += human_one(diagnostic, palette);
    // A single diagnostic about the command line needs no count.
    const bool alone = diagnostics.size() == 1 && diagnostics[0].where.source.empty();
    return diagnostics.empty() || alone ? text : text + count_line(diagnostics);
}

// --- Short --------------------------------------------------------------------------------------

std::string print_short(std::span<const Diagnostic> diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        const std::string where = place(diagnostic.where);
        text += fmt::format("{}{}{}[{}]: {}", where, where.empty() ? "" : ": ",
                            severity_word(diagnostic), diagnostic.code, diagnostic.message);
        if (!diagnostic.label.empty()) text += fmt::format("; {}", diagnostic.label);
        text += '\n';
    }
    return text;
}

// --- GitHub -------------------------------------------------------------------------------------

// Escapes % and line ends, and in properties also the characters that end a property
// (docs.github.com, "Workflow commands for GitHub Actions").
std::string github_escaped(std::string_view text, bool property) {
    std::string result;
    for (const char sign : text) {
        const bool ends_property = property && (sign == ':' || sign == ',');
        if (sign == '%' || sign == '\r' || sign == '\n' || ends_property) {
            result +=
                fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(sign)));
        } else {
            result += sign;
        }
    }
    return result;
}

// Returns the properties that place an annotation in a file, or nothing if the source is not a
// file.
std::string github_place(const config::SourceRange& where) {
    if (!is_file(where.source)) return "";
    std::string text = fmt::format("file={},", github_escaped(where.source, true));
    if (where.line > 0) text += fmt::format("line={},", where.line);
    if (where.column > 0) {
        text += fmt::format("col={},endColumn={},", where.column,
                            std::int64_t{where.column} + std::max(where.length, 1));
    }
    return text;
}

std::string print_github(std::span<const Diagnostic> diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) {
        text += fmt::format("::{} {}title={}::{}", severity_word(diagnostic),
                            github_place(diagnostic.where), diagnostic.code,
                            github_escaped(diagnostic.message, false));
        if (!diagnostic.where.source.empty() && !is_file(diagnostic.where.source)) {
            text += fmt::format(" ({})", github_escaped(place(diagnostic.where), false));
        }
        if (!diagnostic.label.empty()) {
            text += fmt::format("; {}", github_escaped(diagnostic.label, false));
        }
        text += '\n';
    }
    return text;
}

}  // namespace

std::string_view severity_word(const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::error ? "error" : "warning";
}

std::string print_diagnostics(std::span<const Diagnostic> diagnostics, DiagnosticFormat format,
                              bool color) {
    switch (format) {
        case DiagnosticFormat::human:
            return print_human(diagnostics, color ? colored : plain);
        case DiagnosticFormat::short_:
            return print_short(diagnostics);
        case DiagnosticFormat::json:
            return print_json_lines(diagnostics);
        case DiagnosticFormat::github:
            return print_github(diagnostics);
        case DiagnosticFormat::sarif:
            return print_sarif(diagnostics);
    }
    return {};
}

}  // namespace skybake::cli
