#include "bakers/plot/picture.h"

#include <utility>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/formats/png/image_module.h"

namespace skybake {

config::Outcome<std::string> png_bytes(const Picture& picture) {
    const LoadedImageCodec& loaded = image_codec();
    if (loaded.codec == nullptr) {
        return {{}, {file_error("E0300", "", "cannot write pictures: " + loaded.reason)}};
    }
    EncodedPicture png = loaded.codec->encode_png(picture.width, picture.height, picture.rgb);
    if (!png.problem.empty()) {
        return {{}, {file_error("E0500", "", "cannot write a picture: " + png.problem)}};
    }
    return {std::move(png.bytes), {}};
}

}  // namespace skybake
