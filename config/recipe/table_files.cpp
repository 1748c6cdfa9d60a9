// Tables of densities from files: `table = "ozone.csv"`, or ["afglus.dat", "o3"] of a file with
// several columns.
//
// The first column has altitudes. Columns stand between commas, semicolons, tabs or blanks. The last
// line above the numbers names the columns with their units, as in
//
//   # z(km)  p(mb)  T(K)  air(cm-3)  o3(cm-3)
//   altitude [km], ozone [/cm3]
//
// Altitudes need a unit of length. Values have none, or one per volume, of which only ratios count.
// Rows rise or fall; lines that begin with # and empty lines do not count.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "config/fields/section_decoder.h"
#include "config/recipe/merge.h"
#include "config/recipe/recipe_sources.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

namespace fs = std::filesystem;
using LineWords = std::vector<std::string>;

struct Column {
    std::string name;
    std::string unit;
};

// A line's words between commas, semicolons and tabs, else between blanks.
LineWords words_of(std::string_view line) {
    const bool has_marks = line.find_first_of(",;\t") != std::string_view::npos;
    const std::string_view marks = has_marks ? ",;\t" : " ";
    LineWords words;
    while (true) {
        const std::size_t end = std::min(line.find_first_of(marks), line.size());
        const std::string_view word = trim(line.substr(0, end));
        if (has_marks || !word.empty()) words.emplace_back(word);
        if (end == line.size()) return words;
        line.remove_prefix(end + 1);
    }
}

std::optional<double> number_of(std::string_view word) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && end == word.data() + word.size();
    return is_number && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// "o3(cm-3)" or "ozone [/cm3]". A unit that stands apart between blanks is a word of its own.
std::vector<Column> columns_of(std::string_view line) {
    std::vector<Column> columns;
    for (const std::string& word : words_of(line)) {
        const std::size_t open = word.find_first_of("([");
        if (open != 0 || columns.empty()) {
            columns.push_back({std::string(trim(word.substr(0, open))), ""});
        }
        if (open == std::string::npos) continue;
        const std::size_t close = std::min(word.find_first_of(")]", open), word.size());
        columns.back().unit = trim(word.substr(open + 1, close - open - 1));
    }
    return columns;
}

bool is_of_dimension(std::string_view unit, Dimension dimension) {
    const std::vector<std::string_view> units = unit_spellings(dimension);
    return std::ranges::find(units, unit) != units.end();
}

// "/cm3", "kg/m3", "g m-3": what particles or grams have per volume.
bool is_per_volume(std::string_view unit) {
    const std::vector<std::string_view> units = unit_spellings(Dimension::number_density);
    return std::ranges::any_of(units,
                               [&](std::string_view known) { return unit.ends_with(known); });
}

class TableFile {
  public:
    TableFile(std::string name, const Value& asked, DiagnosticList& diagnostics)
        : name_(std::move(name)), asked_(asked), diagnostics_(diagnostics) {}

    // Returns the pairs of two columns, or nothing, which has been reported.
    std::optional<Array> pairs(std::string_view text, std::string_view column) {
        if (!read_rows(text)) return std::nullopt;
        const std::optional<std::size_t> chosen = choose(column);
        if (!chosen) return std::nullopt;
        Array pairs;
        for (const LineWords& row : rows_) {
            Value altitude{row.front() + " " + columns_.front().unit, asked_.place};
            Value density{*number_of(row[*chosen]), asked_.place};
            pairs.push_back({Array{std::move(altitude), std::move(density)}, asked_.place});
        }
        const bool falls = rows_.size() > 1 &&
                           *number_of(rows_.front().front()) > *number_of(rows_.back().front());
        if (falls) std::ranges::reverse(pairs);
        return pairs;
    }

  private:
    std::nullopt_t report(const std::string& what, std::string label) {
        diagnostics_.error("E0114", asked_.place, fmt::format("`{}` {}", name_, what),
                           std::move(label));
        return std::nullopt;
    }

    bool read_rows(std::string_view text) {
        for (int number = 1; !text.empty(); ++number) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            std::string_view line = text.substr(0, end);
            if (line.ends_with('\r')) line.remove_suffix(1);
            if (!read_line(trim(line), number)) return false;
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        if (rows_.empty()) report("has no numbers", "write an altitude and a value in each line");
        return !rows_.empty();
    }

    bool read_line(std::string_view line, int number) {
        if (line.empty()) return true;
        const bool is_comment = line.front() == '#';
        const LineWords words = words_of(line);
        const bool is_head = rows_.empty() && (is_comment || !number_of(words.front()));
        if (is_head) columns_ = columns_of(trim(line.substr(is_comment ? 1 : 0)));
        if (is_head || is_comment) return true;
        rows_.push_back(words);
        for (const std::string& word : words) {
            if (number_of(word)) continue;
            report(fmt::format("has `{}` in line {}", shorten(word), number),
                   "numbers must stand there");
            return false;
        }
        if (words.size() == rows_.front().size()) return true;
        report(fmt::format("has {} columns in line {}, and {} above", words.size(), number,
                           rows_.front().size()),
               "each line must have as many");
        return false;
    }

    // Returns the number of the column of values.
    std::optional<std::size_t> choose(std::string_view wanted) {
        if (columns_.size() != rows_.front().size() || columns_.size() < 2 ||
            !is_of_dimension(columns_.front().unit, Dimension::length)) {
            return report("does not name its columns, the first of them with a unit of length",
                          "begin it with a line such as `altitude(km), ozone(/cm3)`");
        }
        const auto column = std::find_if(columns_.begin() + 1, columns_.end(),
                                         [&](const Column& one) { return one.name == wanted; });
        const bool is_only = wanted.empty() && columns_.size() == 2;
        if (column == columns_.end() && !is_only) return report_columns(wanted);
        const Column& chosen = is_only ? columns_.back() : *column;
        if (chosen.unit.empty() || is_per_volume(chosen.unit)) {
            return static_cast<std::size_t>(&chosen - columns_.data());
        }
        return report(fmt::format("has `{}` in `{}`, which is no density", shorten(chosen.name),
                                  shorten(chosen.unit)),
                      "give a column without a unit, or in one per volume, such as /cm3");
    }

    std::nullopt_t report_columns(std::string_view wanted) {
        LineWords names;
        for (std::size_t i = 1; i < columns_.size(); ++i)
            names.push_back(shorten(columns_[i].name));
        if (wanted.empty()) {
            return report(
                "has several columns",
                fmt::format("name one: [{}, {}]", toml_string(name_), toml_string(names.back())));
        }
        return report(fmt::format("has no column `{}`", shorten(wanted)),
                      fmt::format("there are {}", fmt::join(names, ", ")));
    }

    const std::string name_;
    const Value& asked_;
    DiagnosticList& diagnostics_;
    std::vector<Column> columns_;
    std::vector<LineWords> rows_;
};

// Returns the names of file and column, or none where the value is a list of pairs, or at fault.
std::optional<std::pair<std::string, std::string>> names_in(const Value& table) {
    if (const auto* file = std::get_if<std::string>(&table.data)) return std::pair(*file, "");
    const auto* names = std::get_if<Array>(&table.data);
    if (!names || names->size() != 2) return std::nullopt;
    const auto* file = std::get_if<std::string>(&names->front().data);
    const auto* column = std::get_if<std::string>(&names->back().data);
    if (!file || !column) return std::nullopt;
    return std::pair(*file, *column);
}

// Stands for a table at fault, so that nothing is reported twice.
Array placeholder() {
    const auto pair = [](const char* altitude) {
        return Value{Array{Value{std::string(altitude), {}}, Value{1.0, {}}}, {}};
    };
    return {pair("0 km"), pair("1 km")};
}

}  // namespace

void read_table_files(Table& root, const fs::path& folder, std::vector<fs::path>& inputs,
                      DiagnosticList& diagnostics) {
    Table* atmosphere = table_at(root, "atmosphere");
    Table* layers = atmosphere ? table_at(*atmosphere, "layers") : nullptr;
    if (!layers) return;
    for (Entry& entry : *layers) {
        auto* layer = std::get_if<Table>(&entry.value.data);
        Entry* table = layer ? find_entry(*layer, "table") : nullptr;
        const auto names = table ? names_in(table->value) : std::nullopt;
        if (!names) continue;
        const fs::path path = (folder / names->first).lexically_normal();
        inputs.push_back(path);
        std::error_code error;
        const bool is_odd = fs::exists(path, error) && !fs::is_regular_file(path, error);
        auto text = is_odd ? FileError{false, "it is no ordinary file"}
                           : read_text_file(path, most_recipe_bytes);
        std::optional<Array> pairs;
        if (const auto* fault = std::get_if<FileError>(&text)) {
            diagnostics.error("E0300", table->value.place,
                              fmt::format("cannot read `{}`: {}", printable(path.string()),
                                          fault->too_large ? "it is too large" : fault->reason),
                              "");
        } else {
            TableFile file(printable(names->first), table->value, diagnostics);
            pairs = file.pairs(std::get<std::string>(text), names->second);
        }
        table->value.data = pairs ? std::move(*pairs) : placeholder();
    }
}

}  // namespace skybake::config
