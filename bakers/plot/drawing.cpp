#include "bakers/plot/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/load_module.h"
#include "bakers/io/formats/png/map_image.h"
#include "config/text/text.h"

namespace skybake {
namespace {

// --- The module ---------------------------------------------------------------------------------

const LoadedCodec<ChartModule>& chart_module() {
    static const auto loaded = load_codec<ChartModule>(chart_module_name, chart_module_symbol);
    return loaded;
}

// --- SVG ----------------------------------------------------------------------------------------

// Escapes a text for XML elements, attributes and comments.
std::string escaped(std::string_view text) {
    std::string result = config::replaced(
        text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&apos;"}});
    // XML allows no other control characters.
    for (char& letter : result) {
        if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
    }
    return result;
}

// Returns the SVG of the tooltips: invisible discs with a title.
std::string tooltips_of(const Drawing& drawing) {
    constexpr double radius = 8;
    std::string text;
    for (const Tooltip& tooltip : drawing.tooltips) {
        text += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" "
            "fill-opacity=\"0\"><title>{}</title></circle>\n",
            tooltip.centre.x, tooltip.centre.y, radius, escaped(tooltip.text));
    }
    return text;
}

void darken(Colour& colour) {
    constexpr std::array<std::array<Colour, 2>, 4> pairs = {
        {{ink_colour, dark_ink_colour},
         {pale_ink_colour, dark_pale_ink_colour},
         {grid_colour, dark_grid_colour},
         {paper_colour, dark_paper_colour}}};
    const auto pair =
        std::ranges::find_if(pairs, [&](const auto& one) { return one[0] == colour; });
    if (pair != pairs.end()) colour = (*pair)[1];
}

}  // namespace

// --- Drawings -----------------------------------------------------------------------------------

void Drawing::fill(int x, int y, int w, int h, Colour colour) {
    const double left = x, top = y, right = x + w, bottom = y + h;
    Shape shape;
    shape.points = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
    shape.closed = true;
    shape.fill = colour;
    items.emplace_back(std::move(shape));
}

void Drawing::line(std::vector<DrawingPoint> points, double line_width, Colour colour) {
    Shape shape;
    shape.points = std::move(points);
    shape.stroke = colour;
    shape.stroke_width = line_width;
    items.emplace_back(std::move(shape));
}

void Drawing::write(std::string_view text, double x, double baseline, TextAlign align,
                    const TextStyle& style) {
    if (text.empty()) return;
    items.emplace_back(TextLine{std::string(text), {x, baseline}, align, style, false});
}

void Drawing::write_upwards(std::string_view text, double baseline, double y,
                            const TextStyle& style) {
    if (text.empty()) return;
    items.emplace_back(TextLine{std::string(text), {baseline, y}, TextAlign::centre, style, true});
}

double text_width(std::string_view text, const TextStyle& style) {
    const ChartModule* const functions = chart_module().codec;
    if (functions == nullptr || text.empty()) return 0;
    // Widths are kept in a memo, because pages repeat their labels and measuring takes longer than
    // a lookup in a map.
    using Key = std::tuple<std::string, int, FontWeight>;
    static std::mutex mutex;
    static std::map<Key, double> widths;
    const std::lock_guard lock(mutex);
    const auto [found, fresh] =
        widths.try_emplace(Key(std::string(text), style.em_pixels, style.weight), 0);
    if (fresh) found->second = functions->text_width(text, style);
    return found->second;
}

Picture painted(const Drawing& drawing) {
    if (drawing.width <= 0 || drawing.height <= 0) return {};
    const ChartModule* const functions = chart_module().codec;
    if (functions != nullptr) return functions->paint(drawing);
    Picture blank(drawing.width, drawing.height);
    std::ranges::fill(blank.rgb, paper_colour[0]);
    return blank;
}

Drawing on_dark_paper(Drawing drawing) {
    for (DrawingItem& item : drawing.items) {
        if (Shape* shape = std::get_if<Shape>(&item)) {
            if (shape->fill) darken(*shape->fill);
            darken(shape->stroke);
        } else if (TextLine* text = std::get_if<TextLine>(&item)) {
            darken(text->style.colour);
        }
    }
    drawing.fill(0, 0, drawing.width, drawing.height, dark_paper_colour);
    std::ranges::rotate(drawing.items, drawing.items.end() - 1);  // below all others
    return drawing;
}

std::string svg_of(const Drawing& drawing, std::string_view comment) {
    const ChartModule* const functions = chart_module().codec;
    if (functions == nullptr) return "";
    const std::string text = functions->svg(drawing);
    const std::size_t declared = text.find('\n') + 1;
    const std::size_t opened = text.find('\n', declared) + 1;  // behind <svg ...>
    const std::size_t closed = text.rfind("</svg>");
    return fmt::format("{}<!-- {} -->\n{}<title>{}</title>\n{}{}{}", text.substr(0, declared),
                       comment, text.substr(declared, opened - declared), escaped(drawing.title),
                       text.substr(opened, closed - opened), tooltips_of(drawing),
                       text.substr(closed));
}

std::optional<Diagnostic> chart_problem() {
    const LoadedCodec<ChartModule>& loaded = chart_module();
    if (loaded.codec == nullptr) {
        return file_error("E0300", "", "cannot draw charts: " + loaded.reason);
    }
    if (loaded.codec->has_font()) return std::nullopt;
    return diagnosis("W0302", "charts have no text: the font DejaVu Sans is not installed");
}

Outcome<std::string> png_bytes(const Picture& picture) {
    const LoadedCodec<ImageCodec>& loaded = image_codec();
    if (loaded.codec == nullptr) {
        return file_error("E0300", "", "cannot write pictures: " + loaded.reason);
    }
    EncodedPicture png = loaded.codec->encode_png(picture.width, picture.height, picture.rgb);
    if (!png.problem.empty()) {
        return file_error("E0500", "", "cannot write a picture: " + png.problem);
    }
    return {std::move(png.bytes), {}};
}

}  // namespace skybake
