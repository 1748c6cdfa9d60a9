// The files of a preview: pictures as PNG files with unique names, and the page. The header also
// recognises files that an earlier preview wrote.
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
#include "bakers/report/report_files.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A memo of pictures that were made before, by a key of what they depend on.
using PicturesByKey = std::map<std::string, std::vector<PagePicture>>;
struct PictureMemo {
    PicturesByKey pictures;
    PicturesByKey unfinished;  // of the last preview, if that was interrupted
};

class PictureEncoder {
  public:
    // `memory` may be null. Otherwise its pictures are used first, and afterwards it holds exactly
    // the pictures shown this time.
    PictureEncoder(int threads, PictureMemo* memory) : threads_(threads), memory_(memory) {}

    // Returns the pictures in the memo for `key`, or those that `make` makes. A name that is
    // already taken gets a number at its end.
    std::vector<PagePicture> encode(const std::string& key,
                                    const std::function<std::vector<PreviewPicture>()>& make);

    // Ends an interrupted preview. The pictures of the last call of encode() may be incomplete and are
    // forgotten; all others stay in the memo.
    void give_up();

    // Finishes the preview and returns the diagnostics of png_bytes.
    [[nodiscard]] std::vector<Diagnostic> finish();

  private:
    const std::vector<PagePicture>* remembered(const std::string& key) const;
    std::vector<PagePicture> encoded(std::vector<PreviewPicture> pictures);
    std::string free_name(std::string_view name);

    int threads_;
    PictureMemo* memory_;
    PicturesByKey shown_;
    std::string last_key_;
    std::set<std::string> names_;
    std::vector<Diagnostic> problems_;
};

// Returns NAME.png for each picture, what a watching page shows next, and the page as the last file.
std::vector<NamedFile> preview_files(const PreviewPage& page);

// Returns the names of these files.
std::vector<std::string> preview_file_names(const PreviewPage& page);

// Returns the files that earlier previews left in the folder, as its page lists them; none without
// such a page.
std::vector<std::string> earlier_preview_files(const std::filesystem::path& folder);

// Returns E0303 for each file of `names` that is in the folder and not among `earlier`.
[[nodiscard]] std::vector<Diagnostic> foreign_preview_files(
    const std::filesystem::path& folder, const std::vector<std::string>& names,
    const std::vector<std::string>& earlier);

}  // namespace skybake
