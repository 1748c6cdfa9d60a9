// The page of a preview: one HTML file that holds everything it shows.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// A picture as its file.
struct PagePicture {
    std::string name;  // of the file, without ".png"
    std::string title;
    std::string caption;
    int width = 0;
    int height = 0;
    std::string png;  // bytes
    PictureKind kind = PictureKind::image;
};

// An asset with its pictures.
struct PageAsset {
    ManifestAsset entry;
    std::vector<PagePicture> pictures;
    std::string plot_svg;  // speed against error, as `report` draws it, or empty
};

// Pictures of several assets together: the sky.
struct PageScene {
    std::string title;
    std::string content;  // what is shown, in a sentence
    std::vector<PagePicture> pictures;
};

// One variant of a sweep. A cell sorts by its number, if it has one, and shows its text, if it has
// one.
struct PageVariant {
    struct Cell {
        std::optional<double> number;
        std::string text;
    };
    std::vector<Cell> cells;  // as the columns
    std::optional<PagePicture> picture;
};

struct PageSweep {
    struct Column {
        std::string title;
        bool is_number = true;
        bool is_error = false;  // shown with two digits
    };
    std::string content;
    std::vector<PagePicture> pictures;  // the contact sheet
    std::vector<Column> columns;
    std::vector<PageVariant> variants;
};

struct PreviewPage {
    std::string title;
    std::vector<std::string> notes;
    std::vector<PageAsset> assets;
    std::vector<PageScene> scenes;
    std::optional<PageSweep> sweep;
    // Pictures of earlier previews that still lie beside the page, by file name: they stay
    // skybake's.
    std::vector<std::string> retired;
    int watch_revision = 0;  // of pages that follow a recipe: counts from 1; 0 for all others
};

// Bytes as text, for data: URIs: RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

// The page's text. It needs no other file and no network, but for pages that watch, which look at
// page_state_name beside them. Its pictures stand in the HTML: a browser without scripts shows them
// one below the other.
std::string page_html(const PreviewPage& page);

// What a watched page is told. Its file is page_state_name.
struct PageState {
    int revision = 0;    // of the page that belongs to it
    double seconds = 0;  // from the change to the files
    bool full = false;   // the page has full quality; else a draft's, while the full one is made
    bool ended = false;  // nobody watches any longer
    std::vector<config::Diagnostic> diagnostics;
};
inline constexpr const char* page_state_name = "preview_state.js";
std::string page_state_text(const PageState& state);

inline constexpr const char* page_name = "index.html";

// The names of the files that a page says lie beside it, those of earlier previews among them; none
// where the text was not written by page_html.
std::optional<std::vector<std::string>> files_of_page(std::string_view html);

// page.html, page.css, page.js and page_watch.js as they travel inside the program.
std::string_view page_html_template();
std::string_view page_style();
std::string_view page_script();
std::string_view page_watch_script();

}  // namespace skybake
