#include "bakers/io/formats/png/image_module.h"

#include "bakers/io/files/load_module.h"

namespace skybake {
namespace {

LoadedImageCodec load() {
    const ModuleSymbol symbol = load_module(image_module_name, image_codec_symbol);
    if (symbol.address == nullptr) return {nullptr, symbol.reason};
    return {reinterpret_cast<ImageCodecFunction>(symbol.address)(), ""};
}

}  // namespace

const LoadedImageCodec& image_codec() {
    static const LoadedImageCodec loaded = load();
    return loaded;
}

}  // namespace skybake
