#include "bakers/plot/label.h"

#include <map>
#include <mutex>
#include <string>
#include <tuple>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/formats/png/image_module.h"

namespace skybake {
namespace {

TextBitmap drawn(std::string_view text, int em_pixels, FontWeight weight) {
    const LoadedImageCodec& loaded = image_codec();
    if (loaded.codec != nullptr) return loaded.codec->draw_text(text, em_pixels, weight);
    TextBitmap none;
    none.problem = loaded.reason;
    return none;
}

}  // namespace

const TextBitmap& label(std::string_view text, int em_pixels, FontWeight weight) {
    using Key = std::tuple<std::string, int, FontWeight>;
    static std::mutex mutex;
    static std::map<Key, TextBitmap> labels;  // whose elements never move
    const std::lock_guard lock(mutex);
    const auto [found, fresh] =
        labels.try_emplace(Key(std::string(text), em_pixels, weight), TextBitmap());
    if (fresh) found->second = drawn(text, em_pixels, weight);
    return found->second;
}

std::optional<config::Diagnostic> text_problem() {
    for (const FontWeight weight : {FontWeight::regular, FontWeight::bold}) {
        const std::string& problem = label("0", 12, weight).problem;
        if (!problem.empty()) {
            return file_error("E0300", "", "cannot write on pictures: " + problem);
        }
    }
    return std::nullopt;
}

}  // namespace skybake
