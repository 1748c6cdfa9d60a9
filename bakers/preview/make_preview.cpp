#include "bakers/preview/make_preview.h"

#include <utility>

#include "bakers/core/parallel.h"
#include "bakers/preview/png_image.h"

namespace skybake {
namespace {

using config::Outcome;

}  // namespace

Outcome<std::vector<PagePicture>> encode_pictures(const std::vector<PreviewPicture>& pictures,
                                                  int threads) {
    std::vector<Outcome<std::string>> encoded(pictures.size());
    parallel_for(static_cast<int>(pictures.size()), threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        encoded[at] = png_bytes(pictures[at].picture);
    });
    std::vector<PagePicture> result;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (!encoded[i].value) return {{}, std::move(encoded[i].diagnostics)};
        const PreviewPicture& picture = pictures[i];
        result.push_back({picture.name, picture.title, picture.caption, picture.picture.width,
                          picture.picture.height, std::move(*encoded[i].value)});
    }
    return {std::move(result), {}};
}

Outcome<PreviewPage> make_preview(PreviewAssets assets, const PreviewOptions& options) {
    PreviewPage page;
    page.title = assets.title;
    page.notes = assets.notes;
    for (PreviewAsset& asset : assets.assets) page.assets.push_back({asset.entry, {}, {}});
    (void)options;
    return {std::move(page), {}};
}

}  // namespace skybake
