// The files of a preview: pictures as PNG with names that are free, the page, and the signs by
// which it knows its own.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/plot/drawing.h"
#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A name that stays within its folder, whatever a manifest calls its assets ("../../.profile"): of
// letters, digits and `_-.`, no hidden file, no longer than file systems take.
std::string file_stem(std::string_view name);

// Pictures that were made before, by what they were made of.
struct PictureMemo {
    std::map<std::string, std::vector<PagePicture>> pictures;
};

class PictureEncoder {
  public:
    // `memory` may be null; else it is asked first, and left with what was shown this time.
    PictureEncoder(int threads, PictureMemo* memory) : threads_(threads), memory_(memory) {}

    // The pictures that `make` makes, or those that the memory has of `key`. Names that are taken
    // get a number behind them.
    std::vector<PagePicture> encode(const std::string& key,
                                    const std::function<std::vector<PreviewPicture>()>& make);

    // Ends the round: what png_bytes could not do.
    [[nodiscard]] std::vector<config::Diagnostic> finish();

  private:
    std::vector<PagePicture> encoded(const std::vector<PreviewPicture>& pictures);
    std::string free_name(std::string_view name);

    int threads_;
    PictureMemo* memory_;
    PictureMemo shown_;
    std::set<std::string> names_;
    std::vector<config::Diagnostic> problems_;
};

struct PreviewFile {
    std::string name;  // relative to the preview's folder
    std::string bytes;
};

// NAME.png of each picture, and the page last.
std::vector<PreviewFile> preview_files(const PreviewPage& page);

// Their names alone.
std::vector<std::string> preview_file_names(const PreviewPage& page);

// The files that earlier previews left in the folder, as its page says; none without such a page.
std::vector<std::string> earlier_preview_files(const std::filesystem::path& folder);

// E0303 for each of these files that is in the folder and not among `earlier`.
[[nodiscard]] std::vector<config::Diagnostic> foreign_preview_files(
    const std::filesystem::path& folder, const std::vector<std::string>& names,
    const std::vector<std::string>& earlier);

}  // namespace skybake
