// Arranges pictures in a grid, with captions or with the names of rows and columns. chart.h declares
// the functions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/plot/chart.h"
#include "bakers/plot/chart_points.h"

namespace skybake {
namespace {

constexpr int gutter = 14;
constexpr int caption_line_height = 18;
constexpr int first_baseline = 17;  // below a picture
constexpr TextStyle caption_style = {13, FontWeight::regular, ink_colour};
constexpr TextStyle block_title_style = {14, FontWeight::bold, ink_colour};
constexpr int widest_row_name = 150;

// Breaks the caption at spaces so that each line fits. A word that does not fit gets its own line.
std::vector<std::string> broken_into_lines(const std::string& caption, int width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t begin = 0; begin < caption.size();) {
        const std::size_t end = std::min(caption.find(' ', begin), caption.size());
        const std::string word = caption.substr(begin, end - begin);
        begin = end + 1;
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && text_width(longer, caption_style) > width) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

void write_lines(Drawing& drawing, const std::vector<std::string>& lines, DrawingPoint first,
                 TextAlign align) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto down = static_cast<double>(i) * caption_line_height;
        drawing.write(lines[i], first.x, first.y + down, align, caption_style);
    }
}

// Places a picture into the middle of a cell.
void place(Drawing& drawing, const Picture& picture, const PlotArea& cell) {
    drawing.items.emplace_back(PlacedPicture{picture, cell.x + (cell.width - picture.width) / 2,
                                             cell.y + (cell.height - picture.height) / 2});
}

// The layout of a sheet of equal cells.
struct Sheet {
    int columns = 1;
    int cell_width = 0;
    int picture_height = 0;
    std::vector<std::vector<std::string>> captions;
    std::vector<int> row_tops;
    int height = gutter;
};

Sheet lay_out(const std::vector<Picture>& pictures, const std::vector<std::string>& captions,
              int columns) {
    Sheet sheet;
    const int count = static_cast<int>(pictures.size());
    sheet.columns = std::clamp(columns, 1, std::max(count, 1));
    for (const Picture& picture : pictures) {
        sheet.cell_width = std::max(sheet.cell_width, picture.width);
        sheet.picture_height = std::max(sheet.picture_height, picture.height);
    }
    std::size_t most_lines = 0;  // of the row that is being laid out
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        const std::string caption = index < captions.size() ? captions[index] : "";
        sheet.captions.push_back(broken_into_lines(caption, sheet.cell_width));
        most_lines = std::max(most_lines, sheet.captions.back().size());
        if (i % sheet.columns == 0) sheet.row_tops.push_back(sheet.height);
        if ((i + 1) % sheet.columns != 0 && i + 1 != count) continue;
        const int lines = static_cast<int>(std::exchange(most_lines, 0));
        const int caption_height = lines == 0 ? 0 : lines * caption_line_height + 6;
        sheet.height += sheet.picture_height + caption_height + gutter;
    }
    return sheet;
}

// The layout of all blocks of a sheet.
struct BlockGrid {
    PlotArea first_cell;  // its place across, and its size
    int columns = 0;
    int names_width = 0;  // of rows
    int width = 0;        // of the sheet
};

BlockGrid lay_out(const std::vector<SheetBlock>& blocks) {
    BlockGrid grid;
    double names_width = 0;
    for (const SheetBlock& block : blocks) {
        grid.columns = std::max(grid.columns, static_cast<int>(block.columns.size()));
        for (const Picture& picture : block.pictures) {
            grid.first_cell.width = std::max(grid.first_cell.width, picture.width);
            grid.first_cell.height = std::max(grid.first_cell.height, picture.height);
        }
        for (const std::string& name : block.rows) {
            for (const std::string& line : broken_into_lines(name, widest_row_name)) {
                names_width = std::max(names_width, text_width(line, caption_style));
            }
        }
    }
    grid.names_width = static_cast<int>(std::ceil(names_width));
    grid.first_cell.x = gutter + (names_width > 0 ? grid.names_width + gutter : 0);
    grid.width = grid.first_cell.x + grid.columns * (grid.first_cell.width + gutter);
    for (const SheetBlock& block : blocks) {
        const double title = std::ceil(text_width(block.title, block_title_style));
        grid.width = std::max(grid.width, grid.first_cell.x + static_cast<int>(title) + gutter);
    }
    return grid;
}

// Writes the names of a block's columns below `y`. Returns the place of the pictures below them.
int draw_column_names(Drawing& drawing, const SheetBlock& block, const PlotArea& cell, int y) {
    std::size_t most_lines = 0;
    for (std::size_t i = 0; i < block.columns.size(); ++i) {
        const auto lines = broken_into_lines(block.columns[i], cell.width);
        const int x = cell.x + static_cast<int>(i) * (cell.width + gutter) + cell.width / 2;
        write_lines(drawing, lines, {double(x), double(y + caption_line_height - 5)},
                    TextAlign::centre);
        most_lines = std::max(most_lines, lines.size());
    }
    return y + static_cast<int>(most_lines) * caption_line_height + 2;
}

// Draws a block below `y`. Returns the place below it.
int draw_block(Drawing& drawing, const SheetBlock& block, const BlockGrid& grid, int y) {
    if (!block.title.empty()) {
        drawing.write(block.title, grid.first_cell.x, y + first_baseline, TextAlign::left,
                      block_title_style);
        y += first_baseline + gutter;
    }
    PlotArea cell = grid.first_cell;
    cell.y = draw_column_names(drawing, block, cell, y);
    for (std::size_t row = 0; row < block.rows.size(); ++row) {
        const auto name = broken_into_lines(block.rows[row], widest_row_name);
        const int height = static_cast<int>(name.size()) * caption_line_height;
        write_lines(drawing, name,
                    {double(gutter + grid.names_width),
                     cell.y + (cell.height - height) / 2.0 + caption_line_height - 5},
                    TextAlign::right);
        for (std::size_t column = 0; column < block.columns.size(); ++column) {
            cell.x = grid.first_cell.x + static_cast<int>(column) * (cell.width + gutter);
            place(drawing, block.pictures[row * block.columns.size() + column], cell);
        }
        cell.y += cell.height + gutter;
    }
    return cell.y;
}

}  // namespace

Picture contact_sheet(const std::vector<Picture>& pictures,
                      const std::vector<std::string>& captions, int columns) {
    const Sheet sheet = lay_out(pictures, captions, columns);
    Drawing drawing;
    drawing.width = gutter + sheet.columns * (sheet.cell_width + gutter);
    drawing.height = sheet.height;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int index = static_cast<int>(i);
        const int x = gutter + index % sheet.columns * (sheet.cell_width + gutter);
        const int y = sheet.row_tops[static_cast<std::size_t>(index / sheet.columns)];
        place(drawing, pictures[i], {x, y, sheet.cell_width, sheet.picture_height});
        write_lines(drawing, sheet.captions[i],
                    {x + sheet.cell_width / 2.0, double(y + sheet.picture_height + first_baseline)},
                    TextAlign::centre);
    }
    return painted(on_dark_paper(std::move(drawing)));
}

Picture contact_sheet(const std::vector<SheetBlock>& blocks) {
    const BlockGrid grid = lay_out(blocks);
    Drawing drawing;
    drawing.width = grid.width;
    drawing.height = gutter;
    for (const SheetBlock& block : blocks) {
        drawing.height = draw_block(drawing, block, grid, drawing.height);
    }
    return painted(on_dark_paper(std::move(drawing)));
}

}  // namespace skybake
