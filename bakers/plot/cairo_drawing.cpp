// The module skybake_charts: draws by Cairo, with text by Pango.
#include <cairo-svg.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>

#include "bakers/plot/drawing.h"

namespace skybake {
namespace {

// Frees an object of a C library.
template <auto Free>
struct Freed {
    template <class T>
    void operator()(T* object) const {
        Free(object);
    }
};
template <class T, auto Free>
using Owned = std::unique_ptr<T, Freed<Free>>;

using Surface = Owned<cairo_surface_t, cairo_surface_destroy>;
using Context = Owned<cairo_t, cairo_destroy>;
using Layout = Owned<PangoLayout, g_object_unref>;
using Text = Owned<char, g_free>;

// --- Text ---------------------------------------------------------------------------------------

// The folders where Debian, Fedora and Arch keep the font.
constexpr std::array<const char*, 3> font_folders = {"/usr/share/fonts/truetype/dejavu",
                                                     "/usr/share/fonts/dejavu-sans-fonts",
                                                     "/usr/share/fonts/TTF"};

// Makes DejaVu Sans the only font that fontconfig knows. Then nothing depends on the machine's
// configuration, and fontconfig does not look for a cache in a home folder, which accounts on
// render farms do not have. Returns false if the font is missing.
bool load_font() {
    FcConfig* const config = FcConfigCreate();
    int found = 0;
    for (const char* const file : {"DejaVuSans.ttf", "DejaVuSans-Bold.ttf"}) {
        for (const char* const folder : font_folders) {
            const std::filesystem::path path = std::filesystem::path(folder) / file;
            std::error_code error;
            if (!std::filesystem::exists(path, error)) continue;
            const auto* const name = reinterpret_cast<const FcChar8*>(path.c_str());
            found += FcConfigAppFontAddFile(config, name) != FcFalse ? 1 : 0;
            break;
        }
    }
    return FcConfigSetCurrent(config) != FcFalse && found == 2;
}

bool has_font() {
    static const bool loaded = load_font();
    return loaded;
}

// In pictures, letters are aligned to whole rows of pixels (`hinted`); in files, they have the
// font's exact outlines. In both, they are spaced by fractions of pixels.
void set_font_options(PangoContext* pango, bool hinted) {
    const Owned<cairo_font_options_t, cairo_font_options_destroy> options(
        cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(),
                                      hinted ? CAIRO_HINT_STYLE_SLIGHT : CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(pango, options.get());
    pango_context_set_round_glyph_positions(pango, FALSE);
}

Layout layout_of(cairo_t* context, std::string_view text, const TextStyle& style, bool hinted) {
    Layout layout(pango_cairo_create_layout(context));
    set_font_options(pango_layout_get_context(layout.get()), hinted);
    Owned<PangoFontDescription, pango_font_description_free> font(pango_font_description_new());
    pango_font_description_set_family_static(font.get(), "DejaVu Sans");
    pango_font_description_set_absolute_size(font.get(), style.em_pixels * double{PANGO_SCALE});
    pango_font_description_set_weight(
        font.get(), style.weight == FontWeight::bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_auto_dir(layout.get(), FALSE);
    const Text valid(g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())));
    for (char* letter = valid.get(); *letter != '\0'; ++letter) {
        if (static_cast<unsigned char>(*letter) < 0x20 || *letter == 0x7F) *letter = ' ';
    }
    pango_layout_set_text(layout.get(), valid.get(), -1);
    return layout;
}

double width_of(PangoLayout* layout) {
    int width = 0;
    pango_layout_get_size(layout, &width, nullptr);
    return width / double{PANGO_SCALE};
}

// --- Items --------------------------------------------------------------------------------------

void set_colour(cairo_t* context, Colour colour) {
    cairo_set_source_rgb(context, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

// The surface that a drawing is drawn on. It shows the pixels of the drawing from (x, y) on.
struct Target {
    cairo_t* context;
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool is_file = false;  // a file can be viewed at any size
};

void draw(const Target& target, const Shape& shape) {
    cairo_t* const context = target.context;
    for (const DrawingPoint& point : shape.points) {
        if (shape.radius > 0) {
            cairo_new_sub_path(context);
            cairo_arc(context, point.x, point.y, shape.radius, 0, 2 * G_PI);
            cairo_close_path(context);
        } else {
            cairo_line_to(context, point.x, point.y);
        }
    }
    if (shape.closed) cairo_close_path(context);
    if (shape.fill) {
        set_colour(context, *shape.fill);
        cairo_fill_preserve(context);
    }
    if (shape.stroke_width > 0) {
        set_colour(context, shape.stroke);
        cairo_set_line_width(context, shape.stroke_width);
        cairo_stroke_preserve(context);
    }
}

// Draws text as outlines, because Cairo 1.16 moves glyphs to whole pixels.
void draw(const Target& target, const TextLine& line) {
    if (!has_font()) return;
    cairo_t* const context = target.context;
    cairo_save(context);
    cairo_translate(context, line.baseline.x, line.baseline.y);
    if (line.upwards) cairo_rotate(context, -G_PI / 2);
    const Layout layout = layout_of(context, line.text, line.style, !target.is_file);
    const double width = width_of(layout.get());
    const double shift = line.align == TextAlign::left     ? 0
                         : line.align == TextAlign::centre ? width / 2
                                                           : width;
    cairo_move_to(context, -shift, 0);
    set_colour(context, line.style.colour);
    PangoLayoutLine* const only = pango_layout_get_line_readonly(layout.get(), 0);
    if (target.is_file) {
        pango_cairo_show_layout_line(context, only);
    } else {
        pango_cairo_layout_line_path(context, only);
        cairo_fill(context);
    }
    cairo_restore(context);
}

// Draws the part of a picture that the target shows.
void draw(const Target& target, const PlacedPicture& placed) {
    const Picture& picture = placed.picture;
    const int left = std::max(placed.x, target.x), top = std::max(placed.y, target.y);
    const int right = std::min(placed.x + picture.width, target.x + target.width);
    const int bottom = std::min(placed.y + picture.height, target.y + target.height);
    if (left >= right || top >= bottom) return;
    const Surface part(cairo_image_surface_create(CAIRO_FORMAT_RGB24, right - left, bottom - top));
    unsigned char* const pixels = cairo_image_surface_get_data(part.get());
    if (pixels == nullptr) return;
    const int stride = cairo_image_surface_get_stride(part.get());
    for (int y = top; y < bottom; ++y) {
        unsigned char* to = pixels + std::ptrdiff_t{y - top} * stride;
        const std::uint8_t* from =
            picture.rgb.data() +
            3 * (std::ptrdiff_t{y - placed.y} * picture.width + (left - placed.x));
        for (int x = left; x < right; ++x, from += 3, to += 4) {
            const std::uint32_t pixel = std::uint32_t{from[0]} << 16U |
                                        std::uint32_t{from[1]} << 8U | std::uint32_t{from[2]};
            std::memcpy(to, &pixel, sizeof pixel);
        }
    }
    cairo_surface_mark_dirty(part.get());
    cairo_set_source_surface(target.context, part.get(), left, top);
    cairo_pattern_set_filter(cairo_get_source(target.context), CAIRO_FILTER_NEAREST);
    cairo_rectangle(target.context, left, top, right - left, bottom - top);
    cairo_fill(target.context);
}

void draw(const Target& target, const Drawing& drawing) {
    set_colour(target.context, paper_colour);
    cairo_paint(target.context);
    cairo_set_line_join(target.context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(target.context, CAIRO_LINE_CAP_ROUND);
    for (const DrawingItem& item : drawing.items) {
        // Otherwise a shape goes on from where the path of the item before it ended.
        cairo_new_path(target.context);
        std::visit([&target](const auto& kind) { draw(target, kind); }, item);
    }
}

// --- What the module does -----------------------------------------------------------------------

// A lock for drawing, because all drawings share the fonts.
std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
}

double measure(std::string_view text, const TextStyle& style) {
    const std::lock_guard lock(one_at_a_time());
    if (!has_font()) return 0;
    static const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
    static const Context context(cairo_create(surface.get()));
    return width_of(layout_of(context.get(), text, style, true).get());
}

// Paints a part of the picture, at most as large as Cairo's surfaces may be.
void paint_tile(const Drawing& drawing, Target tile, Picture& picture) {
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, tile.width, tile.height));
    const Context context(cairo_create(surface.get()));
    tile.context = context.get();
    cairo_translate(context.get(), -tile.x, -tile.y);
    draw(tile, drawing);
    cairo_surface_flush(surface.get());
    const unsigned char* const pixels = cairo_image_surface_get_data(surface.get());
    if (pixels == nullptr) return;
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < tile.height; ++y) {
        const unsigned char* from = pixels + std::ptrdiff_t{y} * stride;
        std::uint8_t* to =
            picture.rgb.data() + 3 * (std::ptrdiff_t{tile.y + y} * picture.width + tile.x);
        for (int x = 0; x < tile.width; ++x, from += 4) {
            std::uint32_t pixel = 0;
            std::memcpy(&pixel, from, sizeof pixel);
            for (const unsigned shift : {16U, 8U, 0U}) {
                *to++ = static_cast<std::uint8_t>(pixel >> shift & 0xFFU);
            }
        }
    }
}

Picture paint(const Drawing& drawing) {
    constexpr int tile_edge = 4096;
    const std::lock_guard lock(one_at_a_time());
    Picture picture(drawing.width, drawing.height);
    for (int y = 0; y < drawing.height; y += tile_edge) {
        for (int x = 0; x < drawing.width; x += tile_edge) {
            const Target tile{nullptr, x, y, std::min(tile_edge, drawing.width - x),
                              std::min(tile_edge, drawing.height - y)};
            paint_tile(drawing, tile, picture);
        }
    }
    return picture;
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

// Renumbers the ids in a file ("surface12", "image9") from 0, because Cairo counts them over all
// files that the program writes.
std::string renumbered(std::string_view svg) {
    constexpr std::array<std::string_view, 3> prefixes = {"\"surface", "\"image", "\"#image"};
    std::map<std::string_view, std::size_t> numbers;
    std::string result;
    while (!svg.empty()) {
        const std::size_t begin = std::min(svg.find('"'), svg.size());
        result += svg.substr(0, begin);
        svg.remove_prefix(begin);
        for (const std::string_view prefix : prefixes) {
            if (!svg.starts_with(prefix)) continue;
            const std::size_t end = svg.find('"', prefix.size());
            const std::string_view id = svg.substr(prefix.size(), end - prefix.size());
            const std::size_t number = numbers.try_emplace(id, numbers.size()).first->second;
            result += std::string(prefix) + std::to_string(number);
            svg.remove_prefix(end);
            break;
        }
        if (svg.empty()) break;
        result += svg.front();
        svg.remove_prefix(1);
    }
    return result;
}

std::string svg(const Drawing& drawing) {
    const std::lock_guard lock(one_at_a_time());
    std::string text;
    const Surface surface(
        cairo_svg_surface_create_for_stream(append, &text, drawing.width, drawing.height));
    cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    const Context context(cairo_create(surface.get()));
    draw({context.get(), 0, 0, drawing.width, drawing.height, true}, drawing);
    cairo_surface_finish(surface.get());
    return cairo_status(context.get()) == CAIRO_STATUS_SUCCESS ? renumbered(text) : "";
}

}  // namespace
}  // namespace skybake

extern "C" const skybake::ChartModule* skybake_chart_module() {
    static constexpr skybake::ChartModule chart_module = {skybake::has_font, skybake::measure,
                                                          skybake::paint, skybake::svg};
    return &chart_module;
}
