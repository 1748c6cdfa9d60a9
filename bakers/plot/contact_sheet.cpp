// Arranges pictures in a grid with captions. chart.h declares the function.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/plot/chart.h"

namespace skybake {
namespace {

constexpr int gutter = 14;
constexpr int caption_line_height = 18;
constexpr int first_baseline = 17;  // below a picture
constexpr TextStyle caption_style = {13, FontWeight::regular, ink_colour};

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
        drawing.items.emplace_back(
            PlacedPicture{pictures[i], x + (sheet.cell_width - pictures[i].width) / 2,
                          y + (sheet.picture_height - pictures[i].height) / 2});
        int baseline = y + sheet.picture_height + first_baseline;
        for (const std::string& line : sheet.captions[i]) {
            drawing.write(line, x + sheet.cell_width / 2.0, baseline, TextAlign::centre,
                          caption_style);
            baseline += caption_line_height;
        }
    }
    return painted(on_dark_paper(std::move(drawing)));
}

}  // namespace skybake
