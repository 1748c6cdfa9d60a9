#include "bakers/io/formats/vdb/vdb_module.h"

#include "bakers/io/files/load_module.h"

namespace skybake {
namespace {

LoadedVdbCodec load_codec() {
    const ModuleSymbol symbol = load_module(vdb_module_name, vdb_codec_symbol);
    if (symbol.address == nullptr) return {nullptr, symbol.reason};
    return {reinterpret_cast<VdbCodecFunction>(symbol.address)(), ""};
}

}  // namespace

const LoadedVdbCodec& vdb_codec() {
    static const LoadedVdbCodec loaded = load_codec();
    return loaded;
}

}  // namespace skybake
