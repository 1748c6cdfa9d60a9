// From pictures to what a page shows of them: PNG files with names that are free.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/plot/picture.h"
#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A name that stays within its folder, whatever a manifest calls its assets ("../../.profile"): of
// letters, digits and `_-.`, no hidden file, no longer than file systems take.
std::string file_stem(std::string_view name);

// Pictures that were made before, by what they were made of.
struct PictureMemory {
    std::map<std::string, std::vector<PagePicture>> pictures;
};

class PictureEncoder {
  public:
    // `memory` may be null; else it is asked first, and left with what was shown this time.
    PictureEncoder(int threads, PictureMemory* memory) : threads_(threads), memory_(memory) {}

    // The pictures that `make` makes, or those that the memory has of `key`. Names that are taken
    // get a number behind them.
    std::vector<PagePicture> encode(const std::string& key,
                                    const std::function<std::vector<PreviewPicture>()>& make);

    // Ends the round: what png_bytes could not do.
    std::vector<config::Diagnostic> finish();

  private:
    std::vector<PagePicture> encoded(const std::vector<PreviewPicture>& pictures);
    std::string free_name(std::string_view name);

    int threads_;
    PictureMemory* memory_;
    PictureMemory shown_;
    std::set<std::string> names_;
    std::vector<config::Diagnostic> problems_;
};

}  // namespace skybake
