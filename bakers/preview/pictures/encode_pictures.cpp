#include "bakers/preview/pictures/encode_pictures.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "bakers/math/parallel.h"

namespace skybake {

std::string file_stem(std::string_view name) {
    constexpr std::size_t longest = 120;
    std::string stem(name.substr(0, longest));
    for (char& c : stem) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
        if (!plain) c = '_';
    }
    if (stem.empty() || stem.front() == '.') stem.insert(stem.begin(), '_');
    return stem;
}

std::vector<PagePicture> PictureEncoder::encode(
    const std::string& key, const std::function<std::vector<PreviewPicture>()>& make) {
    std::vector<PagePicture> pictures;
    const bool known = memory_ != nullptr && memory_->pictures.count(key) > 0;
    pictures = known ? memory_->pictures[key] : encoded(make());
    if (memory_ != nullptr) shown_.pictures[key] = pictures;
    for (PagePicture& picture : pictures) picture.name = free_name(picture.name);
    return pictures;
}

std::vector<config::Diagnostic> PictureEncoder::finish() {
    if (memory_ != nullptr) *memory_ = std::move(shown_);
    return std::move(problems_);
}

std::vector<PagePicture> PictureEncoder::encoded(const std::vector<PreviewPicture>& pictures) {
    std::vector<config::Outcome<std::string>> bytes(pictures.size());
    parallel_for(static_cast<int>(pictures.size()), threads_, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        bytes[at] = png_bytes(pictures[at].picture);
    });
    std::vector<PagePicture> result;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (!bytes[i].value) {
            std::move(bytes[i].diagnostics.begin(), bytes[i].diagnostics.end(),
                      std::back_inserter(problems_));
            return {};
        }
        const PreviewPicture& picture = pictures[i];
        result.push_back({picture.name, picture.title, picture.caption, picture.picture.width,
                          picture.picture.height, std::move(*bytes[i].value), picture.kind});
    }
    return result;
}

std::string PictureEncoder::free_name(std::string_view name) {
    const std::string stem = file_stem(name);
    std::string free = stem;
    for (int i = 2; !names_.insert(free).second; ++i) free = fmt::format("{}_{}", stem, i);
    return free;
}

}  // namespace skybake
