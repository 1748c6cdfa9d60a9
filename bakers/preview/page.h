// The page of a preview: one HTML file that contains everything it shows, except the pictures of
// turntables, which are many and stay in the files beside it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "bakers/plot/drawing.h"

namespace skybake {

// A picture as a file. Its `picture` keeps its size alone.
struct PagePicture : PreviewPicture {
    std::string png;  // bytes
};

// An asset with its pictures.
struct PageAsset {
    ManifestAsset entry;
    std::vector<PagePicture> pictures;
    std::string plot_svg;  // speed against error, as drawn by `report`; or empty
};

// A scene of several assets together, such as the sky.
struct PageScene {
    std::string title;
    std::string content;  // a sentence on what is shown
    std::vector<PagePicture> pictures;
    bool clouds = false;  // with the recipe's clouds; shown before all others
};

// One variant of a table. A cell is sorted by its number and shows its text, if it has one.
struct PageVariant {
    std::string name;
    std::string folder;  // as seen from the page; empty: it has none
    struct Cell {
        std::optional<double> number;
        std::string text;
    };
    std::vector<Cell> cells;  // in the order of the columns
    std::optional<PagePicture> picture;
};

// Variants side by side: those of a sweep, or the ways of a plan.
struct PageTable {
    std::string title;
    struct Column {
        std::string title;
        std::string shown;  // the page's function that makes a text of numbers; empty: texts
    };
    std::string content;
    std::vector<PagePicture> pictures;  // contact sheets and plots
    std::vector<Column> columns;
    std::vector<PageVariant> variants;
};

struct PreviewPage {
    std::string title;
    std::vector<std::string> notes;
    std::vector<PageAsset> assets;
    std::vector<PageScene> scenes;
    std::vector<PageTable> tables;  // shown first
    // File names of pictures of earlier previews that are still beside the page. They stay
    // skybake's.
    std::vector<std::string> retired;
    int watch_revision = 0;  // counts from 1 for pages that follow a recipe; 0 for others
    std::string live_scene;  // what a live page renders (live/live_scene.h); none for other pages
};

// Encodes bytes as text for data: URIs, as in RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

// Returns the page's text. It needs no other file and no network, except that a watching page reads
// the files page_state_name and swap_name_of beside it. The pictures are in the HTML, so a
// browser without scripts shows them one below the other.
std::string page_html(const PreviewPage& page);

// The file from which a watching page takes the data and the figures of its next revision, or its
// scene, to show them in place of its own.
const char* swap_name_of(const PreviewPage& page);
std::string page_swap_text(const PreviewPage& page);

// The state that a watching page reads from the file page_state_name.
struct PageState {
    int revision = 0;    // of the page that belongs to this state
    double seconds = 0;  // from the change to the files
    bool full = false;   // true: full quality; false: a draft, while the full page is made
    bool ended = false;  // the program has stopped watching the recipe
    std::vector<Diagnostic> diagnostics;
};
inline constexpr const char* page_state_name = "preview_state.js";
std::string page_state_text(const PageState& state);

inline constexpr const char* page_name = "index.html";

// Returns the names of the files that a page lists as beside it, including those of earlier
// previews. Returns nothing if page_html has not written the text.
std::optional<std::vector<std::string>> files_of_page(std::string_view html);

}  // namespace skybake
