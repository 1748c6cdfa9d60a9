#include "bakers/io/map_module.h"

#include "bakers/io/load_module.h"

namespace skybake {
namespace {

LoadedMapCodec load() {
    const ModuleSymbol symbol = load_module("skybake_images", map_codec_symbol);
    if (symbol.address == nullptr) return {nullptr, symbol.reason};
    return {reinterpret_cast<MapCodecFunction>(symbol.address)(), ""};
}

}  // namespace

const LoadedMapCodec& map_codec() {
    static const LoadedMapCodec loaded = load();
    return loaded;
}

}  // namespace skybake
